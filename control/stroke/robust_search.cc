#include <control/stroke/cost_record.h>
#include <control/stroke/robust_search.h>

#include <algorithm>
#include <deque>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    /// The members' problems side by side; variables are those of the field, then t.
    class RobustProblem
    {
    public:
      RobustProblem(const FieldTask &task, const std::vector<SwimmerParameters> &members, const int n_left_out,
                    const FieldVariables &variables, const FieldStart &start, const FieldSearchOptions &options)
          : n_(variables.size()), n_left_out_(n_left_out), sizes_(task.sizes)
      {
        for (const SwimmerParameters &member : members)
        {
          goals_.push_back(task.goal);
          goals_.back().swimmer = member;
          if (problems_.size() > 0)
            goals_.back().field = {}; // the same for all: the first one keeps it
          problems_.emplace_back(task.model, task.swimmer, goals_.back(), variables, options.stroke);
          problems_.back().restart_from(start.state);
        }
      }

      int n_constraints() const
      {
        int n = static_cast<int>(problems_.size()) - n_left_out_;
        for (const StrokeProblem &problem : problems_)
          n += problem.n_constraints();
        return n;
      }

      std::vector<std::string> names() const
      {
        std::vector<std::string> names;
        for (std::size_t j = 0; j < problems_.size(); ++j)
          for (const std::string &name : problems_[j].constraint_names())
            names.push_back(j == 0 ? name : name + ", member " + std::to_string(j + 1));
        for (std::size_t j = 0; j + static_cast<std::size_t>(n_left_out_) < problems_.size(); ++j)
          names.emplace_back("objective of every member");
        return names;
      }

      void evaluate(const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation)
      {
        std::vector<Evaluation> parts(problems_.size());
        for (std::size_t j = 0; j < problems_.size(); ++j)
        {
          problems_[j].evaluate(x.head(n_), derivatives, sizes_, parts[j]);
          if (parts[j].failed())
          {
            evaluation.failure = parts[j].failure;
            return;
          }
        }
        gather(x[n_], parts, derivatives, evaluation);
      }

      double value(const Eigen::VectorXd &x)
      {
        std::vector<double> values;
        for (StrokeProblem &problem : problems_)
        {
          Evaluation part;
          problem.evaluate(x, false, sizes_, part);
          values.push_back(part.failed() ? 0. : part.objective);
        }
        std::sort(values.rbegin(), values.rend());
        return values[static_cast<std::size_t>(n_left_out_)];
      }

      long n_periods() const
      {
        return std::accumulate(problems_.begin(), problems_.end(), 0L,
                               [](const long sum, const StrokeProblem &problem) { return sum + problem.n_periods(); });
      }

      SwimmerState start(const Eigen::VectorXd &x) { return problems_.front().stroke(x, false).orbit.start; }

    private:
      void gather(const double t, const std::vector<Evaluation> &parts, const bool derivatives,
                  Evaluation &evaluation) const
      {
        evaluation.objective = t;
        evaluation.constraints.resize(n_constraints());
        if (derivatives)
        {
          evaluation.gradient = Eigen::VectorXd::Unit(n_ + 1, n_);
          evaluation.jacobian = Eigen::MatrixXd::Zero(n_constraints(), n_ + 1);
        }
        Eigen::Index row = 0;
        for (const Evaluation &part : parts)
        {
          const Eigen::Index n                   = part.constraints.size();
          evaluation.constraints.segment(row, n) = part.constraints;
          if (derivatives)
            evaluation.jacobian.block(row, 0, n, n_) = part.jacobian;
          row += n;
        }
        std::vector<std::size_t> rank(parts.size());
        std::iota(rank.begin(), rank.end(), 0u);
        std::sort(rank.begin(), rank.end(),
                  [&](const auto a, const auto b) { return parts[a].objective > parts[b].objective; });
        for (auto j = static_cast<std::size_t>(n_left_out_); j < rank.size(); ++j, ++row)
        {
          evaluation.constraints[row] = parts[rank[j]].objective - t;
          if (!derivatives)
            continue;
          evaluation.jacobian.row(row).head(n_) = parts[rank[j]].gradient.transpose();
          evaluation.jacobian(row, n_)          = -1.;
        }
      }

      int                       n_, n_left_out_;
      const TermSizes          &sizes_;
      std::deque<SwimmingGoal>  goals_; // stay where they are
      std::deque<StrokeProblem> problems_;
    };

    Eigen::VectorXd extended(const Eigen::VectorXd &v, const double last)
    {
      Eigen::VectorXd longer(v.size() + 1);
      longer << v, last;
      return longer;
    }
  } // namespace

  FieldFound search_robust_field(const FieldTask &task, const std::vector<SwimmerParameters> &members,
                                 const int n_left_out, const FieldVariables &variables, const FieldStart &start,
                                 const FieldSearchOptions &options)
  {
    constexpr double    farthest = 1e3, step = 0.1; // of t, in sizes of the reference sinusoid
    RobustProblem       members_problem(task, members, n_left_out, variables, start, options);
    MinimizationProblem problem = field_box(variables, task.goal);
    problem.lower               = extended(problem.lower, -farthest);
    problem.upper               = extended(problem.upper, farthest);
    problem.scale               = extended(problem.scale, step);
    problem.n_constraints       = members_problem.n_constraints();
    problem.constraint_scale    = Eigen::VectorXd::Ones(problem.n_constraints); // all are relative to their limits
    problem.constraint_names    = members_problem.names();
    CostRecord record(options.search.feasibility_tolerance);
    problem.evaluate = [&](const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation) {
      members_problem.evaluate(x, derivatives, evaluation);
      record.note(evaluation, members_problem.n_periods());
    };
    FieldFound            found;
    const Eigen::VectorXd x0 = variables.variables(start.drive);
    found.minimum            = search_minimum(problem, extended(x0, members_problem.value(x0)), options.search);
    found.n_periods          = members_problem.n_periods();
    found.start              = start.state;
    found.trace              = record.trace();
    if (found.minimum.x.size() == 0)
      return found;
    found.minimum.x = found.minimum.x.head(variables.size()).eval();
    found.drive     = variables.drive(found.minimum.x);
    found.start     = members_problem.start(found.minimum.x);
    return found;
  }
} // namespace swimtwin
