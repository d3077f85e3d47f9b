#include <control/stroke/stroke_terms.h>
#include <optimization/guarded_search.h>
#include <tests/control/small_model.h>

#include <gtest/gtest.h>

#include <complex>
#include <numbers>

// In a small by around a constant bx the motion is linear, y = Re(Y exp(2 pi i k tau)), and the drift per period of the
// field is a quadratic form of its harmonics: by symmetry in time it is sum_k d_k |c_k|^2. The form is computed here
// from the linear response at rest and the second derivatives of the head's speed, without any integration in time.

namespace swimtwin
{
  namespace
  {
    constexpr double bx_T = 5e-3;

    class SmallStrokes : public ::testing::Test
    {
    protected:
      RateDerivatives derivatives(const SwimmerState &state, const double by) const
      {
        SwimmerMotion   motion = swimmer.make_motion();
        RateDerivatives d      = swimmer.make_derivatives();
        swimmer.differentiate(state, {bx_T, by}, request.parameters, motion, d);
        return d;
      }

      /// Second derivatives of dx/dt by (state, by), by differences of first ones.
      Eigen::MatrixXd second_derivatives() const
      {
        const int       n = swimmer.n_states();
        Eigen::MatrixXd H(n + 1, n + 1);
        const auto      row = [&](const SwimmerState &state, const double by) {
          const RateDerivatives d = derivatives(state, by);
          Eigen::RowVectorXd    r(n + 1);
          r << d.by_state.row(0), d.by_field(0, 1);
          return r;
        };
        for (int j = 0; j <= n; ++j)
        {
          const double h    = j == n ? 1e-6 : j > 2 ? 1e-7 : 1e-4;
          SwimmerState plus = SwimmerState::Zero(n), minus = plus;
          if (j < n)
          {
            plus[j] += h;
            minus[j] -= h;
          }
          H.row(j) = (row(plus, j == n ? h : 0.) - row(minus, j == n ? -h : 0.)) / (2. * h);
        }
        return H;
      }

      /// Displacement head first, in one period of the base frequency, per square of the k-th harmonic of by.
      double form(const int k) const
      {
        const RateDerivatives      rest = derivatives(SwimmerState::Zero(swimmer.n_states()), 0.);
        const int                  n = swimmer.n_states(), m = n - 2; // angle and shape
        const std::complex<double> i_omega(0., 2. * std::numbers::pi * k * request.drive.frequency_Hz);
        const Eigen::MatrixXcd A = i_omega * Eigen::MatrixXcd::Identity(m, m) - rest.by_state.bottomRightCorner(m, m);
        Eigen::VectorXcd       y = Eigen::VectorXcd::Zero(n + 1);
        y.segment(2, m)   = A.colPivHouseholderQr().solve(rest.by_field.col(1).tail(m).cast<std::complex<double>>());
        y[n]              = 1.;
        const double mean = 0.25 * (y.adjoint() * second_derivatives() * y).value().real();
        return -mean / request.drive.frequency_Hz;
      }

      double displacement(StrokeFinder &finder, const Eigen::VectorXd &coefficients, Eigen::RowVectorXd *slopes) const
      {
        RunRequest now       = request;
        now.drive.parameters = coefficients;
        const Stroke stroke  = finder.find(now, slopes != nullptr);
        EXPECT_TRUE(stroke.found()) << stroke.failure;
        const TermValue value = evaluate(StrokeTerm::displacement, swimmer, *field, stroke, 0.);
        if (slopes != nullptr)
          *slopes = value.slopes;
        return value.value;
      }

      static StrokeOptions options(const FourierField &of)
      {
        StrokeOptions options{.relative_tolerance = 1e-11, .closure = 1e-10, .n_samples = 4, .n_multipliers = 0};
        for (int i = 0; i < of.series().n_coefficients(); ++i)
          options.variables.push_back({Quantity::field, i});
        options.variables.push_back({Quantity::frequency, 0});
        return options;
      }

      SmallStrokes() { request.drive = {field, sinusoid_coefficients(*field, bx_T, 0.), 0.3}; }

      const ReducedModel                  model   = small_model();
      const ReducedSwimmer                swimmer = ReducedSwimmer(model);
      std::shared_ptr<const FourierField> field   = std::make_shared<FourierField>(3);
      RunRequest                          request = small_request(model);
    };
  } // namespace

  TEST_F(SmallStrokes, MoveByTheQuadraticFormOfTheirLinearResponse)
  {
    StrokeFinder finder(swimmer, options(*field));
    const auto  &series = field->series();
    const auto   error  = [&](const double size) {
      Eigen::VectorXd c      = sinusoid_coefficients(*field, bx_T, size);
      c[series.cosine(1, 2)] = 0.6 * size;
      c[series.sine(1, 3)]   = -0.8 * size;
      const double expected  = size * size * (form(1) + 0.36 * form(2) + 0.64 * form(3));
      return displacement(finder, c, nullptr) / expected - 1.;
    };
    const double coarse = error(4e-4), fine = error(2e-4);
    EXPECT_LT(std::abs(fine), 2e-2);
    EXPECT_NEAR(coarse / fine, 4., 0.4); // what is left is of second order
  }

  TEST_F(SmallStrokes, AreBestInTheFormsTopEigenvector)
  {
    constexpr double size   = 1e-4;
    const auto      &series = field->series();
    int              best   = 1;
    for (const int k : {2, 3})
      if (form(k) > form(best))
        best = k;
    std::vector<int> free;
    for (int k = 1; k <= 3; ++k)
    {
      if (k > 1)
        free.push_back(series.cosine(1, k));
      free.push_back(series.sine(1, k));
    }
    StrokeFinder        finder(swimmer, options(*field));
    const double        scale = size * size * form(best);
    MinimizationProblem problem;
    problem.lower         = Eigen::VectorXd::Constant(5, -2. * size);
    problem.upper         = Eigen::VectorXd::Constant(5, 2. * size);
    problem.scale         = Eigen::VectorXd::Constant(5, size);
    problem.n_constraints = 1;
    problem.evaluate      = [&](const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation) {
      Eigen::VectorXd c = sinusoid_coefficients(*field, bx_T, 0.);
      for (std::size_t i = 0; i < free.size(); ++i)
        c[free[i]] = x[static_cast<Eigen::Index>(i)];
      Eigen::RowVectorXd slopes;
      evaluation.objective   = -displacement(finder, c, derivatives ? &slopes : nullptr) / scale;
      evaluation.constraints = Eigen::VectorXd::Constant(1, x.squaredNorm() / (size * size) - 1.);
      if (!derivatives)
        return;
      evaluation.gradient.resize(5);
      for (std::size_t i = 0; i < free.size(); ++i)
        evaluation.gradient[static_cast<Eigen::Index>(i)] = -slopes[free[i]] / scale;
      evaluation.jacobian = 2. * x.transpose() / (size * size);
    };
    const Eigen::VectorXd start = 0.4 * size * Eigen::VectorXd::Ones(5); // a little of everything
    const Minimum found = search_minimum(problem, start, {.method = SearchMethod::ccsaq, .max_evaluations = 120});
    EXPECT_NEAR(found.objective, -1., 5e-3);
    for (std::size_t i = 0; i < free.size(); ++i)
      if (free[i] != series.sine(1, best) && free[i] != series.cosine(1, best))
      {
        EXPECT_LT(std::abs(found.x[static_cast<Eigen::Index>(i)]), 0.05 * size) << i;
      }
  }
} // namespace swimtwin
