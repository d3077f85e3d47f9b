#include <reports/run/swimmer_shapes.h>

#include <tests/reports/synthetic_run.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace swimtwin
{
  namespace
  {
    double area_m2(const Outline &outline)
    {
      double twice_area = 0.;
      for (std::size_t i = 0; i < outline.size(); ++i)
      {
        const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
        twice_area += a[0] * b[1] - b[0] * a[1];
      }
      return std::abs(0.5 * twice_area);
    }

    SnapshotSet at_rest(const Pose &pose)
    {
      SnapshotSet set = synthetic_snapshots({synthetic_row(0., 1.)}, 1);
      set.tail_displacement_m.setZero();
      set.pose << pose.x_m, pose.y_m, pose.angle_rad;
      return set;
    }
  } // namespace

  TEST(HeadOutline, IsThatOfTheSceneAtThePose)
  {
    const Scene   scene   = synthetic_scene();
    const Outline outline = head_outline(scene.head, {1e-3, -2e-3, 0.5 * std::numbers::pi});
    EXPECT_NEAR(area_m2(outline), scene.head.area_m2(), 1e-16);
    for (const auto &[x, y] : outline)
    {
      EXPECT_LE(std::abs(x - 1e-3), 0.75e-3 + 1e-15); // a quarter turn: the height lies along x
      EXPECT_LE(std::abs(y + 2e-3), 0.25e-3 + 1e-15);
    }
  }

  TEST(BoundaryChains, OneChainRoundAStripWithEveryBoundaryNodeOnce)
  {
    constexpr int     n      = 30;
    const SnapshotSet set    = synthetic_snapshots({synthetic_row(0., 1.)}, 1, n);
    const auto        chains = boundary_chains(set.tail_cells);
    ASSERT_EQ(chains.size(), 1u);
    EXPECT_EQ(chains.front().size(), 2u * (2 * n + 1) + 2u);
    EXPECT_EQ(std::set<int>(chains.front().begin(), chains.front().end()).size(), chains.front().size());
  }

  TEST(BoundaryChains, OrientationOfTheCellsDoesNotMatter)
  {
    SnapshotSet              set  = synthetic_snapshots({synthetic_row(0., 1.)}, 1);
    const Eigen::RowVectorXi cell = set.tail_cells.row(3);
    set.tail_cells.row(3) << cell[0], cell[2], cell[1], cell[5], cell[4], cell[3];
    EXPECT_EQ(boundary_chains(set.tail_cells).size(), 1u);
  }

  TEST(TailOutlines, AreaOfTheTaperAtRestAtAnyPose)
  {
    for (const double angle : {0., 0.4, 2.})
    {
      const auto outlines = tail_outlines(at_rest({1e-3, 2e-3, angle}), 0);
      ASSERT_EQ(outlines.size(), 1u);
      EXPECT_NEAR(area_m2(outlines.front()), 7.5e-3 * 0.5 * (1.5e-3 + 0.2e-3), 1e-15);
    }
  }

  TEST(TailOutlines, TipIsWhereTheTrajectorySaysItIs)
  {
    const TrajectoryRow row      = synthetic_row(0.7, 1.25);
    const auto          outlines = tail_outlines(synthetic_snapshots({row}, 1), 0);
    double              closest  = 1.;
    for (const auto &[x, y] : outlines.front())
      closest = std::min(closest, std::hypot(x - row.tail_tip_x_m, y - row.tail_tip_y_m));
    EXPECT_LT(closest, 1e-15);
  }

  TEST(TailOutlines, EdgesAreCurved)
  {
    // the midpoint of one boundary edge lifted by d: the edge is the parabola 4 d s (1 - s)
    SnapshotSet           set   = at_rest({0., 0., 0.});
    const auto            chain = boundary_chains(set.tail_cells).front();
    const double          d = 1e-4, before = area_m2(tail_outlines(set, 0).front());
    const double          edge  = (set.tail_nodes_m.row(chain[2]) - set.tail_nodes_m.row(chain[0])).norm();
    const Eigen::Vector2d along = (set.tail_nodes_m.row(chain[2]) - set.tail_nodes_m.row(chain[0])) / edge;
    set.tail_displacement_m.row(0).segment<2>(2 * chain[1]) << -along[1] * d, along[0] * d;
    // four chords see 15/16 of the parabola's 2/3 d edge
    EXPECT_NEAR(std::abs(area_m2(tail_outlines(set, 0).front()) - before), 15. / 16. * 2. / 3. * d * edge, 1e-16);
  }
} // namespace swimtwin
