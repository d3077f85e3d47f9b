#include <fom/meshing/triangulate.h>

#include <datasets/system/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    /// A rectangle with a triangular hole off its middle, finer near the hole.
    PlanarRegion example_region()
    {
      PlanarRegion region;
      region.outer = {{-2., -1.}, {0., -1.}, {2., -1.}, {2., 0.1}, {2., 1.}, {-2., 1.}};
      region.holes = {{{0.3, 0.1}, {0.9, 0.2}, {0.5, 0.6}}};
      region.size  = [](const Point<2> &x) { return 0.15 + 0.2 * x.distance({0.5, 0.3}); };
      return region;
    }
    double polygon_area(const std::vector<Point<2>> &p)
    {
      double twice = 0.;
      for (unsigned int i = 0; i < p.size(); ++i)
      {
        const auto &a = p[i], &b = p[(i + 1) % p.size()];
        twice += a[0] * b[1] - a[1] * b[0];
      }
      return twice / 2.;
    }
    double cell_area(const SimplexSoup<2> &soup, const std::array<unsigned int, 3> &cell)
    {
      return polygon_area({soup.vertices[cell[0]], soup.vertices[cell[1]], soup.vertices[cell[2]]});
    }
  } // namespace

  TEST(Triangulate, KeepsTheBoundaryPointForPointAndEdgeForEdge)
  {
    const PlanarRegion region = example_region();
    const auto         soup   = triangulate(region, MPI_COMM_WORLD);
    for (unsigned int i = 0; i < region.outer.size(); ++i)
      EXPECT_EQ(soup.vertices[i], region.outer[i]);
    for (unsigned int i = 0; i < region.holes[0].size(); ++i)
      EXPECT_EQ(soup.vertices[region.outer.size() + i], region.holes[0][i]);

    std::map<std::pair<unsigned int, unsigned int>, int> n_cells_at_edge;
    for (const auto &cell : soup.cells)
      for (int i = 0; i < 3; ++i)
        ++n_cells_at_edge[std::minmax({cell[i], cell[(i + 1) % 3]})];
    const auto n_boundary =
        std::count_if(n_cells_at_edge.begin(), n_cells_at_edge.end(), [](const auto &e) { return e.second == 1; });
    EXPECT_EQ(n_boundary, 9);
    for (unsigned int i = 0; i < 6; ++i)
    {
      const unsigned int next = (i + 1) % 6;
      EXPECT_EQ((n_cells_at_edge[std::minmax({i, next})]), 1);
    }
  }

  TEST(Triangulate, CoversTheRegionWithPositiveTriangles)
  {
    const PlanarRegion region = example_region();
    const auto         soup   = triangulate(region, MPI_COMM_WORLD);
    double             area   = 0.;
    for (const auto &cell : soup.cells)
    {
      EXPECT_GT(cell_area(soup, cell), 0.);
      area += cell_area(soup, cell);
    }
    EXPECT_NEAR(area, polygon_area(region.outer) - polygon_area(region.holes[0]), 1e-13);
    // Euler: without a point inside there are (boundary points) + 2 (holes) - 2 triangles. The size field asks for
    // more.
    EXPECT_GT(soup.cells.size(), 9u);
  }

  TEST(Triangulate, SameRegionGivesTheSameMeshWhateverWasMeshedBefore)
  {
    const auto   first = triangulate(example_region(), MPI_COMM_WORLD);
    PlanarRegion other = example_region();
    other.size         = [](const Point<2> &) { return 0.3; };
    triangulate(other, MPI_COMM_WORLD);
    const auto again = triangulate(example_region(), MPI_COMM_WORLD);
    EXPECT_EQ(first.vertices, again.vertices);
    EXPECT_EQ(first.cells, again.cells);
  }

  TEST(Triangulate, IsTheSameInOtherUnits)
  {
    PlanarRegion small = example_region();
    const auto   size  = small.size;
    for (auto *polygon : {&small.outer, &small.holes[0]})
      for (auto &x : *polygon)
        x *= 0x1p-10; // a power of two: no rounding
    small.size   = [&](const Point<2> &x) { return size(Point<2>(0x1p10 * Tensor<1, 2>(x))) * 0x1p-10; };
    const auto a = triangulate(example_region(), MPI_COMM_WORLD), b = triangulate(small, MPI_COMM_WORLD);
    EXPECT_EQ(a.cells, b.cells);
  }

  // The reflected region with `mirror` is the reflection of the region's own mesh, bit for bit.
  TEST(Triangulate, MirrorGivesTheReflectedMeshOfTheReflectedRegion)
  {
    const auto   reflected = [](const Point<2> &x) { return Point<2>(x[0], -x[1]); };
    const auto   plain     = triangulate(example_region(), MPI_COMM_WORLD);
    PlanarRegion image     = example_region();
    image.mirror           = true;
    image.size             = [&](const Point<2> &x) { return example_region().size(reflected(x)); };
    for (auto *polygon : {&image.outer, &image.holes[0]})
    {
      std::reverse(polygon->begin() + 1, polygon->end());
      for (auto &x : *polygon)
        x = reflected(x);
    }
    const auto mirrored = triangulate(image, MPI_COMM_WORLD);
    ASSERT_EQ(mirrored.vertices.size(), plain.vertices.size());
    ASSERT_EQ(mirrored.cells.size(), plain.cells.size());
    using Corners          = std::array<std::array<double, 2>, 3>;
    const auto corner_list = [&](const SimplexSoup<2> &soup, const double sign) {
      std::vector<Corners> list;
      for (const auto &cell : soup.cells)
      {
        Corners corners;
        for (int v = 0; v < 3; ++v)
          corners[v] = {soup.vertices[cell[v]][0], sign * soup.vertices[cell[v]][1]};
        std::sort(corners.begin(), corners.end());
        list.push_back(corners);
      }
      std::sort(list.begin(), list.end());
      return list;
    };
    EXPECT_EQ(corner_list(mirrored, 1.), corner_list(plain, -1.));
  }

  // Pieces of one straight side are on a line but for round-off, which must not make them cross each other.
  TEST(Triangulate, StraightSidesInPiecesCrossNothingHoweverTheyAreTurned)
  {
    constexpr int n_pieces = 24, n_angles = 200;
    for (int k = 0; k < n_angles; ++k)
    {
      const double   angle = -1. + 2. * k / n_angles;
      PlanarRegion   bar;
      const Point<2> corners[] = {{0., 0.}, {1.1e-3, 0.}, {1.1e-3, 3e-4}, {0., 3e-4}};
      for (int side = 0; side < 4; ++side)
        for (int i = 0; i < n_pieces; ++i)
        {
          const double   share = std::pow(double(i) / n_pieces, 1.3);
          const Point<2> x     = corners[side] + share * (corners[(side + 1) % 4] - corners[side]);
          bar.outer.emplace_back(std::cos(angle) * x[0] - std::sin(angle) * x[1],
                                 std::sin(angle) * x[0] + std::cos(angle) * x[1]);
        }
      bar.size = [](const Point<2> &) { return 1e-3; };
      EXPECT_NO_THROW(triangulate(bar, MPI_COMM_WORLD)) << angle;
    }
  }

  TEST(Triangulate, CrossingOutlinesAreAFailureThatSaysWhatToCheck)
  {
    PlanarRegion bow_tie;
    bow_tie.outer = {{0., 0.}, {1., 1.}, {1., 0.}, {0., 1.}};
    bow_tie.size  = [](const Point<2> &) { return 0.2; };
    try
    {
      triangulate(bow_tie, MPI_COMM_WORLD);
      FAIL() << "no exception";
    }
    catch (const ComputationError &failure)
    {
      EXPECT_NE(std::string(failure.what()).find("outlines do not cross"), std::string::npos) << failure.what();
    }
  }
} // namespace swimtwin
