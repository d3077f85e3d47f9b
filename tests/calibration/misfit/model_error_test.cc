#include <calibration/misfit/model_error.h>

#include <datasets/reduced/held_out_error.h>
#include <tests/calibration/synthetic_curve.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    CalibrationData data_at(const int n)
    {
      return calibration_data({exact_curve(n, known_swimmer())});
    }

    Eigen::MatrixXd covariance(const ModelError &error)
    {
      return error.factor * error.factor.transpose();
    }
  } // namespace

  TEST(ModelError, IsOfTheHeldOutSizeAndHalfCommon)
  {
    const ModelError error = model_error(reference_model().record, {}, data_at(6), Eigen::VectorXd::Ones(6));
    EXPECT_EQ(error.origin, "held-out runs");
    double squares = 0.;
    for (const auto &run : reference_model().record.held_out_runs)
      squares += std::pow(relative_error(run, reference_model().record), 2) / 8.;
    EXPECT_NEAR(error.relative_size, std::sqrt(squares), 1e-5);
    const Eigen::MatrixXd C = covariance(error);
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(C(i, i), std::pow(error.relative_size, 2), 1e-3 * std::pow(error.relative_size, 2));
    EXPECT_NEAR(C(0, 5) / C(0, 0), 0.5 + 0.5 * std::exp(-0.5 * std::pow(std::log10(2. / 0.12) / 0.5, 2)), 2e-3);
  }

  TEST(ModelError, GrowsWhereItIsToldTo)
  {
    const Eigen::VectorXd growth = Eigen::VectorXd::LinSpaced(6, 1., 3.);
    const Eigen::MatrixXd plain  = covariance(model_error({}, 0.01, data_at(6), Eigen::VectorXd::Ones(6)));
    const Eigen::MatrixXd grown  = covariance(model_error({}, 0.01, data_at(6), growth));
    EXPECT_TRUE(grown.isApprox(Eigen::MatrixXd(growth.asDiagonal() * plain * growth.asDiagonal()), 1e-12));
  }

  TEST(ModelError, IsTheCovarianceOfItsFormulaToWhatItsComponentsKeep)
  {
    const CalibrationData data  = data_at(12);
    const ModelError      error = model_error({}, 0.02, data, Eigen::VectorXd::Ones(12));
    EXPECT_EQ(error.origin, "given");
    Eigen::MatrixXd formula(12, 12);
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j)
      {
        const double apart = std::log10(data.frequency_Hz[i] / data.frequency_Hz[j]) / error.decades;
        formula(i, j)      = 4e-4 * (0.5 + 0.5 * std::exp(-0.5 * apart * apart));
      }
    const Eigen::VectorXd left =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(formula - covariance(error)).eigenvalues();
    const double largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(formula).eigenvalues().maxCoeff();
    EXPECT_GT(left.minCoeff(), -1e-12 * largest); // only takes away
    EXPECT_LT(left.maxCoeff(), 1e-4 * largest);
    EXPECT_LT(error.n_components(), 12); // smooth in frequency: fewer components than observations
  }

  TEST(ModelError, IsNothingWithoutHeldOutRunsOrAGivenSize)
  {
    const ModelError none = model_error({}, {}, data_at(3), Eigen::VectorXd::Ones(3));
    EXPECT_EQ(none.origin, "none");
    EXPECT_EQ(none.relative_size, 0.);
    EXPECT_EQ(none.n_components(), 0);
    EXPECT_EQ(model_error(reference_model().record, 0., data_at(3), Eigen::VectorXd::Ones(3)).n_components(), 0);
  }

  TEST(ModelError, OfHeldOutRunsIsTheirRootMeanSquareAndLargestIndicator)
  {
    TrainingRecord record;
    EXPECT_EQ(displacement_error(record).rms, 0.);
    EXPECT_EQ(held_out_indicator(record), 0.);
    record.held_out_runs.resize(2);
    record.held_out_runs[0].displacement_m         = -2e-4; // backwards counts by its size
    record.held_out_runs[0].reduced_displacement_m = -2.06e-4;
    record.held_out_runs[0].indicator_m            = 4e-6;
    record.held_out_runs[1].displacement_m         = 1e-4;
    record.held_out_runs[1].reduced_displacement_m = 0.96e-4;
    record.held_out_runs[1].indicator_m            = 1e-6;
    EXPECT_NEAR(displacement_error(record).rms, std::sqrt((0.03 * 0.03 + 0.04 * 0.04) / 2.), 1e-12);
    EXPECT_NEAR(held_out_indicator(record), 0.02, 1e-12);
  }
} // namespace swimtwin
