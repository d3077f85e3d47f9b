#include <datasets/surface/surface_crossings.h>

#include <datasets/surface/surface_distance.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    using Points = std::vector<Eigen::Vector3d>;

    std::size_t n_crossings(const Points &a, const Points &b)
    {
      return crossings(a, {{0, 1, 2}}, b, {{0, 1, 2}}).n_pairs;
    }

    const Points flat{{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}};
  } // namespace

  TEST(SurfaceCrossings, TellsTrianglesThatMeetFromThoseThatDoNot)
  {
    EXPECT_EQ(n_crossings(flat, {{.2, .2, -1.}, {.2, .2, 1.}, {2., 2., 0.}}), 1u);  // through the inside
    EXPECT_EQ(n_crossings(flat, {{.2, .2, 0.}, {.2, .2, 1.}, {2., 2., 1.}}), 1u);   // a corner on it
    EXPECT_EQ(n_crossings(flat, {{.2, .2, 1e-9}, {.2, .2, 1.}, {2., 2., 1.}}), 0u); // a corner above it
    EXPECT_EQ(n_crossings(flat, {{.2, .2, 0.}, {.3, .2, 0.}, {.2, .3, 0.}}), 1u);   // within it, in its plane
    EXPECT_EQ(n_crossings(flat, {{1., 1., 0.}, {2., 1., 0.}, {1., 2., 0.}}), 0u);   // beside it, in its plane
    EXPECT_EQ(n_crossings(flat, {{-1., .5, 0.}, {2., .5, 0.}, {0., 5., 0.}}), 1u);  // across it, in its plane
    EXPECT_EQ(n_crossings(flat, {{.6, .6, -1.}, {.6, .6, 1.}, {2., 2., 0.}}), 0u);  // past it
  }

  TEST(SurfaceCrossings, NeighboursMayShareWhatTheyShare)
  {
    const Points points{{0., 0., 0.}, {1., 0., 0.},  {0., 1., 0.}, {1., 1., 0.},
                        {.5, .2, 0.}, {-1., 0., 0.}, {.3, .3, 1.}};
    EXPECT_EQ(self_crossings(points, {{0, 1, 2}, {1, 3, 2}}).n_pairs, 0u); // an edge, unfolded
    EXPECT_EQ(self_crossings(points, {{0, 1, 2}, {1, 0, 4}}).n_pairs, 1u); // an edge, folded
    EXPECT_EQ(self_crossings(points, {{0, 1, 2}, {0, 5, 6}}).n_pairs, 0u); // a corner
    EXPECT_EQ(self_crossings(points, {{0, 1, 2}, {0, 3, 6}}).n_pairs, 1u); // a corner, and lying across
  }

  TEST(SurfaceDistance, IsThatToFacesEdgesAndCorners)
  {
    ClosedSurface tetrahedron;
    tetrahedron.nodes = {{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
    tetrahedron.faces = {{0, 2, 1, 0, 0, 0}, {0, 1, 3, 0, 0, 0}, {0, 3, 2, 0, 0, 0}, {1, 2, 3, 0, 0, 0}};
    const SurfaceDistance distance(tetrahedron);
    EXPECT_NEAR(distance.to({.2, .2, -.5}), .5, 1e-15);
    EXPECT_NEAR(distance.to({.5, -3., -4.}), 5., 1e-15);
    EXPECT_NEAR(distance.to({4., -3., 0.}), std::sqrt(18.), 1e-14);
    EXPECT_TRUE(distance.encloses({.1, .1, .1}));
    EXPECT_FALSE(distance.encloses({.5, .5, .5}));
    EXPECT_NEAR(distance_from_mirror_image(tetrahedron, 0.), 1., 1e-15);
  }
} // namespace swimtwin
