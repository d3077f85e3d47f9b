// A reduced swimmer in a laboratory: parameters and camera drift and change, and its motion has a noise.
#pragma once

#include <twin/lab/laboratory_options.h>
#include <twin/lab/laboratory_swimmer.h>
#include <twin/measurement/tail_axis.h>

namespace swimtwin
{
  class ReducedLaboratorySwimmer : public LaboratorySwimmer
  {
  public:
    /// All but the options must live as long.
    ReducedLaboratorySwimmer(const ReducedSwimmer &swimmer, const TailAxis &axis, const FieldSignal &played,
                             const LaboratoryOptions &options);
    ReducedLaboratorySwimmer(const ReducedLaboratorySwimmer &)            = delete;
    ReducedLaboratorySwimmer &operator=(const ReducedLaboratorySwimmer &) = delete;

    void                     advance(double to_s, Chance &chance) override;
    Eigen::Vector2d          head_m() const override { return state_.head<2>(); }
    double                   angle_rad() const override { return state_[2]; }
    Eigen::Vector2d          tail_point_m(double share) const override;
    double                   camera(const TwinParameter p) const override { return state_[layout().place(p)]; }
    std::vector<std::string> truth_names() const override;
    /// Pose, shape and all parameters; without the velocities of one with inertia.
    Eigen::VectorXd truth() const override;

    const TwinLayout &layout() const { return process_.layout(); }
    /// The truth as a state of another layout.
    Eigen::VectorXd truth_in(const TwinLayout &layout) const;

  private:
    void apply_changes(double from_s, double to_s);

    const ReducedSwimmer     &swimmer_;
    const TailAxis           &axis_;
    TemperatureRamp           ramp_;
    std::vector<SuddenChange> changes_;
    double                    largest_step_s_;
    TwinProcess               process_;
    Eigen::VectorXd           state_;
    Eigen::MatrixXd           transition_, noise_;
    double                    now_s_ = 0.;
  };
} // namespace swimtwin
