// What the twin knows of swimmer, field and camera beside the swimmer's motion, and may have to learn.
#pragma once

#include <array>
#include <string>

namespace swimtwin
{
  /// In the order in which they stand in the state.
  enum class TwinParameter {
    stiffness,       ///< log of (E/mu over its start)
    magnetization,   ///< log of (M/mu over its start)
    background_x,    ///< constant field beside the coils', T
    background_y,    ///<
    flow_x,          ///< drift of the fluid, m/s
    flow_y,          ///<
    camera_scale,    ///< log of (length seen over true length)
    camera_rotation, ///< rad
    camera_offset_x, ///< m
    camera_offset_y, ///<
    camera_delay     ///< s: an instant is stamped later than it was, by this
  };
  inline constexpr int n_twin_parameters = 11;

  /// Key with its unit, as in TWIN.toml and in the stream.
  inline constexpr std::array<const char *, n_twin_parameters> twin_parameter_names = {
      "young_modulus_over_viscosity_log",
      "magnetization_over_viscosity_log",
      "background_bx_T",
      "background_by_T",
      "flow_x_m_s",
      "flow_y_m_s",
      "camera_scale_log",
      "camera_rotation_rad",
      "camera_offset_x_m",
      "camera_offset_y_m",
      "camera_delay_s"};
  inline constexpr std::array<const char *, n_twin_parameters> twin_parameter_units = {
      "1", "1", "T", "T", "m/s", "m/s", "1", "rad", "m", "m", "s"};

  /// A random walk from a first value; a standard deviation of 0 fixes it.
  struct DriftingParameter
  {
    double value = 0., standard_deviation = 0.;
    double drift = 0.; ///< standard deviation of its change in a second; it grows with the root of time

    bool is_estimated() const { return standard_deviation > 0.; }
  };

  struct TwinParameters
  {
    std::array<DriftingParameter, n_twin_parameters> list = {};
    /// Of the viscosity's logarithm in a second: stiffness and magnetization, each over viscosity, move together.
    double viscosity_drift = 0.;

    DriftingParameter       &operator[](const TwinParameter p) { return list[static_cast<std::size_t>(p)]; }
    const DriftingParameter &operator[](const TwinParameter p) const { return list[static_cast<std::size_t>(p)]; }
  };

  /// Where the estimated parameters stand in a state that begins with the swimmer's.
  class TwinLayout
  {
  public:
    TwinLayout(const TwinParameters &parameters, const int n_swimmer_states)
        : parameters_(parameters), n_swimmer_(n_swimmer_states), n_(n_swimmer_states)
    {
      for (int i = 0; i < n_twin_parameters; ++i)
        place_[static_cast<std::size_t>(i)] = parameters.list[static_cast<std::size_t>(i)].is_estimated() ? n_++ : -1;
    }

    const TwinParameters &parameters() const { return parameters_; }
    int                   n_swimmer() const { return n_swimmer_; }
    int                   n_states() const { return n_; }
    bool                  is_estimated(const TwinParameter p) const { return place(p) >= 0; }
    int                   place(const TwinParameter p) const { return place_[static_cast<std::size_t>(p)]; }
    template <typename Vector>
    double value(const TwinParameter p, const Vector &state) const
    {
      return is_estimated(p) ? state[place(p)] : parameters_[p].value;
    }

  private:
    TwinParameters                     parameters_;
    int                                n_swimmer_, n_;
    std::array<int, n_twin_parameters> place_ = {};
  };
} // namespace swimtwin
