// What a camera sees of the swimmer: where its head is and points, and where points of its tail are.
#pragma once

#include <twin/filter/system.h>
#include <twin/measurement/tail_axis.h>
#include <twin/motion/twin_process.h>

namespace swimtwin
{
  /// Kinds of observations (Sighting::kind).
  enum SightingKind {
    head_position, ///< m, in the camera's frame
    head_angle,    ///< rad, modulo a turn
    tail_point,    ///< m; `place`: the point's share of the tail's axis
    tail_distance  ///< m; a point of the tail whose place is not known: only its distance from the axis tells
  };

  /// First guesses of sigmas that are learned.
  struct FirstSigmas
  {
    double position_m = 0., angle_rad = 0.;
  };

  /// Seen is offset + scale R(rotation) x, at an instant that was stamped `delay` too late.
  class CameraSensor : public Sensor
  {
  public:
    /// All must live as long.
    CameraSensor(TwinProcess &process, const TailAxis &axis, const FirstSigmas &first_sigmas);

    Eigen::Index n_rows(const Sighting &observation) const override;
    double       first_sigma(int kind) const override;
    double       largest_residual(int kind) const override;
    void         look(const Sighting &observation, double time_s, const Eigen::VectorXd &state,
                      Eigen::Ref<Eigen::VectorXd> residual, Eigen::Ref<Eigen::MatrixXd> slopes) override;

    /// The delay at which stamps become instants of the filter. What the estimated delay differs from it is made up for
    /// to first order.
    double reference_delay_s = 0.;
    double instant_s(const double stamp_s) const { return stamp_s - reference_delay_s; }

    /// A point seen by the camera, in the laboratory.
    Eigen::Vector2d in_laboratory(const Eigen::Vector2d &seen_m, const Eigen::VectorXd &state) const;

  private:
    struct View
    {
      double          scale = 1., rotation = 0.;
      Eigen::Vector2d offset_m = Eigen::Vector2d::Zero();
    };
    View view(const Eigen::VectorXd &state) const;
    /// Of a point of the body (head's frame, its derivative by the shape), as the camera sees it.
    void see_point(const View &view, const SwimmerState &state, const Eigen::Vector2d &body_m, Eigen::Vector2d &seen_m);

    TwinProcess                             &process_;
    const TailAxis                          &axis_;
    FirstSigmas                              first_sigmas_;
    Eigen::Matrix<double, 2, Eigen::Dynamic> body_slopes_;  ///< 2 x r
    Eigen::MatrixXd                          point_slopes_; ///< 2 x n
  };
} // namespace swimtwin
