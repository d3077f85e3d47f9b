#include <datasets/system/error.h>
#include <rom/swimmer/driving_field.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  Eigen::Vector2d SinusoidalField::value_T(const double phase, const Eigen::VectorXd &parameters) const
  {
    return {parameters[0], parameters[1] * std::sin(2. * std::numbers::pi * phase)};
  }

  Eigen::Matrix2Xd SinusoidalField::slopes(const double phase, const Eigen::VectorXd & /*parameters*/) const
  {
    return Eigen::Vector2d(1., std::sin(2. * std::numbers::pi * phase)).asDiagonal().toDenseMatrix();
  }

  PiecewiseLinearField::PiecewiseLinearField(std::vector<double> phases) : phases_(std::move(phases)) {}

  std::vector<std::string> PiecewiseLinearField::parameter_names() const
  {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < phases_.size(); ++i)
      for (const char *component : {"bx", "by"})
        names.push_back(fmt::format("{}_{}_T", component, i));
    return names;
  }

  PiecewiseLinearField::Place PiecewiseLinearField::find(const double phase) const
  {
    double in_period = phase - std::floor(phase);
    if (in_period < phases_.front())
      in_period += 1.;
    const auto   after = std::upper_bound(phases_.begin(), phases_.end(), in_period);
    const auto   right = after == phases_.end() ? phases_.begin() : after;
    const auto   left  = std::prev(after);
    const double end   = after == phases_.end() ? 1. + phases_.front() : *after;
    return {left - phases_.begin(), right - phases_.begin(), (in_period - *left) / (end - *left)};
  }

  Eigen::Vector2d PiecewiseLinearField::value_T(const double phase, const Eigen::VectorXd &parameters) const
  {
    const auto [left, right, weight] = find(phase);
    return (1. - weight) * parameters.segment<2>(2 * left) + weight * parameters.segment<2>(2 * right);
  }

  Eigen::Matrix2Xd PiecewiseLinearField::slopes(const double phase, const Eigen::VectorXd &parameters) const
  {
    const auto [left, right, weight] = find(phase);
    Eigen::Matrix2Xd slopes          = Eigen::Matrix2Xd::Zero(2, parameters.size());
    slopes.middleCols<2>(2 * left) += (1. - weight) * Eigen::Matrix2d::Identity();
    slopes.middleCols<2>(2 * right) += weight * Eigen::Matrix2d::Identity();
    return slopes;
  }

  void PiecewiseLinearField::pull_back(const double           phase, const Eigen::VectorXd           &/*parameters*/,
                                       const Eigen::Vector2d &by_field, Eigen::Ref<Eigen::VectorXd> by_parameters) const
  {
    const auto [left, right, weight] = find(phase);
    by_parameters.segment<2>(2 * left) += (1. - weight) * by_field;
    by_parameters.segment<2>(2 * right) += weight * by_field;
  }

  namespace
  {
    Drive sampled_drive(const FieldProgram &program)
    {
      Drive               drive;
      std::vector<double> phases;
      drive.parameters.resize(2 * static_cast<Eigen::Index>(program.time_s().size()));
      for (std::size_t i = 0; i < program.time_s().size(); ++i)
      {
        phases.push_back(program.time_s()[i] / program.period_s());
        drive.parameters.segment<2>(2 * static_cast<Eigen::Index>(i)) << program.b_T()[i][0], program.b_T()[i][1];
      }
      drive.field = std::make_shared<PiecewiseLinearField>(std::move(phases));
      return drive;
    }
  } // namespace

  Drive make_drive(const FieldProgram &program)
  {
    if (program.period_s() <= 0.)
      throw InputError("[field] of the scene has no period, and the reduced swimmer needs a periodic field; give "
                       "waveform = \"sinusoidal\" or a field program.");
    if (program.ramp_s > 0.)
      throw InputError(
          fmt::format("[field] ramp_s = {} makes the field of the scene differ from period to period, which "
                      "the reduced swimmer does not follow; set it to 0.",
                      program.ramp_s));
    if (program.leaves_plane())
      throw InputError(fmt::format("{} has a component along z, and the reduced swimmer moves in the plane of x and y; "
                                   "set bz_T to zero, or simulate it in three dimensions.",
                                   program.file.empty() ? "[field] of the scene" : program.file.string()));
    Drive drive;
    if (program.waveform() == FieldProgram::Waveform::sampled)
      drive = sampled_drive(program);
    else
    {
      drive.field      = std::make_shared<SinusoidalField>();
      drive.parameters = Eigen::Vector2d(program.bx_T(), program.by_T());
    }
    drive.frequency_Hz = 1. / program.period_s();
    return drive;
  }
} // namespace swimtwin
