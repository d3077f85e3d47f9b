#include <datasets/scene/scene.h>

#include <cmath>
#include <algorithm>
#include <numbers>

namespace swimtwin
{
  double Head::area_m2() const
  {
    const double box = size_m[0] * size_m[1];
    return shape == HeadShape::rectangle ? box : 0.25 * std::numbers::pi * box;
  }

  double Head::polar_moment_m4() const
  {
    const double squares = size_m[0] * size_m[0] + size_m[1] * size_m[1];
    return area_m2() * squares / (shape == HeadShape::rectangle ? 12. : 16.);
  }

  bool Domain::has_traction_free_wall() const
  {
    return std::any_of(walls.begin(), walls.end(),
                       [](const auto &entry) { return entry.second.condition == WallCondition::traction_free; });
  }
  int TimeSettings::n_steps() const
  {
    return static_cast<int>(std::lround(periods * steps_per_period));
  }

  double Scene::body_length_m() const
  {
    return head.size_m[0] + (tail ? tail->length_m : 0.);
  }
} // namespace swimtwin
