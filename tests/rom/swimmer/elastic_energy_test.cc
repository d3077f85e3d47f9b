#include <rom/swimmer/elastic_energy.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    constexpr double step_m = 2e-6; // of differences; shapes are of order 1e-3

    /// Fourth-order difference of f along e_k.
    template <typename Function>
    auto slope(const Function &f, const ShapeVector &q, const int k)
    {
      const auto at = [&](const double steps) {
        ShapeVector moved = q;
        moved[k] += steps * step_m;
        return f(moved);
      };
      using Value         = std::decay_t<decltype(at(1.))>;
      const Value central = (8. * (at(1.) - at(-1.)) - (at(2.) - at(-2.))) / (12. * step_m);
      return central;
    }

    class Energies : public ::testing::TestWithParam<std::pair<int, int>>
    {
    protected:
      const ReducedModel  model  = example_model({.n_modes = GetParam().first, .n_followers = GetParam().second});
      const ElasticEnergy energy = ElasticEnergy(model.elasticity, model.tail);
      RandomNumbers       random = RandomNumbers(1);
    };
  } // namespace

  TEST_P(Energies, GradientIsTheSlopeOfTheValue)
  {
    for (int sample = 0; sample < 20; ++sample)
    {
      const ShapeVector q        = random_shape(model, random, 1.5);
      const ShapeVector gradient = energy.gradient(q);
      for (int k = 0; k < model.n_modes(); ++k)
        EXPECT_NEAR(gradient[k], slope([&](const ShapeVector &p) { return energy.value(p); }, q, k),
                    1e-9 * gradient.norm());
    }
  }

  TEST_P(Energies, HessianIsTheSlopeOfTheGradient)
  {
    for (int sample = 0; sample < 20; ++sample)
    {
      const ShapeVector q       = random_shape(model, random, 1.5);
      const ShapeMatrix hessian = energy.hessian(q);
      EXPECT_LE((hessian - hessian.transpose()).norm(), 1e-14 * hessian.norm());
      for (int k = 0; k < model.n_modes(); ++k)
      {
        const ShapeVector difference = slope([&](const ShapeVector &p) { return energy.gradient(p); }, q, k);
        EXPECT_LE((hessian.col(k) - difference).norm(), 1e-9 * hessian.norm());
      }
    }
  }

  TEST_P(Energies, MirroredShapesHaveTheSameEnergy)
  {
    const ShapeVector q        = random_shape(model, random, 1.);
    const ShapeVector mirrored = q.cwiseProduct(model.tail.parity.head(model.n_modes()).cast<double>());
    EXPECT_NEAR(energy.value(mirrored), energy.value(q), 1e-14 * energy.value(q));
  }

  INSTANTIATE_TEST_SUITE_P(ModesAndFollowers, Energies,
                           ::testing::Values(std::pair{1, 0}, std::pair{1, 1}, std::pair{2, 0}, std::pair{4, 3},
                                             std::pair{8, 2}, std::pair{3, 8}));
} // namespace swimtwin
