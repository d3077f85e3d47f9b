#include <rom/swimmer/energy_gradient.h>
#include <rom/swimmer/shape_amplitudes.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    /// Amplitudes, then their products.
    Eigen::VectorXd strain_monomials(const AmplitudeVector &p)
    {
      std::vector<double> m(p.begin(), p.end());
      for (int i = 0; i < p.size(); ++i)
        for (int j = 0; j <= i; ++j)
          m.push_back(p[i] * p[j]);
      return Eigen::Map<Eigen::VectorXd>(m.data(), static_cast<Eigen::Index>(m.size()));
    }

    Eigen::MatrixXd slopes_of_strain_monomials(const AmplitudeVector &p, const AmplitudeMatrix &J)
    {
      Eigen::MatrixXd slopes(strain_monomials(p).size(), J.cols());
      slopes.topRows(p.size()) = J;
      for (Eigen::Index i = 0, k = p.size(); i < p.size(); ++i)
        for (Eigen::Index j = 0; j <= i; ++j)
          slopes.row(k++) = p[j] * J.row(i) + p[i] * J.row(j);
      return slopes;
    }

    class EnergyGradients : public ::testing::TestWithParam<std::pair<int, int>>
    {
    protected:
      const ReducedModel model  = example_model({.n_modes = GetParam().first, .n_followers = GetParam().second});
      RandomNumbers      random = RandomNumbers(1);
    };
  } // namespace

  TEST_P(EnergyGradients, AreThoseOfTheStrainMonomials)
  {
    const auto            n    = strain_monomials(AmplitudeVector::Zero(model.tail.parity.size())).size();
    const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return random(); });
    const Eigen::MatrixXd gram = half + half.transpose();
    const EnergyGradient  gradient(gram, model.tail);
    const ShapeAmplitudes amplitudes(model.tail);
    for (int sample = 0; sample < 20; ++sample)
    {
      const ShapeVector     q        = random_shape(model, random, 1.5);
      const AmplitudeVector p        = amplitudes.value(q);
      const Eigen::MatrixXd slopes   = slopes_of_strain_monomials(p, amplitudes.slopes(q));
      const Eigen::VectorXd expected = slopes.transpose() * (gram * strain_monomials(p));
      EXPECT_LE((gradient.value(q) - expected).norm(), 1e-13 * expected.norm());
    }
  }

  TEST_P(EnergyGradients, SlopesAreTheirs)
  {
    const auto            n    = strain_monomials(AmplitudeVector::Zero(model.tail.parity.size())).size();
    const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return random(); });
    const EnergyGradient  gradient(half + half.transpose(), model.tail);
    constexpr double      step_m = 2e-6; // shapes are of order 1e-3
    const ShapeVector     q      = random_shape(model, random, 1.5);
    const ShapeMatrix     slopes = gradient.slopes(q);
    for (int k = 0; k < q.size(); ++k)
    {
      const auto at = [&](const double steps) {
        return gradient.value(q + steps * step_m * ShapeVector::Unit(q.size(), k));
      };
      const ShapeVector difference = (8. * (at(1.) - at(-1.)) - (at(2.) - at(-2.))) / (12. * step_m);
      EXPECT_LE((slopes.col(k) - difference).norm(), 1e-9 * slopes.norm());
    }
  }

  INSTANTIATE_TEST_SUITE_P(ModesAndFollowers, EnergyGradients,
                           ::testing::Values(std::pair{1, 0}, std::pair{3, 0}, std::pair{3, 2}, std::pair{4, 8}));
} // namespace swimtwin
