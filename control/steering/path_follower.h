// Steering along a path: one Gauss-Newton step per decision, on the reduced model, over a few periods ahead.
#pragma once

#include <control/steering/mean_position.h>
#include <control/steering/path.h>
#include <control/steering/steered_field.h>
#include <rom/sensitivity/motion_linearisation.h>

namespace swimtwin
{
  struct FollowerOptions
  {
    double horizon_periods     = 3.;
    int    instants_per_period = 20;   ///< at which the horizon is looked at
    double relative_tolerance  = 1e-4; ///< of the model's motion
    double distance_scale      = 0.01; ///< body lengths: a distance from the path that matters
    double progress_scale      = 0.25; ///< body lengths: a lag along the path that matters
    double heading_scale_rad   = 0.;   ///< of the body against the path; 0: does not matter
    double turn_scale_rad      = 0.2;  ///< change of the angle's rate between knots that matters, rad per knot
    double max_turn_rad        = 0.5;  ///< between neighbouring coefficients of the angle
    double max_change_rad      = 0.5;  ///< of a coefficient by one step
  };

  /// What one decision did.
  struct FollowerStep
  {
    bool         completed = false;
    std::string  failure;              ///< one sentence
    double       arc_m           = 0.; ///< where on the path the mean position is now
    double       predicted_rms_m = 0.; ///< distance of the mean position over the horizon, before the step
    StoredMotion motion;               ///< of the plan before the step, over the horizon
  };

  /// Set up once for a swim; one thread each.
  class PathFollower
  {
  public:
    /// `advance_m`: of the swimmer per period, for how far to look ahead. `swimmer` must live as long.
    PathFollower(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters, const Path &path, double advance_m,
                 const FollowerOptions &options = {});

    /// What is known of the swimmer from now on. `position_sd_m`: of its position when a decision begins to act: the
    /// less it is known, the less it is acted on.
    void believe(const SwimmerParameters &parameters, const double position_sd_m)
    {
      parameters_    = parameters;
      position_sd_m_ = position_sd_m;
    }

    const Path            &path() const { return path_; }
    const FollowerOptions &options() const { return options_; }

    /// Improve the plan from the instant `committed` on, for a swimmer in this state now. Times in carrier periods.
    FollowerStep improve(SteeringPlan &plan, double now, double committed, const SwimmerState &state,
                         const MeanPosition &record, double arc_m);

  private:
    /// Rows of a least-squares problem for the changes of the window's coefficients.
    struct Rows
    {
      Eigen::MatrixXd matrix;
      Eigen::VectorXd residual;
      Eigen::Index    n = 0;
      void            add(const Eigen::RowVectorXd &row, double value);
    };
    struct MeanInstant
    {
      Eigen::Vector2d  position_m;
      Eigen::Matrix2Xd by_angles;
    };

    std::vector<LinearisedInstant> look_ahead(const SteeringPlan &plan, double now, const SwimmerState &state,
                                              FollowerStep &step);
    std::vector<MeanInstant>       means(const std::vector<LinearisedInstant> &ahead, double now,
                                         const MeanPosition &record) const;
    void add_path_rows(const std::vector<MeanInstant> &means, double &arc_m, FollowerStep &step, Rows &rows) const;
    void add_heading_rows(const std::vector<LinearisedInstant> &ahead, const std::vector<MeanInstant> &means,
                          double arc_m, Rows &rows) const;
    void add_turn_rows(const SteeringPlan &plan, Eigen::Index first, Rows &rows) const;
    void change(SteeringPlan &plan, Eigen::Index first, Eigen::Index first_free, const Rows &rows) const;

    const ReducedSwimmer &swimmer_;
    SwimmerParameters     parameters_;
    Path                  path_;
    double                advance_m_;
    FollowerOptions       options_;
    double                position_sd_m_ = 0.;
    MotionStore           store_;
    PhaseEquations        equations_;
  };
} // namespace swimtwin
