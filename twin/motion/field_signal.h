// The magnetic field over the clock's time, as it is known: played programs and single samples.
#pragma once

#include <rom/swimmer/driving_field.h>

#include <deque>
#include <vector>

namespace swimtwin
{
  /// A sample of a field that is commanded or measured.
  struct FieldSample
  {
    double          time_s  = 0.;
    Eigen::Vector2d field_T = Eigen::Vector2d::Zero();
    double          sigma_T = 0.; ///< of a measured one
  };

  /// What holds at an instant is what began last: a drive since its start, or samples, linear in between and kept after
  /// the last one. Zero before everything.
  class FieldSignal
  {
  public:
    /// Phase 0 is at the start.
    void play(double start_s, const Drive &drive);
    /// A sinusoid (bx, by sin 2 pi f (t - start)).
    void play_sinusoid(double start_s, double bx_T, double by_T, double frequency_Hz);
    /// In any order.
    void add(const FieldSample &sample);
    /// In order; what was to be played from the first of them on is not.
    void replace(const std::vector<FieldSample> &samples);
    /// What ended before an instant is not needed any more.
    void forget_before(double time_s);

    Eigen::Vector2d value_T(double time_s) const;
    double          sigma_T(double time_s) const;
    /// Of the drive that plays at this instant; 0 without one.
    double frequency_Hz(double time_s) const;

    struct Program
    {
      double start_s = 0.;
      Drive  drive;
    };
    const std::vector<Program>    &programs() const { return programs_; }
    const std::deque<FieldSample> &samples() const { return samples_; }

    /// What began last at an instant; null before everything.
    const Program *program_at(double time_s) const;

  private:
    const FieldSample *sample_at(double time_s) const; ///< the last one before it
    const FieldSample *holding_sample(double time_s) const;

    std::vector<Program>    programs_; ///< by start
    std::deque<FieldSample> samples_;  ///< by time
  };
} // namespace swimtwin
