#include <twin/motion/field_signal.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  void FieldSignal::play(const double start_s, const Drive &drive)
  {
    const auto after = std::upper_bound(programs_.begin(), programs_.end(), start_s,
                                        [](const double t, const Program &p) { return t < p.start_s; });
    programs_.insert(after, {start_s, drive});
  }

  void FieldSignal::play_sinusoid(const double start_s, const double bx_T, const double by_T, const double frequency_Hz)
  {
    play(start_s, {std::make_shared<SinusoidalField>(), Eigen::Vector2d(bx_T, by_T), frequency_Hz});
  }

  void FieldSignal::add(const FieldSample &sample)
  {
    const auto after = std::upper_bound(samples_.begin(), samples_.end(), sample.time_s,
                                        [](const double t, const FieldSample &s) { return t < s.time_s; });
    if (after != samples_.begin() && std::prev(after)->time_s == sample.time_s)
      *std::prev(after) = sample;
    else
      samples_.insert(after, sample);
  }

  void FieldSignal::replace(const std::vector<FieldSample> &samples)
  {
    if (samples.empty())
      return;
    constexpr double same_s = 1e-6; // instants of two clocks that were added up in different ways
    while (!samples_.empty() && samples_.back().time_s > samples.front().time_s - same_s)
      samples_.pop_back();
    samples_.insert(samples_.end(), samples.begin(), samples.end());
  }

  void FieldSignal::forget_before(const double time_s)
  {
    while (programs_.size() > 1 && programs_[1].start_s <= time_s)
      programs_.erase(programs_.begin());
    while (samples_.size() > 1 && samples_[1].time_s <= time_s)
      samples_.pop_front();
  }

  const FieldSignal::Program *FieldSignal::program_at(const double time_s) const
  {
    const auto after = std::upper_bound(programs_.begin(), programs_.end(), time_s,
                                        [](const double t, const Program &p) { return t < p.start_s; });
    return after == programs_.begin() ? nullptr : &*std::prev(after);
  }

  const FieldSample *FieldSignal::sample_at(const double time_s) const
  {
    const auto after = std::upper_bound(samples_.begin(), samples_.end(), time_s,
                                        [](const double t, const FieldSample &s) { return t < s.time_s; });
    return after == samples_.begin() ? nullptr : &*std::prev(after);
  }

  /// Null where a program began later, or nothing was sampled.
  const FieldSample *FieldSignal::holding_sample(const double time_s) const
  {
    const Program     *program = program_at(time_s);
    const FieldSample *sample  = sample_at(time_s);
    return sample != nullptr && (program == nullptr || program->start_s <= sample->time_s) ? sample : nullptr;
  }

  Eigen::Vector2d FieldSignal::value_T(const double time_s) const
  {
    if (const FieldSample *sample = holding_sample(time_s))
    {
      const auto after = std::upper_bound(samples_.begin(), samples_.end(), time_s,
                                          [](const double t, const FieldSample &s) { return t < s.time_s; });
      if (after == samples_.end())
        return sample->field_T;
      const double share = (time_s - sample->time_s) / (after->time_s - sample->time_s);
      return (1. - share) * sample->field_T + share * after->field_T;
    }
    const Program *program = program_at(time_s);
    if (program == nullptr)
      return Eigen::Vector2d::Zero();
    const double periods = (time_s - program->start_s) * program->drive.frequency_Hz;
    return program->drive.field->value_T(periods - std::floor(periods), program->drive.parameters);
  }

  double FieldSignal::sigma_T(const double time_s) const
  {
    const FieldSample *sample = holding_sample(time_s);
    return sample != nullptr ? sample->sigma_T : 0.;
  }

  double FieldSignal::frequency_Hz(const double time_s) const
  {
    const Program *program = program_at(time_s);
    return holding_sample(time_s) != nullptr || program == nullptr ? 0. : program->drive.frequency_Hz;
  }
} // namespace swimtwin
