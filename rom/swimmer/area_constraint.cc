#include <rom/swimmer/area_constraint.h>

#include <rom/swimmer/dense_algebra.h>

namespace swimtwin
{
  Eigen::MatrixXd free_directions(const ReducedSwimmer &swimmer, const SwimmerState &state)
  {
    const int n = swimmer.n_states() - 2;
    if (!swimmer.keeps_area())
      return Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd phi = Eigen::VectorXd::Zero(n);
    phi.tail(n - 1)     = swimmer.area_gradient(state.tail(n - 1));
    return orthogonal_complement(phi);
  }
} // namespace swimtwin
