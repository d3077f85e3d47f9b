#include <datasets/scene/scene.h>

#include <datasets/scene/tail_outline.h>
#include <datasets/surface/closed_surface.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  double Head::area_m2() const
  {
    const double box = size_m[0] * size_m[1];
    return shape == HeadShape::rectangle ? box : 0.25 * std::numbers::pi * box;
  }

  double Head::volume(const int dimension) const
  {
    if (enclosed)
      return enclosed->volume_m3;
    // An ellipse turned about x fills two thirds of the cylinder around it, a rectangle all of it.
    const double cylinder = 0.25 * std::numbers::pi * size_m[0] * size_m[1] * size_m[1];
    return dimension == 2 ? area_m2() : shape == HeadShape::rectangle ? cylinder : cylinder * 2. / 3.;
  }

  double Head::second_moment(const int dimension) const
  {
    if (enclosed)
      return enclosed->second_moment_m5(0, 0) + enclosed->second_moment_m5(1, 1);
    const double xx = size_m[0] * size_m[0], yy = size_m[1] * size_m[1];
    if (dimension == 2)
      return area_m2() * (xx + yy) / (shape == HeadShape::rectangle ? 12. : 16.);
    return volume(3) * (shape == HeadShape::rectangle ? xx / 12. + yy / 16. : (xx + yy) / 20.);
  }

  std::array<std::array<double, 3>, 3> Head::second_moments() const
  {
    std::array<std::array<double, 3>, 3> moments{};
    if (!enclosed)
    {
      const double across = second_moment(3);
      moments[0][0]       = volume(3) * size_m[1] * size_m[1] / (shape == HeadShape::rectangle ? 8. : 10.);
      moments[1][1] = moments[2][2] = across;
      return moments;
    }
    const double trace = enclosed->second_moment_m5.trace();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        moments[i][j] = (i == j ? trace : 0.) - enclosed->second_moment_m5(i, j);
    return moments;
  }

  double Tail::mean_height_m() const
  {
    if (profile_m.empty())
      return .5 * (root_height_m + tip_height_m);
    constexpr int n    = 200;
    const double  end  = profile_m.back()[0];
    double        mean = 0.;
    for (int i = 0; i < n; ++i)
      mean += 2. * monotone_interpolation(profile_m, end * (i + .5) / n) / n;
    return mean;
  }

  bool Domain::has_traction_free_wall() const
  {
    return std::any_of(walls.begin(), walls.end(),
                       [](const auto &entry) { return entry.second.condition == WallCondition::traction_free; });
  }

  bool Domain::has_holding_wall() const
  {
    return std::any_of(walls.begin(), walls.end(),
                       [](const auto &entry) { return entry.second.condition != WallCondition::traction_free; });
  }

  int TimeSettings::n_steps() const
  {
    return static_cast<int>(std::lround(periods * steps_per_period));
  }

  double Scene::body_length_m() const
  {
    if (head.surface && !tail)
      return std::max(head.size_m[0], head.size_m[1]);
    return head.size_m[0] + (tail ? tail->length_m : 0.);
  }
} // namespace swimtwin
