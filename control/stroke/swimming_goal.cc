#include <control/stroke/swimming_goal.h>

#include <rom/swimmer/dense_algebra.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  double largest_magnitude_T(const FieldLimits &limits)
  {
    double largest = std::min(limits.magnitude_T, std::hypot(limits.component_T[0], limits.component_T[1]));
    if (limits.current_per_field_A_T.rows() >= 2 && std::isfinite(limits.current_A))
    {
      const Eigen::VectorXd values = right_singular(limits.current_per_field_A_T).values;
      if (values.size() == 2 && values[1] > 0.)
        largest =
            std::min(largest, limits.current_A * std::sqrt(static_cast<double>(limits.current_per_field_A_T.rows())) /
                                  values[1]);
    }
    return largest;
  }
} // namespace swimtwin
