// Resistance of the reference swimmer, rigid and at rest in its box: structure and mesh convergence.
#include <fom/resistance/resistance.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    ResistanceResult<2> resistance_on_mesh(const double refinement)
    {
      const Scene      shipped = shipped_scene("reference-2d-casefile");
      const Scene      scene   = shipped_scene("reference-2d-casefile", refined(shipped, refinement));
      const Swimmer<2> swimmer(scene, MPI_COMM_WORLD);
      auto             r = compute_resistance(swimmer, swimmer.configuration_at_rest(), MPI_COMM_WORLD);
      std::cout << "resistance, mesh refined " << refinement << " times, " << r.n_unknowns << " unknowns: Rxx "
                << r.matrix(0, 0) << ", Ryy " << r.matrix(1, 1) << ", Ryw " << r.matrix(1, 2) << ", Rww "
                << r.matrix(2, 2) << ", Rxy " << r.matrix(0, 1) << ", Rxw " << r.matrix(0, 2) << ", asymmetry "
                << r.asymmetry << std::endl;
      return r;
    }

    /// An entry's size: of the entry itself, or, where symmetry makes it zero, of the diagonal entries that it couples.
    double relative_difference(const dealii::FullMatrix<double> &a, const dealii::FullMatrix<double> &b, const int i,
                               const int j)
    {
      const bool zero_by_symmetry = (i == 0) != (j == 0);
      return std::abs(a(i, j) - b(i, j)) / (zero_by_symmetry ? std::sqrt(b(i, i) * b(j, j)) : std::abs(b(i, j)));
    }
  } // namespace

  TEST(SwimmerResistance, IsSymmetricAndPositiveDefinite)
  {
    const auto  r = resistance_on_mesh(0.5);
    const auto &R = r.matrix;
    EXPECT_LE(r.asymmetry, 1e-10); // of a system solved to 1e-13
    EXPECT_GT(R(0, 0), 0.);
    EXPECT_GT(R(0, 0) * R(1, 1) - R(0, 1) * R(1, 0), 0.);
    EXPECT_GT(R.determinant(), 0.);
  }

  // Rxx converges slowest: with the open ends a motion along x drives a flow through the box, and where a no-slip wall
  // meets an open end the flow is singular (energy error of order 1.2). So the size far away matters, not the
  // swimmer's.
  TEST(SwimmerResistance, ShippedMeshGivesEveryEntryToTwoPermille)
  {
    const auto shipped = resistance_on_mesh(1.), fine = resistance_on_mesh(2.), finest = resistance_on_mesh(4.);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j)
      {
        std::cout << "  R" << i << j << ": shipped off by " << relative_difference(shipped.matrix, finest.matrix, i, j)
                  << ", refined twice by " << relative_difference(fine.matrix, finest.matrix, i, j) << std::endl;
        EXPECT_LE(relative_difference(shipped.matrix, finest.matrix, i, j), 2e-3);
      }
  }
} // namespace swimtwin
