#include <fom/resistance/motion_inertia.h>

#include <fom/body/mesh_around.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    const std::vector<std::string> coarse_flow = {"numerics.mesh_size_m=6e-4", "numerics.mesh_size_corner_m=2e-4",
                                                  "numerics.mesh_size_far_m=4e-3", "numerics.mesh_growth=0.5"};

    /// A swimmer whose tail has two coordinates: it bends by q_1 (X^2, shortening with q_1^2) and stretches by q_2.
    class MotionInertiaTest : public ::testing::Test
    {
    protected:
      explicit MotionInertiaTest(const std::string &name = "reference-2d-casefile")
          : scene(shipped_scene(name, coarse_flow))
      {
      }

      NodalField<2> field(const std::function<Tensor<1, 2>(double)> &value) const
      {
        NodalField<2> result(swimmer.tail().mesh.n_nodes());
        for (unsigned int a = 0; a < result.size(); ++a)
          if (!swimmer.is_clamped(a))
            result[a] = value(swimmer.tail().mesh.nodes[a][0] - scene.head.size_m[0] / 2);
        return result;
      }

      NodalField<2> shape(const double bend, const double stretch) const
      {
        return field([&](const double s) {
          return Tensor<1, 2>({stretch * s - bend * bend * 50. * s * s * s, bend * 10. * s * s});
        });
      }

      BodyMotions<2> motions(const double bend) const
      {
        const auto along   = [](const double x) { return Tensor<1, 2>({x, 0.}); };
        const auto none    = field([](double) { return Tensor<1, 2>(); });
        const auto bends   = field([&](const double s) {
          return Tensor<1, 2>({-2. * bend * 50. * s * s * s, 10. * s * s});
        });
        const auto shorter = field([&](const double s) { return along(-2. * 50. * s * s * s); });
        return {{bends, field([&](const double s) { return along(s); })}, {{shorter, none}, {none, none}}};
      }

      Configuration<2> configuration(const double x, const double y, const double angle, const double bend,
                                     const double stretch) const
      {
        Configuration<2> c = swimmer.configuration_at_rest();
        c.pose.angle       = angle;
        c.pose.center += Tensor<1, 2>({x, y});
        c.shape = shape(bend, stretch);
        return c;
      }

      MotionInertia<2> of_fluid(const Configuration<2> &c, const double bend) const
      {
        const FluidDomain<2> fluid(scene, mesh_for_given_motions(swimmer, c, MPI_COMM_WORLD), c.pose);
        return compute_fluid_inertia(swimmer, fluid, c, motions(bend));
      }

      static double largest(const FullMatrix<double> &A) { return A.linfty_norm(); }

      Scene      scene;
      Swimmer<2> swimmer{scene, MPI_COMM_WORLD};
    };

    /// The entry's own size: sqrt(M_ii M_jj).
    double size(const FullMatrix<double> &M, const unsigned int i, const unsigned int j)
    {
      return std::sqrt(M(i, i) * M(j, j));
    }
  } // namespace

  TEST_F(MotionInertiaTest, MassIsSymmetricAndPositiveDefinite)
  {
    const auto M = of_fluid(configuration(0., 0., .4, 1., 0.), 1.).mass;
    for (unsigned int i = 0; i < M.m(); ++i)
      for (unsigned int j = 0; j < i; ++j)
        EXPECT_NEAR(M(i, j), M(j, i), 1e-12 * size(M, i, j));
    FullMatrix<double> factor(M.m(), M.m());
    EXPECT_NO_THROW(factor.cholesky(M));
  }

  // The derivative comes from one mesh by adjoint flows; the differences come from meshes of their own.
  TEST_F(MotionInertiaTest, SlopesOfTheMassAreItsDifferences)
  {
    const double x = 1e-3, y = 2e-3, angle = .4, bend = 1., stretch = .02;
    const auto   at    = of_fluid(configuration(x, y, angle, bend, stretch), bend);
    const auto   check = [&](const std::vector<std::pair<unsigned int, double>> &along, const double step,
                           const Configuration<2> &up, const double bend_up, const Configuration<2> &down,
                           const double bend_down) {
      const auto   M_up = of_fluid(up, bend_up).mass, M_down = of_fluid(down, bend_down).mass;
      double       worst = 0.;
      const double unit  = size(at.mass, along.front().first, along.front().first);
      for (unsigned int i = 0; i < M_up.m(); ++i)
        for (unsigned int j = 0; j < M_up.m(); ++j)
        {
          double slope = 0.;
          for (const auto &[k, velocity] : along)
            slope += velocity * at.mass_slopes[k](i, j);
          worst = std::max(worst, std::abs((M_up(i, j) - M_down(i, j)) / (2. * step) - slope) * std::sqrt(unit) /
                                        size(at.mass, i, j) / std::sqrt(unit));
        }
      return worst * step;
    };
    // Bounds: what a step of that size leaves, relative to M itself.
    const double h = .05;
    EXPECT_LT(check({{3, 1.}}, h, configuration(x, y, angle, bend + h, stretch), bend + h,
                    configuration(x, y, angle, bend - h, stretch), bend - h),
              2e-3);
    EXPECT_LT(check({{4, 1.}}, h, configuration(x, y, angle, bend, stretch + h), bend,
                    configuration(x, y, angle, bend, stretch - h), bend),
              2e-3);
    EXPECT_LT(check({{2, 1.}}, h, configuration(x, y, angle + h, bend, stretch), bend,
                    configuration(x, y, angle - h, bend, stretch), bend),
              2e-3);
    const double d = 5e-4;
    EXPECT_LT(check({{0, std::sin(angle)}, {1, std::cos(angle)}}, d, configuration(x, y + d, angle, bend, stretch),
                    bend, configuration(x, y - d, angle, bend, stretch), bend),
              2e-3);
  }

  /// Out of an open domain kinetic energy flows with the fluid.
  class ClosedMotionInertiaTest : public MotionInertiaTest
  {
  protected:
    ClosedMotionInertiaTest() : MotionInertiaTest("open-2d") {}
  };

  TEST_F(ClosedMotionInertiaTest, PowerIsTheRateOfTheKineticEnergy)
  {
    EXPECT_LT(of_fluid(configuration(0., 0., .4, 1., 0.), 1.).power_defect(), 1e-3);
    EXPECT_LT(compute_tail_inertia(swimmer, configuration(0., 0., .4, 1., 0.), motions(1.)).power_defect(), 1e-12);
  }

  TEST_F(MotionInertiaTest, RigidTailMovesAboutItsCentreOfMass)
  {
    const auto   tail = compute_tail_inertia(swimmer, configuration(0., 0., .4, 0., 0.), motions(0.));
    const double area = swimmer.elasticity().volume(), arm = tail.mass(1, 2) / area;
    EXPECT_NEAR(tail.mass(0, 0), area, 1e-12 * area);
    EXPECT_NEAR(tail.mass(0, 1), 0., 1e-12 * area);
    EXPECT_GT(arm, 2e-3); // a third of the way along a taper
    EXPECT_LT(arm, 4e-3);
    EXPECT_NEAR(tail.quadratic[0](2, 2), -area * arm, 1e-12 * area * arm); // centripetal
    EXPECT_NEAR(tail.quadratic[1](2, 0), .5 * area, 1e-12 * area);         // omega x U
  }
} // namespace swimtwin
