#include <fom/geometry/simplex_mesh.h>

#include <tests/fom/random_tensors.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;
    using Triangle = std::array<Point<2>, 6>;

    Triangle straight_triangle(const Point<2> &a, const Point<2> &b, const Point<2> &c)
    {
      const auto middle = [](const Point<2> &p, const Point<2> &q) { return Point<2>(.5 * (p + Tensor<1, 2>(q))); };
      return {a, b, c, middle(a, b), middle(b, c), middle(c, a)};
    }
    const Triangle equilateral = straight_triangle({0., 0.}, {1., 0.}, {.5, std::sqrt(3.) / 2.});

    Triangle scaled_and_turned(Triangle x, const double factor, const double angle)
    {
      for (auto &p : x)
        p = Point<2>(factor * (std::cos(angle) * p[0] - std::sin(angle) * p[1]) + 3.,
                     factor * (std::sin(angle) * p[0] + std::cos(angle) * p[1]) - 5.);
      return x;
    }

    /// Jacobian determinant at (r, s), from the shape functions written out.
    double determinant_at(const Triangle &x, const double r, const double s)
    {
      const double l     = 1. - r - s;
      const double dr[6] = {1. - 4. * l, 4. * r - 1., 0., 4. * (l - r), 4. * s, -4. * s};
      const double ds[6] = {1. - 4. * l, 0., 4. * s - 1., -4. * r, 4. * r, 4. * (l - s)};
      Tensor<1, 2> xr, xs;
      for (int a = 0; a < 6; ++a)
      {
        xr += dr[a] * Tensor<1, 2>(x[a]);
        xs += ds[a] * Tensor<1, 2>(x[a]);
      }
      return xr[0] * xs[1] - xr[1] * xs[0];
    }
  } // namespace

  TEST(ElementQuality, IsOneForAnEquilateralTriangleOfAnySizeAndPlace)
  {
    EXPECT_NEAR(element_quality(equilateral), 1., 1e-14);
    EXPECT_NEAR(element_quality(scaled_and_turned(equilateral, 1e-3, 0.7)), 1.,
                1e-10); // rounding of 5 over 1e-3, squared
  }

  TEST(ElementQuality, IsBelowOneForEveryOtherTriangle)
  {
    RandomNumbers random;
    for (int sample = 0; sample < 100; ++sample)
      EXPECT_LT(element_quality(straight_triangle(Point<2>(random.vector<2>()), Point<2>(random.vector<2>()),
                                                  Point<2>(random.vector<2>()))),
                1.);
  }

  TEST(ElementQuality, IsNegativeForAnInvertedAndZeroForAFlatTriangle)
  {
    EXPECT_LT(element_quality(straight_triangle({0., 0.}, {.5, 1.}, {1., 0.})), 0.);
    EXPECT_NEAR(element_quality(straight_triangle({0., 0.}, {1., 0.}, {2., 0.})), 0., 1e-15);
  }

  TEST(ElementQuality, IsNotPositiveForATriangleThatIsCurvedTooMuch)
  {
    Triangle x = equilateral;
    x[3] += Tensor<1, 2>({0., 0.5}); // the lower side bulges into the triangle
    EXPECT_LE(element_quality(x), 0.);
    x    = equilateral;
    x[3] = {0.2, 0.}; // beyond a quarter of the side the map folds at the vertex
    EXPECT_LE(element_quality(x), 0.);
    x[3] = {0.3, 0.};
    EXPECT_GT(element_quality(x), 0.);
  }

  TEST(ElementQuality, BoundsTheJacobianDeterminantFromBelow)
  {
    RandomNumbers random;
    for (int sample = 0; sample < 200; ++sample)
    {
      Triangle x = equilateral;
      for (int a = 3; a < 6; ++a)
        x[a] += 0.2 * random.vector<2>();
      double smallest = 1e9;
      for (int i = 0; i <= 20; ++i)
        for (int j = 0; i + j <= 20; ++j)
          smallest = std::min(smallest, determinant_at(x, i / 20., j / 20.));
      const double sides = 3.; // sum of squared sides of the straight triangle
      EXPECT_LE(element_quality(x), 2. * std::sqrt(3.) * smallest / sides + 1e-14);
    }
  }

  TEST(SimplexMesh, EdgesKnowTheirEndsAndCellsTheirNodes)
  {
    const SimplexSoup<2> soup{{{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}, {{0, 1, 2}, {0, 2, 3}}};
    const SimplexMesh<2> mesh(soup, MPI_COMM_WORLD);
    EXPECT_EQ(mesh.n_vertices(), 4u);
    EXPECT_EQ(mesh.n_cells(), 2u);
    EXPECT_EQ(mesh.n_nodes(), 9u);
    EXPECT_EQ(mesh.edges().size(), 5u);
    for (unsigned int e = 0; e < mesh.edges().size(); ++e)
    {
      const auto [a, b] = mesh.edges()[e];
      EXPECT_EQ(mesh.edge_node(a, b), mesh.n_vertices() + e);
      EXPECT_EQ(mesh.edge_node(b, a), mesh.n_vertices() + e);
      EXPECT_EQ(mesh.nodes[mesh.n_vertices() + e], Point<2>(.5 * (mesh.nodes[a] + Tensor<1, 2>(mesh.nodes[b]))));
    }
    constexpr unsigned int ends[3][2] = {{0, 1}, {1, 2}, {2, 0}};
    for (const auto &cell : mesh.cells)
      for (int l = 0; l < 3; ++l)
        EXPECT_EQ(cell[3 + l], mesh.edge_node(cell[ends[l][0]], cell[ends[l][1]]));
    EXPECT_THROW(mesh.edge_node(1, 3), std::out_of_range);
  }

  TEST(SimplexMesh, WorstQualityIsThatOfTheWorstCell)
  {
    const SimplexSoup<2> soup{{{0., 0.}, {1., 0.}, {.5, std::sqrt(3.) / 2.}, {.5, -.1}}, {{0, 1, 2}, {0, 3, 1}}};
    const SimplexMesh<2> mesh(soup, MPI_COMM_WORLD);
    EXPECT_NEAR(worst_quality(mesh, mesh.nodes), element_quality(straight_triangle({0., 0.}, {.5, -.1}, {1., 0.})),
                1e-14);
  }

  TEST(SimplexMesh, TetrahedraHaveTenNodes)
  {
    const SimplexSoup<3> soup{{{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}}, {{0, 1, 2, 3}}};
    const SimplexMesh<3> mesh(soup, MPI_COMM_WORLD);
    EXPECT_EQ(mesh.n_nodes(), 10u);
    EXPECT_EQ(mesh.nodes[mesh.edge_node(1, 3)], Point<3>(.5, 0., .5));
  }
} // namespace swimtwin
