#include <twin/measurement/camera_sensor.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    Eigen::Vector2d turned_left(const Eigen::Vector2d &v)
    {
      return {-v.y(), v.x()};
    }
  } // namespace

  CameraSensor::CameraSensor(TwinProcess &process, const TailAxis &axis, const FirstSigmas &first_sigmas)
      : process_(process), axis_(axis), first_sigmas_(first_sigmas), body_slopes_(2, process.swimmer().n_modes()),
        point_slopes_(2, process.n_states())
  {
  }

  Eigen::Index CameraSensor::n_rows(const Sighting &observation) const
  {
    return observation.kind == head_position || observation.kind == tail_point ? 2 : 1;
  }

  double CameraSensor::first_sigma(const int kind) const
  {
    return kind == head_angle ? first_sigmas_.angle_rad : first_sigmas_.position_m;
  }

  /// A fifth of the way to and fro, and half a swing.
  double CameraSensor::largest_residual(const int kind) const
  {
    constexpr double swing_rad = 0.5, way = 0.1; // body lengths
    return kind == head_angle ? swing_rad : way * process_.swimmer().length_m();
  }

  CameraSensor::View CameraSensor::view(const Eigen::VectorXd &state) const
  {
    const TwinLayout &layout = process_.layout();
    return {std::exp(layout.value(TwinParameter::camera_scale, state)),
            layout.value(TwinParameter::camera_rotation, state),
            {layout.value(TwinParameter::camera_offset_x, state), layout.value(TwinParameter::camera_offset_y, state)}};
  }

  Eigen::Vector2d CameraSensor::in_laboratory(const Eigen::Vector2d &seen_m, const Eigen::VectorXd &state) const
  {
    const View v = view(state);
    return Eigen::Rotation2Dd(-v.rotation) * (seen_m - v.offset_m) / v.scale;
  }

  /// point_slopes_ becomes the derivative of `seen_m` by the whole state, without that by the delay.
  void CameraSensor::see_point(const View &v, const SwimmerState &state, const Eigen::Vector2d &body_m,
                               Eigen::Vector2d &seen_m)
  {
    const TwinLayout     &layout = process_.layout();
    const Eigen::Matrix2d R      = Eigen::Rotation2Dd(v.rotation).toRotationMatrix(),
                          body   = Eigen::Rotation2Dd(state[2]).toRotationMatrix();
    const Eigen::Vector2d arm = body * body_m, seen = v.scale * (R * (state.head<2>() + arm));
    seen_m = v.offset_m + seen;
    point_slopes_.setZero();
    point_slopes_.leftCols<2>()                                = v.scale * R;
    point_slopes_.col(2)                                       = v.scale * (R * turned_left(arm));
    point_slopes_.middleCols(3, body_slopes_.cols()).noalias() = (v.scale * R * body).lazyProduct(body_slopes_);
    const auto set = [&](const TwinParameter p, const Eigen::Vector2d &slope) {
      if (layout.is_estimated(p))
        point_slopes_.col(layout.place(p)) = slope;
    };
    set(TwinParameter::camera_scale, seen);
    set(TwinParameter::camera_rotation, turned_left(seen));
    set(TwinParameter::camera_offset_x, Eigen::Vector2d::UnitX());
    set(TwinParameter::camera_offset_y, Eigen::Vector2d::UnitY());
  }

  void CameraSensor::look(const Sighting &observation, const double time_s, const Eigen::VectorXd &whole,
                          Eigen::Ref<Eigen::VectorXd> residual, Eigen::Ref<Eigen::MatrixXd> slopes)
  {
    const TwinLayout &layout     = process_.layout();
    const int         n          = layout.n_swimmer();
    const View        v          = view(whole);
    SwimmerState      state      = whole.head(n);
    const bool        is_delayed = layout.is_estimated(TwinParameter::camera_delay);
    VelocityVector    rate       = VelocityVector::Zero(n);
    if (is_delayed)
    {
      rate = process_.rate(time_s, whole);
      state += (reference_delay_s - whole[layout.place(TwinParameter::camera_delay)]) * rate;
    }
    body_slopes_.setZero();
    slopes.setZero();
    if (observation.kind == head_angle)
    {
      residual[0]  = std::remainder(observation.value[0] - state[2] - v.rotation, 2. * std::numbers::pi);
      slopes(0, 2) = 1.;
      if (layout.is_estimated(TwinParameter::camera_rotation))
        slopes(0, layout.place(TwinParameter::camera_rotation)) = 1.;
    }
    else
    {
      const ShapeVector q      = state.segment(3, process_.swimmer().n_modes());
      Eigen::Vector2d   body_m = Eigen::Vector2d::Zero(), seen_m;
      if (observation.kind == tail_point)
        body_m = axis_.position_m(observation.place, q, body_slopes_);
      Eigen::Vector2d normal = Eigen::Vector2d::Zero();
      if (observation.kind == tail_distance)
      {
        const Eigen::Vector2d laboratory = in_laboratory(observation.value, whole) - state.head<2>();
        const double          share = axis_.nearest(Eigen::Rotation2Dd(-state[2]) * laboratory, q), little = 0.01;
        const Eigen::Vector2d along = axis_.position_m(share + little, q) - axis_.position_m(share - little, q);
        normal                      = Eigen::Rotation2Dd(v.rotation + state[2]) * turned_left(along.normalized());
        body_m                      = axis_.position_m(share, q, body_slopes_);
      }
      see_point(v, state, body_m, seen_m);
      if (observation.kind == tail_distance)
      {
        residual[0]             = normal.dot(observation.value - seen_m);
        slopes.row(0).noalias() = normal.transpose().lazyProduct(point_slopes_);
      }
      else
      {
        residual = observation.value - seen_m;
        slopes   = point_slopes_;
      }
    }
    if (is_delayed)
      slopes.col(layout.place(TwinParameter::camera_delay)).noalias() = -slopes.leftCols(n).lazyProduct(rate);
  }
} // namespace swimtwin
