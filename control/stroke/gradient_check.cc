#include <control/stroke/gradient_check.h>
#include <datasets/system/error.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double step = 5e-3; // of a variable's scale

    /// All terms, then all constraints.
    struct Quantities
    {
      Eigen::VectorXd values;
      Eigen::MatrixXd slopes;
    };

    class QuantityProblem
    {
    public:
      QuantityProblem(const ReducedModel &model, const ReducedSwimmer &swimmer, const SwimmingGoal &goal,
                      const FieldVariables &variables)
          : variables_(variables),
            problem_(model, swimmer, goal, variables, {.relative_tolerance = 1e-11, .closure = 3e-10, .n_samples = 12})
      {
      }

      Quantities at(const Eigen::VectorXd &x, const bool with_slopes)
      {
        const Stroke &stroke = problem_.stroke(x, with_slopes);
        if (!stroke.found())
          throw ComputationError("derivatives cannot be checked at this field: " + stroke.failure);
        Evaluation evaluation;
        problem_.evaluate(x, with_slopes, {}, evaluation);
        constexpr auto n = static_cast<Eigen::Index>(all_stroke_terms.size());
        Quantities     all{Eigen::VectorXd(n + evaluation.constraints.size()),
                       Eigen::MatrixXd(n + evaluation.constraints.size(), variables_.size())};
        all.values.tail(evaluation.constraints.size()) = evaluation.constraints;
        if (with_slopes)
          all.slopes.bottomRows(evaluation.constraints.size()) = evaluation.jacobian;
        for (Eigen::Index i = 0; i < n; ++i)
        {
          const TermValue term = problem_.term(all_stroke_terms[static_cast<std::size_t>(i)], stroke);
          all.values[i]        = term.value;
          if (with_slopes)
            all.slopes.row(i) = variables_.slopes(term.slopes);
        }
        return all;
      }

      std::vector<std::string> constraint_names() const { return problem_.constraint_names(); }

    private:
      const FieldVariables &variables_;
      StrokeProblem         problem_;
    };

    /// Without its bound and its place: "|B|", "heading held", ...
    std::string kind(const std::string &name)
    {
      return name.substr(0, name.find(" <="));
    }

    GradientCheck compare(const std::string &name, const Eigen::RowVectorXd &slopes, const Eigen::RowVectorXd &found)
    {
      const double size = slopes.lpNorm<Eigen::Infinity>(), error = (slopes - found).lpNorm<Eigen::Infinity>();
      return {name, size, size > 0. ? error / size : error};
    }
  } // namespace

  std::vector<GradientCheck> check_gradients(const ReducedModel &model, const ReducedSwimmer &swimmer,
                                             const SwimmingGoal &goal, const FieldVariables &variables,
                                             const Eigen::VectorXd &x)
  {
    constexpr std::array<std::pair<double, double>, 4> stencil = {
        {{-2., 1. / 12.}, {-1., -8. / 12.}, {1., 8. / 12.}, {2., -1. / 12.}}};
    SwimmingGoal unweighted = goal; // terms are looked at one by one
    unweighted.weights.clear();
    QuantityProblem       problem(model, swimmer, unweighted, variables);
    const Eigen::VectorXd scale    = field_box(variables, goal).scale;
    const Quantities      here     = problem.at(x, true);
    const Eigen::MatrixXd expected = here.slopes * scale.asDiagonal();
    Eigen::MatrixXd       found    = Eigen::MatrixXd::Zero(expected.rows(), expected.cols());
    for (int i = 0; i < variables.size(); ++i)
      for (const auto &[place, weight] : stencil)
        found.col(i) +=
            weight / step * problem.at(x + place * step * scale[i] * Eigen::VectorXd::Unit(x.size(), i), false).values;

    std::vector<GradientCheck> checks;
    constexpr auto             n = static_cast<Eigen::Index>(all_stroke_terms.size());
    for (Eigen::Index i = 0; i < n; ++i)
      checks.push_back(
          compare(to_string(all_stroke_terms[static_cast<std::size_t>(i)]), expected.row(i), found.row(i)));
    const std::vector<std::string> names = problem.constraint_names();
    for (std::size_t first = 0, last; first < names.size(); first = last)
    {
      std::size_t largest = first;
      for (last = first; last < names.size() && kind(names[last]) == kind(names[first]); ++last)
        if (here.values[n + static_cast<Eigen::Index>(last)] > here.values[n + static_cast<Eigen::Index>(largest)])
          largest = last;
      const Eigen::Index row = n + static_cast<Eigen::Index>(largest);
      checks.push_back(compare(kind(names[first]), expected.row(row), found.row(row)));
    }
    return checks;
  }
} // namespace swimtwin
