#include <datasets/scene/median_step.h>

#include <algorithm>

namespace swimtwin
{
  double median_step(const std::vector<double> &time_s)
  {
    std::vector<double> steps;
    for (std::size_t i = 1; i < time_s.size(); ++i)
      steps.push_back(time_s[i] - time_s[i - 1]);
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
  }
} // namespace swimtwin
