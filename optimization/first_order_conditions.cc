#include <optimization/first_order_conditions.h>
#include <optimization/nonnegative_least_squares.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Outward normals of the active bounds and gradients of the active constraints, one column each.
    struct ActiveSet
    {
      Eigen::MatrixXd           normals;
      std::vector<Eigen::Index> constraints; ///< which constraint the last columns belong to
    };

    ActiveSet active_set(const Eigen::VectorXd &x, const Eigen::VectorXd &lower, const Eigen::VectorXd &upper,
                         const Evaluation &evaluation, const double active)
    {
      const Eigen::Index           n = x.size();
      std::vector<Eigen::VectorXd> columns;
      ActiveSet                    set;
      for (Eigen::Index j = 0; j < n; ++j)
      {
        if (x[j] - lower[j] <= active)
          columns.push_back(-Eigen::VectorXd::Unit(n, j));
        if (upper[j] - x[j] <= active)
          columns.push_back(Eigen::VectorXd::Unit(n, j));
      }
      for (Eigen::Index i = 0; i < evaluation.constraints.size(); ++i)
        if (evaluation.constraints[i] >= -active)
        {
          columns.push_back(evaluation.jacobian.row(i).transpose());
          set.constraints.push_back(i);
        }
      set.normals.resize(n, static_cast<Eigen::Index>(columns.size()));
      for (std::size_t k = 0; k < columns.size(); ++k)
        set.normals.col(static_cast<Eigen::Index>(k)) = columns[k];
      return set;
    }
  } // namespace

  FirstOrderConditions first_order_conditions(const Eigen::VectorXd &x, const Eigen::VectorXd &lower,
                                              const Eigen::VectorXd &upper, const Evaluation &evaluation,
                                              const double active)
  {
    const ActiveSet       set    = active_set(x, lower, upper, evaluation, active);
    const Eigen::VectorXd pushes = nonnegative_least_squares(set.normals, -evaluation.gradient);
    const Eigen::VectorXd rest   = evaluation.gradient + set.normals * pushes;

    FirstOrderConditions conditions{rest.size() > 0 ? rest.cwiseAbs().maxCoeff() : 0.,
                                    Eigen::VectorXd::Zero(evaluation.constraints.size())};
    const Eigen::Index first = pushes.size() - static_cast<Eigen::Index>(set.constraints.size());
    for (std::size_t k = 0; k < set.constraints.size(); ++k)
    {
      const Eigen::Index i      = set.constraints[k];
      conditions.multipliers[i] = pushes[first + static_cast<Eigen::Index>(k)];
      conditions.residual =
          std::max(conditions.residual, std::abs(conditions.multipliers[i] * evaluation.constraints[i]));
    }
    return conditions;
  }
} // namespace swimtwin
