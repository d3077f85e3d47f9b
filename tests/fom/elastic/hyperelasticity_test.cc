#include <fom/elastic/hyperelasticity.h>

#include <tests/fom/random_tensors.h>

#include <deal.II/base/symmetric_tensor.h>
#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    const LameConstants lame = lame_constants(2.5, 0.35);

    /// Central differences of step h err by h^2 times a third derivative (below 1e3 stiffnesses while det F > 0.4) and
    /// by rounding over h (1e-16 / 1e-5): 1e-7 relative to the stiffness.
    constexpr double step = 1e-5, difference_tolerance = 1e-7;

    /// Call a check with both laws in both dimensions, at ten random deformations each.
    template <typename Check>
    void for_all_laws(const Check &check)
    {
      const auto in_dimension = [&]<int dim>(std::integral_constant<int, dim>) {
        for (const auto model : {MaterialModel::st_venant_kirchhoff, MaterialModel::neo_hookean})
        {
          SCOPED_TRACE((model == MaterialModel::neo_hookean ? "neo-Hookean, " : "St Venant-Kirchhoff, ") +
                       std::to_string(dim) + "D");
          const auto    law = make_law<dim>(model, lame);
          RandomNumbers random;
          for (int sample = 0; sample < 10; ++sample)
            check(*law, random.deformation_gradient<dim>(), random);
        }
      };
      in_dimension(std::integral_constant<int, 2>());
      in_dimension(std::integral_constant<int, 3>());
    }

    template <int dim>
    Tensor<2, dim> unit(const int i, const int j)
    {
      Tensor<2, dim> e;
      e[i][j] = 1.;
      return e;
    }
  } // namespace

  TEST(Hyperelasticity, StressIsTheDerivativeOfTheEnergy)
  {
    for_all_laws([]<int dim>(const HyperelasticLaw<dim> &law, const Tensor<2, dim> &F, RandomNumbers &) {
      const auto P = law.stress(F);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
        {
          const auto   dF         = step * unit<dim>(i, j);
          const double difference = (law.energy(F + dF) - law.energy(F - dF)) / (2. * step);
          EXPECT_NEAR(P[i][j], difference, difference_tolerance * lame.mu_Pa);
        }
    });
  }

  TEST(Hyperelasticity, TangentIsTheDerivativeOfTheStress)
  {
    for_all_laws([]<int dim>(const HyperelasticLaw<dim> &law, const Tensor<2, dim> &F, RandomNumbers &) {
      const auto response = law.respond(F);
      EXPECT_LE((response.stress - law.stress(F)).norm(),
                1e-14 * response.stress.norm()); // the same sums, ordered otherwise
      for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l)
        {
          const auto dF         = step * unit<dim>(k, l);
          const auto difference = (law.stress(F + dF) - law.stress(F - dF)) / (2. * step);
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              EXPECT_NEAR(response.tangent[i][j][k][l], difference[i][j],
                          difference_tolerance * (lame.lambda_Pa + lame.mu_Pa));
        }
    });
  }

  TEST(Hyperelasticity, EnergyIsFrameIndifferentAndStressTurnsWithTheFrame)
  {
    for_all_laws([]<int dim>(const HyperelasticLaw<dim> &law, const Tensor<2, dim> &F, RandomNumbers &random) {
      const Tensor<2, dim> Q = random.rotation<dim>();
      // A dozen roundings, of terms that are at most a few times the stiffness.
      EXPECT_NEAR(law.energy(Q * F), law.energy(F), 1e-13 * lame.mu_Pa);
      EXPECT_LE((law.stress(Q * F) - Q * law.stress(F)).norm(), 1e-13 * lame.mu_Pa);
    });
  }

  TEST(Hyperelasticity, RestIsFreeOfStressAndEnergy)
  {
    for_all_laws([]<int dim>(const HyperelasticLaw<dim> &law, const Tensor<2, dim> &, RandomNumbers &) {
      const Tensor<2, dim> one = unit_symmetric_tensor<dim>();
      EXPECT_EQ(law.energy(one), 0.);
      EXPECT_EQ(law.stress(one).norm(), 0.);
    });
  }

  // P(1 + h H) = h (lambda tr(e) 1 + 2 mu e) + O(h^2), e = sym H: at h = 1e-6 the relative rest is a few h.
  TEST(Hyperelasticity, SmallStrainIsLinearElasticityWithTheLameConstants)
  {
    for_all_laws([]<int dim>(const HyperelasticLaw<dim> &law, const Tensor<2, dim> &, RandomNumbers &random) {
      constexpr double     h   = 1e-6;
      const Tensor<2, dim> one = unit_symmetric_tensor<dim>(), H = random.matrix<dim>(), e = .5 * (H + transpose(H));
      const Tensor<2, dim> linear = lame.lambda_Pa * trace(e) * one + 2. * lame.mu_Pa * e;
      EXPECT_LE((law.stress(one + h * H) / h - linear).norm(), 20. * h * (lame.lambda_Pa + lame.mu_Pa));
    });
  }

  // Uniaxial stress in 3D: stretch 1 / E along, -nu / E across.
  TEST(Hyperelasticity, LameConstantsAreThoseOfYoungAndPoisson)
  {
    constexpr double young = 2.5, poisson = 0.35;
    Tensor<2, 3>     e;
    e[0][0] = 1. / young;
    e[1][1] = e[2][2]    = -poisson / young;
    const double trace_e = trace(e);
    EXPECT_NEAR(lame.lambda_Pa * trace_e + 2. * lame.mu_Pa * e[0][0], 1., 1e-14);
    EXPECT_NEAR(lame.lambda_Pa * trace_e + 2. * lame.mu_Pa * e[1][1], 0., 1e-14);
  }

  TEST(Hyperelasticity, NeoHookeanEnergyIsInfiniteWhereMaterialIsTurnedInsideOut)
  {
    Tensor<2, 2> F = unit_symmetric_tensor<2>();
    F[0][0]        = -0.5;
    EXPECT_TRUE(std::isinf(make_law<2>(MaterialModel::neo_hookean, lame)->energy(F)));
  }
} // namespace swimtwin
