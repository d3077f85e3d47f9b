#include <rom/training/sampled_shapes.h>

#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  // Runs that begin turned end at another height, and all drift: neither is what a swing does. Angle and first
  // coordinate nearly go together, as in a sinusoid, so that an offset would be taken for a difference of both.
  TEST(UsualPlace, IsWhatSwingAndBendDoInRunsThatBeginAnyhow)
  {
    const Scene scene =
        shipped_scene("reference-2d-casefile", {"numerics.mesh_size_m=1e-3", "numerics.mesh_size_corner_m=4e-4"});
    const Swimmer<2>            swimmer(scene, MPI_COMM_WORLD);
    constexpr int               n         = 60;
    constexpr double            by_sine_m = 2e-3, by_first = 0.3, by_second = -0.1;
    const std::array<double, 3> offsets_m = {0., 1.5e-3, -7e-4}, drifts_m = {1e-5, -2e-4, 3e-4};
    const Eigen::Index          n_shape = 2 * static_cast<Eigen::Index>(swimmer.tail().mesh.n_nodes());
    std::vector<SnapshotSet>    sets(offsets_m.size());
    std::vector<ShapePoint>     points;
    for (std::size_t s = 0; s < sets.size(); ++s)
    {
      sets[s].pose                = Eigen::MatrixXd::Zero(n, 3);
      sets[s].tail_displacement_m = Eigen::MatrixXd::Zero(n, n_shape);
      for (int k = 0; k < n; ++k)
      {
        const double t = 2. * std::numbers::pi * k / 20., angle = 0.6 * std::sin(t);
        const double first = 1e-3 * std::sin(t + 0.1), second = 2e-4 * std::cos(2. * t);
        points.push_back({Eigen::Vector2d(first, second), angle, 0., 0.});
        sets[s].pose(k, 1) = scene.head.center_m[1] + by_sine_m * std::sin(angle) + by_first * first +
                             by_second * second + offsets_m[s] + drifts_m[s] * k / (n - 1);
        sets[s].pose(k, 2) = angle;
      }
    }
    const Wandering found = wandering<2>(sets, swimmer, points);
    EXPECT_NEAR(found.usual.by_sine_m, by_sine_m, 1e-2 * by_sine_m);
    EXPECT_NEAR(found.usual.by_coordinate[0], by_first, 1e-2);
    EXPECT_NEAR(found.usual.by_coordinate[1], by_second, 1e-2);
    EXPECT_NEAR(found.reach_m[1], 1.5e-3, 2e-5);
  }

  // Half of the path over the way, of the middle one of three runs: one gets nowhere, one goes straight on.
  TEST(Wandering, TellsHowFarTheHeadGoesToAndFro)
  {
    const Scene                          scene = shipped_scene("reference-2d-casefile");
    const Swimmer<2>                     swimmer(scene, MPI_COMM_WORLD);
    const auto                           n_shape = 2 * static_cast<Eigen::Index>(swimmer.tail().mesh.n_nodes());
    std::vector<SnapshotSet>             sets(3);
    const std::array<Eigen::VectorXd, 3> x{Eigen::VectorXd{{0., 1., 0., 1., .5}}, Eigen::VectorXd{{0., 1., 0.}},
                                           Eigen::VectorXd{{0., 1., 2.}}};
    Eigen::Index                         n = 0;
    for (std::size_t s = 0; s < sets.size(); n += x[s++].size())
    {
      sets[s].pose                = Eigen::MatrixXd::Zero(x[s].size(), 3);
      sets[s].pose.col(0)         = 1e-3 * x[s];
      sets[s].tail_displacement_m = Eigen::MatrixXd::Zero(x[s].size(), n_shape);
    }
    std::vector<ShapePoint> points(static_cast<std::size_t>(n), {Eigen::Vector2d(1e-3, 0.), 0., 0., 0.});
    EXPECT_NEAR(wandering<2>(sets, swimmer, points).to_and_fro, 3.5, 1e-9);
  }
} // namespace swimtwin
