// What a course through the plane is worth: terms to be added with weights, all differentiable.
#pragma once

#include <control/steering/path.h>
#include <rom/sensitivity/motion_functional.h>

#include <memory>
#include <utility>
#include <vector>

namespace swimtwin
{
  /// Squared distance of the head's centre from a target at the end, per squared scale.
  class TargetTerm : public MotionFunctional
  {
  public:
    TargetTerm(const Eigen::Vector2d &target_m, double scale_m) : target_m_(target_m), scale_m_(scale_m) {}

    double terminal(const Eigen::Ref<const Eigen::VectorXd> &state) const override;
    void   add_terminal_gradient(const Eigen::Ref<const Eigen::VectorXd> &state,
                                 Eigen::Ref<Eigen::VectorXd>              by_state) const override;

  private:
    Eigen::Vector2d target_m_;
    double          scale_m_;
  };

  /// Offset of the head's centre from a place at the end, along a direction, per scale.
  class OffsetTerm : public MotionFunctional
  {
  public:
    OffsetTerm(const Eigen::Vector2d &place_m, const Eigen::Vector2d &direction, double scale_m)
        : place_m_(place_m), by_position_1_m_(direction / scale_m)
    {
    }

    double terminal(const Eigen::Ref<const Eigen::VectorXd> &state) const override;
    void   add_terminal_gradient(const Eigen::Ref<const Eigen::VectorXd> &state,
                                 Eigen::Ref<Eigen::VectorXd>              by_state) const override;

  private:
    Eigen::Vector2d place_m_, by_position_1_m_;
  };

  struct TimedPathOptions
  {
    double speed_m_per_period = 0.; ///< of the point to be followed; it stops at the path's end
    double distance_scale_m   = 1e-3;
    double heading_scale_rad  = 0.; ///< of the body, head first, against the path; 0: does not matter
  };

  /// Integral over time of the squared distance of the head from a point that runs along a path, and of the squared
  /// angle of the body against the path, each per squared scale. Smooth in time as far as the path is.
  class TimedPathTerm : public MotionFunctional
  {
  public:
    TimedPathTerm(Path path, const TimedPathOptions &options) : path_(std::move(path)), options_(options) {}

    double running(const MotionInstant &instant) const override;
    void   add_running_gradient(const MotionInstant &instant, InstantGradient &gradient) const override;

  private:
    double heading_error(const MotionInstant &instant, const PathPlace &place) const;

    Path             path_;
    TimedPathOptions options_;
  };

  /// Integral over time of |B|^2 per squared scale: what coils turn into heat.
  class CopperLossTerm : public MotionFunctional
  {
  public:
    explicit CopperLossTerm(const double scale_T) : scale_T_(scale_T) {}

    double running(const MotionInstant &instant) const override;
    void   add_running_gradient(const MotionInstant &instant, InstantGradient &gradient) const override;

  private:
    double scale_T_;
  };

  /// Terms times their weights.
  class WeightedCourse : public MotionFunctional
  {
  public:
    void add(double weight, std::shared_ptr<const MotionFunctional> term) { terms_.emplace_back(weight, term); }

    double terminal(const Eigen::Ref<const Eigen::VectorXd> &state) const override;
    void   add_terminal_gradient(const Eigen::Ref<const Eigen::VectorXd> &state,
                                 Eigen::Ref<Eigen::VectorXd>              by_state) const override;
    double running(const MotionInstant &instant) const override;
    void   add_running_gradient(const MotionInstant &instant, InstantGradient &gradient) const override;

  private:
    std::vector<std::pair<double, std::shared_ptr<const MotionFunctional>>> terms_;
  };
} // namespace swimtwin
