#include <rom/swimmer/resistance_surrogate.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    constexpr double largest_radius = 1.5, largest_angle_rad = 1.8;

    struct Sample
    {
      Eigen::VectorXd q;
      double          angle_rad = 0.;
    };

    class Resistances : public ::testing::TestWithParam<bool>
    {
    protected:
      Sample draw() { return {random_shape(model, random, largest_radius), largest_angle_rad * random()}; }

      Eigen::VectorXd mirror_of_velocities() const
      {
        Eigen::VectorXd mirror(model.n_modes() + 3);
        mirror << 1., -1., -1., model.tail.parity.head(model.n_modes()).cast<double>();
        return mirror;
      }

      const ReducedModel        model = example_model({.depends_on_angle = GetParam()});
      const ResistanceSurrogate resistance =
          ResistanceSurrogate(model.resistance, model.tail.parity.head(model.n_modes()));
      RandomNumbers random = RandomNumbers(2);
    };

    /// Polynomials by their definition.
    Eigen::MatrixXd resistance_by_definition(const ReducedResistance &r, const Eigen::VectorXd &q, const double angle)
    {
      const Eigen::Index n = r.factor_at_rest.rows();
      Eigen::VectorXd    z(r.exponents.cols());
      z.head(q.size()) = q.cwiseQuotient(r.coordinate_scale_m);
      z.head(q.size()) *= saturated(z.head(q.size()).norm()) / z.head(q.size()).norm();
      if (r.depends_on_angle)
        z[q.size()] = std::copysign(saturated(std::abs(angle) / r.angle_scale_rad), angle);
      Eigen::MatrixXd C = Eigen::MatrixXd::Zero(n, n);
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j <= i; ++j)
        {
          for (Eigen::Index f = 0; f < r.exponents.rows(); ++f)
          {
            double monomial = r.coefficients(f, i * (i + 1) / 2 + j);
            for (Eigen::Index k = 0; k < z.size(); ++k)
              monomial *= std::pow(z[k], r.exponents(f, k));
            C(i, j) += monomial;
          }
          if (i == j)
            C(i, i) = std::exp(C(i, i));
        }
      const Eigen::MatrixXd L = r.factor_at_rest * C;
      return L * L.transpose();
    }

    Eigen::MatrixXd scaled(const Eigen::MatrixXd &R)
    {
      const Eigen::VectorXd d = R.diagonal().cwiseSqrt().cwiseInverse();
      return d.asDiagonal() * R * d.asDiagonal();
    }
  } // namespace

  TEST_P(Resistances, AreTheirDefinition)
  {
    for (int i = 0; i < 50; ++i)
    {
      const auto [q, angle] = draw();
      EXPECT_TRUE(
          resistance.resistance(q, angle).isApprox(resistance_by_definition(model.resistance, q, angle), 1e-13));
    }
  }

  TEST_P(Resistances, ArePositiveDefiniteEverywhere)
  {
    for (int i = 0; i < 20'000; ++i)
    {
      const auto [q, angle]   = draw();
      const Eigen::MatrixXd R = scaled(resistance.resistance(q, angle));
      ASSERT_TRUE(R.allFinite());
      ASSERT_GT(R.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.);
    }
  }

  TEST_P(Resistances, MirroredShapesHaveMirroredResistance)
  {
    const Eigen::MatrixXd S = mirror_of_velocities().asDiagonal();
    for (int i = 0; i < 200; ++i)
    {
      const auto [q, angle]        = draw();
      const Eigen::VectorXd mirror = q.cwiseProduct(model.tail.parity.head(model.n_modes()).cast<double>());
      const Eigen::MatrixXd R = resistance.resistance(q, angle), mirrored = resistance.resistance(mirror, -angle);
      EXPECT_TRUE(mirrored.isApprox(S * R * S, 1e-14));
    }
  }

  TEST_P(Resistances, WithoutTheSymmetryUseEveryMonomial)
  {
    ReducedModel lopsided = model;
    lopsided.resistance.coefficients.array() += 0.01;
    const ResistanceSurrogate all(lopsided.resistance, lopsided.tail.parity.head(lopsided.n_modes()));
    const auto [q, angle] = draw();
    EXPECT_TRUE(all.resistance(q, angle).isApprox(resistance_by_definition(lopsided.resistance, q, angle), 1e-13));
  }

  TEST_P(Resistances, DerivativesOfTheFactorAreItsSlopes)
  {
    constexpr double step = 1e-6;
    ResistanceFactor here = resistance.make_factor(), after = here, before = here;
    for (int i = 0; i < 50; ++i)
    {
      const auto [q, angle] = draw();
      resistance.differentiate(q, angle, 0., here);
      for (int l = 0; l < resistance.n_coordinates(); ++l)
      {
        const bool   is_angle = l == q.size();
        const double h = step * (is_angle ? model.resistance.angle_scale_rad : model.resistance.coordinate_scale_m[l]);
        Eigen::VectorXd q_after = q, q_before = q;
        if (!is_angle)
        {
          q_after[l] += h;
          q_before[l] -= h;
        }
        resistance.evaluate(q_after, angle + (is_angle ? h : 0.), 0., after);
        resistance.evaluate(q_before, angle - (is_angle ? h : 0.), 0., before);
        Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(here.factor.rows(), here.factor.cols());
        for (int k = 0; k < resistance.n_coordinates(); ++k)
          slope += here.factor_derivatives[static_cast<std::size_t>(k)] * here.coordinate_slopes(k, l);
        EXPECT_LE((slope * h - (after.factor - before.factor) / 2.).norm(), 1e-8 * step);
      }
    }
  }

  INSTANTIATE_TEST_SUITE_P(WithAndWithoutAngle, Resistances, ::testing::Bool());
} // namespace swimtwin
