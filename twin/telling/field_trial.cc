#include <twin/telling/field_trial.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Kind, place and sigma of what the latest frame showed, as the filter weighed it.
    std::vector<Sighting> seen_at(const FilterNode &node)
    {
      std::vector<Sighting> seen = node.observations;
      for (Sighting &s : seen)
        if (s.sigma == 0.)
          s.sigma = node.noise_levels[static_cast<std::size_t>(s.kind)].sigma();
      return seen;
    }
  } // namespace

  FieldTrial::FieldTrial(const ReducedModel &model, const TwinOptions &options)
      : model_(model, options), algebra_(model_.process.n_states(), model_.process.n_noises())
  {
  }

  void FieldTrial::begin(const SwimmerTwin &twin, const Drive &drive, const double drive_start_s)
  {
    const WindowFilter &filter      = twin.filter();
    now_                            = twin.belief();
    now_s_                          = twin.now_s();
    model_.camera.reference_delay_s = twin.camera().reference_delay_s;
    drive_                          = drive;
    drive_start_s_                  = drive_start_s;
    int last = filter.n_nodes() - 1, n_frames = 0; // instants at which something was seen
    for (int i = 0; i < filter.n_nodes(); ++i)
      if (!filter.node(i).observations.empty())
      {
        last = i;
        ++n_frames;
      }
    seen_             = seen_at(filter.node(last));
    frame_interval_s_ = std::max((now_s_ - filter.node(0).time_s) / std::max(n_frames - 1, 1), 1e-3);
  }

  /// As expected: the mean stays.
  bool FieldTrial::take_in_frame(const double time_s)
  {
    for (const Sighting &s : seen_)
    {
      const Eigen::Index rows = model_.camera.n_rows(s);
      residual_.resize(rows);
      slopes_.resize(rows, model_.process.n_states());
      model_.camera.look(s, time_s, belief_.mean, residual_, slopes_);
      residual_.setZero();
      algebra_.update(residual_, slopes_, s.sigma, belief_, record_);
    }
    return belief_.root.allFinite();
  }

  /// From the trial's end on: before it the head goes from one swing to another, which is no progress.
  std::optional<double> FieldTrial::mean_speed(const double frequency_Hz, const double duration_s)
  {
    const double    start_s = now_s_ + duration_s;
    const double    time_s  = std::max(1., std::round(duration_s * frequency_Hz)) / frequency_Hz;
    const int       n       = std::max(1, static_cast<int>(std::ceil(time_s / frame_interval_s_)));
    Eigen::VectorXd mean    = belief_.mean;
    for (int i = 0; i < n; ++i)
      if (!model_.process.advance(start_s + time_s * i / n, start_s + time_s * (i + 1) / n, mean, transition_, noise_))
        return std::nullopt;
    return (mean.head<2>() - belief_.mean.head<2>()).norm() / time_s;
  }

  std::optional<TrialResult> FieldTrial::run(const FieldChange &change, const TwinParameter parameter,
                                             const double duration_s)
  {
    const Drive  drive = changed(drive_, change);
    const double phase = (now_s_ - drive_start_s_) * drive_.frequency_Hz;
    model_.field       = FieldSignal();
    model_.field.play(now_s_ - (phase - std::floor(phase)) / drive.frequency_Hz, drive);
    transition_.resize(model_.process.n_states(), model_.process.n_states());
    noise_.resize(model_.process.n_states(), model_.process.n_noises());
    belief_     = now_;
    const int n = std::max(1, static_cast<int>(std::lround(duration_s / frame_interval_s_)));
    for (int i = 0; i < n; ++i)
    {
      const double from_s = now_s_ + duration_s * i / n, to_s = now_s_ + duration_s * (i + 1) / n;
      if (!model_.process.advance(from_s, to_s, belief_.mean, transition_, noise_))
        return std::nullopt;
      algebra_.predict(transition_, noise_, belief_.root);
      if (!take_in_frame(to_s))
        return std::nullopt;
    }
    const auto speed_m_s = mean_speed(drive.frequency_Hz, duration_s);
    if (!speed_m_s)
      return std::nullopt;
    return TrialResult{belief_.standard_deviation(model_.layout.place(parameter)), *speed_m_s};
  }
} // namespace swimtwin
