#include <fom/resistance/resistance.h>

#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    const std::vector<std::string> coarse = {"numerics.mesh_size_m=4e-4", "numerics.mesh_size_corner_m=1e-4"};

    FullMatrix<double> resistance(const Scene &scene)
    {
      const Swimmer<2> swimmer(scene, MPI_COMM_WORLD);
      return compute_resistance(swimmer, swimmer.configuration_at_rest(), MPI_COMM_WORLD).matrix;
    }
    Scene with(const std::string &name, const std::string &entry)
    {
      auto overrides = coarse;
      overrides.push_back(entry);
      return shipped_scene(name, overrides);
    }
    double scale(const FullMatrix<double> &R, const int i, const int j)
    {
      return std::sqrt(R(i, i) * R(j, j));
    }
  } // namespace

  TEST(Resistance, IsProportionalToViscosity)
  {
    const auto R = resistance(with("reference-2d-casefile", "fluid.viscosity_Pa_s=1.52")),
               S = resistance(with("reference-2d-casefile", "fluid.viscosity_Pa_s=4.56"));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(S(i, j), 3. * R(i, j), 1e-11 * scale(R, i, j)); // of systems solved to 1e-13
  }

  // Blocks by physics know a rigid body too: what a system is too large for factors is iterated on.
  TEST(Resistance, IsTheSameByFactorsAndByIterations)
  {
    const auto of = [](const char *solver) {
      const Scene      scene = shipped_scene("reference-3d-paper",
                                             {"fluid.inertia=none", "numerics.mesh_size_m=1.2e-3",
                                              "numerics.mesh_size_corner_m=5e-4", "numerics.mesh_size_far_m=8e-3",
                                              "numerics.mesh_growth=1", std::string("numerics.linear_solver=") + solver});
      const Swimmer<3> swimmer(scene, MPI_COMM_WORLD);
      return compute_resistance(swimmer, swimmer.configuration_at_rest(), MPI_COMM_WORLD);
    };
    const auto factors = of("direct"), iterations = of("iterative");
    ASSERT_EQ(factors.matrix.m(), 3);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(iterations.matrix(i, j), factors.matrix(i, j), 1e-8 * scale(factors.matrix, i, j));
    EXPECT_LT(iterations.asymmetry, 1e-10);
    EXPECT_NE(iterations.matrix(0, 0), factors.matrix(0, 0)) << "the same arithmetic: nothing was iterated on";
  }

  // A mesh and its mirror image: entries that couple what is even with what is odd change sign, the others stay.
  TEST(Resistance, MirroredMeshGivesTheMirroredMatrix)
  {
    const auto R          = resistance(with("reference-2d-casefile", "numerics.mirror_meshes=false")),
               S          = resistance(with("reference-2d-casefile", "numerics.mirror_meshes=true"));
    const double parity[] = {1., -1., -1.};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(S(i, j), parity[i] * parity[j] * R(i, j), 1e-11 * scale(R, i, j));
  }
} // namespace swimtwin
