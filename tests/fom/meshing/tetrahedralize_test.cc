#include <fom/meshing/tetrahedralize.h>

#include <datasets/system/error.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    void add_tetrahedron(TriangleSurface &surface, const Point<3> &corner, const double edge)
    {
      const unsigned int n = surface.vertices.size();
      surface.vertices.push_back(corner);
      for (int c = 0; c < 3; ++c)
      {
        Point<3> x = corner;
        x[c] += edge;
        surface.vertices.push_back(x);
      }
      for (const auto &[a, b, c] : {std::array{0u, 2u, 1u}, {0u, 1u, 3u}, {0u, 3u, 2u}, {1u, 2u, 3u}})
        surface.triangles.push_back({n + a, n + b, n + c});
    }

    /// Fluid in a tetrahedron with the edge 1 around one whose corner is at `at`.
    SimplexSoup<3> around_a_hole(const double at)
    {
      TriangleSurface surface;
      add_tetrahedron(surface, Point<3>(), 1.);
      surface.first_of_hole = surface.triangles.size();
      add_tetrahedron(surface, Point<3>(at, at, at), 0.2);
      return tetrahedralize(
          surface, [](const Point<3> &) { return 0.5; }, MPI_COMM_SELF);
    }
  } // namespace

  TEST(Tetrahedralize, FluidAroundAHole)
  {
    EXPECT_FALSE(around_a_hole(0.1).cells.empty());
  }

  TEST(Tetrahedralize, TrianglesThroughEachOtherAreSaidToBeInTooNarrowAGap)
  {
    std::string message;
    try
    {
      around_a_hole(0.3); // its three other corners are outside
    }
    catch (const ComputationError &error)
    {
      message = error.what();
    }
    EXPECT_NE(message.find("flat triangles of swimmer and walls go through each other"), std::string::npos) << message;
  }
} // namespace swimtwin
