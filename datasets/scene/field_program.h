// The magnetic field played on the coils, as a function of time.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

namespace swimtwin
{
  /// Out of the plane of x and y: of a sinusoidal field an amplitude, and by how much it is ahead of by.
  struct FieldAlongZ
  {
    double bz_T = 0., phase_rad = 0.;
  };

  /// Magnetic flux density B(t) in tesla, components (x, y, z).
  class FieldProgram
  {
  public:
    enum class Waveform {
      none,       ///< B = 0
      constant,   ///< B = (bx, by, bz)
      sinusoidal, ///< B = (bx, by sin(2 pi f t), bz sin(2 pi f t + phase)): with bz = 0 the reference study's field
      sampled     ///< periodic, piecewise linear through the samples of a CSV file
    };

    FieldProgram() = default;

    static FieldProgram constant(double bx_T, double by_T, double bz_T = 0.);
    static FieldProgram sinusoidal(double bx_T, double by_T, double frequency_Hz, const FieldAlongZ &along_z = {});
    /// Samples (t, B) with strictly increasing t in [0, period); B(t + period) = B(t).
    static FieldProgram sampled(std::vector<double> time_s, std::vector<std::array<double, 3>> b_T, double period_s);
    /// Read a CSV `time_s,bx_T,by_T[,bz_T]`. Throws InputError naming file and line for a missing column, a value that
    /// is not a finite number, times that do not increase, and gaps (a step larger than 1.5 times the median step).
    /// Without a period (s), or with zero, it is that of the file beside the program (datasets/scene/field_period.h).
    static FieldProgram read_csv(const std::filesystem::path &file, double period_s = 0.);

    /// The field at time t (s), in T. Before `ramp_s` it is multiplied by t / ramp_s.
    std::array<double, 3> operator()(double time_s) const;

    Waveform waveform() const { return waveform_; }
    /// Period in s; 0 for a field without one.
    double period_s() const { return period_s_; }
    /// Amplitudes (T) of a constant or sinusoidal field.
    double bx_T() const { return bx_T_; }
    double by_T() const { return by_T_; }
    /// Whether it ever has a component along z.
    bool leaves_plane() const;
    /// Samples of a sampled field.
    const std::vector<double>                &time_s() const { return time_s_; }
    const std::vector<std::array<double, 3>> &b_T() const { return b_T_; }

    double                ramp_s = 0.;
    std::filesystem::path file; ///< that the samples were read from; empty otherwise

  private:
    Waveform                           waveform_ = Waveform::none;
    double                             bx_T_ = 0., by_T_ = 0., period_s_ = 0.;
    FieldAlongZ                        along_z_;
    std::vector<double>                time_s_;
    std::vector<std::array<double, 3>> b_T_;
  };
} // namespace swimtwin
