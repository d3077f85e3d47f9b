#include <calibration/misfit/model_error.h>
#include <datasets/reduced/held_out_error.h>

#include <rom/swimmer/dense_algebra.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Components of the error below this share of the largest variance are left out.
    constexpr double smallest_share = 1e-4;

    Eigen::MatrixXd correlation(const Eigen::VectorXd &frequency_Hz, const double decades)
    {
      const Eigen::ArrayXd  place = frequency_Hz.array().log10();
      const Eigen::MatrixXd apart =
          place.matrix().replicate(1, place.size()) - place.matrix().transpose().replicate(place.size(), 1);
      return (0.5 + 0.5 * (-0.5 * (apart.array() / decades).square()).exp()).matrix();
    }

    Eigen::MatrixXd square_root(const Eigen::MatrixXd &correlation)
    {
      const SymmetricEigen   eigen  = symmetric_eigen(correlation);
      const Eigen::VectorXd &values = eigen.values; // increasing
      const auto             kept   = (values.array() > smallest_share * values[values.size() - 1]).count();
      return eigen.vectors.rightCols(kept) * values.tail(kept).cwiseSqrt().asDiagonal();
    }
  } // namespace

  double held_out_indicator(const TrainingRecord &record)
  {
    double largest = 0.;
    for (const HeldOutRun &run : record.held_out_runs)
      largest = std::max(largest, std::abs(run.indicator_m / run.displacement_m));
    return largest;
  }

  ModelError model_error(const TrainingRecord &record, const std::optional<double> &given, const CalibrationData &data,
                         const Eigen::VectorXd &growth)
  {
    ModelError error;
    error.relative_size = given.value_or(displacement_error(record).rms);
    if (error.relative_size > 0.)
      error.origin = given ? "given" : "held-out runs";
    error.size = error.relative_size * growth;
    error.factor =
        error.relative_size > 0.
            ? Eigen::MatrixXd(error.size.asDiagonal() * square_root(correlation(data.frequency_Hz, error.decades)))
            : Eigen::MatrixXd(data.n(), 0);
    return error;
  }
} // namespace swimtwin
