// The magnetic field as a function of phase, with its own parameters.
#pragma once

#include <datasets/scene/field_program.h>

#include <Eigen/Dense>

#include <memory>
#include <string>
#include <vector>

namespace swimtwin
{
  /// A family of fields B(phase; parameters) of period 1; the phase is time over the period. Objects are immutable, the
  /// parameters (T, unless their names say otherwise) come from outside.
  class DrivingField
  {
  public:
    virtual ~DrivingField() = default;

    virtual std::vector<std::string> parameter_names() const                                        = 0;
    virtual Eigen::Vector2d          value_T(double phase, const Eigen::VectorXd &parameters) const = 0;
    /// dB/dparameters, 2 x n.
    virtual Eigen::Matrix2Xd slopes(double phase, const Eigen::VectorXd &parameters) const = 0;
    /// Adds slopes^T by_field: a derivative by the field becomes one by the parameters. Fields with few parameters at a
    /// time do it without the matrix.
    virtual void pull_back(double phase, const Eigen::VectorXd &parameters, const Eigen::Vector2d &by_field,
                           Eigen::Ref<Eigen::VectorXd> by_parameters) const
    {
      by_parameters.noalias() += slopes(phase, parameters).transpose() * by_field;
    }
    /// Phases in [0, 1) where the field is continuous but its rate jumps: the integrator ends a step there.
    virtual std::vector<double> kinks() const { return {}; }
  };

  /// B = (bx, by sin 2 pi phase), the reference study's field; parameters bx_T, by_T.
  class SinusoidalField : public DrivingField
  {
  public:
    std::vector<std::string> parameter_names() const override { return {"bx_T", "by_T"}; }
    Eigen::Vector2d          value_T(double phase, const Eigen::VectorXd &parameters) const override;
    Eigen::Matrix2Xd         slopes(double phase, const Eigen::VectorXd &parameters) const override;
  };

  /// Piecewise linear and periodic through samples at fixed phases; parameters bx_0_T, by_0_T, bx_1_T, ...
  class PiecewiseLinearField : public DrivingField
  {
  public:
    /// Strictly increasing phases in [0, 1), at least one.
    explicit PiecewiseLinearField(std::vector<double> phases);

    std::vector<std::string> parameter_names() const override;
    Eigen::Vector2d          value_T(double phase, const Eigen::VectorXd &parameters) const override;
    Eigen::Matrix2Xd         slopes(double phase, const Eigen::VectorXd &parameters) const override;
    void                     pull_back(double phase, const Eigen::VectorXd &parameters, const Eigen::Vector2d &by_field,
                                       Eigen::Ref<Eigen::VectorXd> by_parameters) const override;
    std::vector<double>      kinks() const override { return phases_; }

  private:
    struct Place
    {
      Eigen::Index left = 0, right = 0;
      double       weight = 0.; ///< of the right one
    };
    Place find(double phase) const;

    std::vector<double> phases_;
  };

  /// A field, its parameters and its frequency: how often per second it repeats.
  struct Drive
  {
    std::shared_ptr<const DrivingField> field;
    Eigen::VectorXd                     parameters;
    double                              frequency_Hz = 0.;
  };

  /// The drive that plays a field program. Throws InputError for one without a period or with a ramp.
  Drive make_drive(const FieldProgram &program);
} // namespace swimtwin
