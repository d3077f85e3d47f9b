#include <fom/geometry/turns_in_plane.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    TEST(TurnsInPlane, AreTheAngleOfARigidBodyWhereverItIsAndHoweverLargeItIs)
    {
      const SimplexMesh<3> mesh(
          {{{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}, {1., 1., 1.}}, {{0, 1, 2, 3}, {1, 4, 2, 3}}},
          MPI_COMM_SELF);
      for (const double angle : {0.3, -3., 3.1})
      {
        std::vector<Point<3>> positions;
        for (const auto &x : mesh.nodes)
          positions.emplace_back(2. + 1.5 * (std::cos(angle) * x[0] - std::sin(angle) * x[1]),
                                 1.5 * (std::sin(angle) * x[0] + std::cos(angle) * x[1]), -1. + 1.5 * x[2]);
        for (const double turn : turns_in_plane(mesh, positions))
          EXPECT_NEAR(turn, angle, 1e-12);
      }
    }

    TEST(TurnsInPlane, AreHalfOfAShear)
    {
      const SimplexMesh<2>  mesh({{{0., 0.}, {1., 0.}, {0., 1.}}, {{0, 1, 2}}}, MPI_COMM_SELF);
      std::vector<Point<2>> positions;
      for (const auto &x : mesh.nodes)
        positions.emplace_back(x[0], x[1] + 1e-4 * x[0]);
      for (const double turn : turns_in_plane(mesh, positions))
        EXPECT_NEAR(turn, .5e-4, 1e-10);
    }
  } // namespace
} // namespace swimtwin
