// A session's memory as JSON, so that a later program goes on.
#pragma once

#include <datasets/files/json_entries.h>
#include <twin/estimate/swimmer_twin.h>
#include <twin/stream/records.h>

namespace swimtwin
{
  // Lists of keys, found by their argument (datasets/files/json_entries.h).

  template <Like<NoiseLevel> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("variance", v.variance);
    visit("n", v.n);
  }

  template <Like<Belief> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("mean", v.mean);
    visit("root", v.root);
  }

  template <Like<StreamCounts> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("n_lines", v.n_lines);
    visit("n_frames", v.n_frames);
    visit("n_late", v.n_late);
    visit("n_errors", v.n_errors);
    visit("n_alarms", v.n_alarms);
  }

  /// A sinusoid of the stream; `is_configured`: the configuration's drive instead.
  struct RememberedProgram
  {
    double start_s = 0., bx_T = 0., by_T = 0., frequency_Hz = 0.;
    int    is_configured = 0;
  };
  template <Like<RememberedProgram> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("start_s", v.start_s);
    visit("bx_T", v.bx_T);
    visit("by_T", v.by_T);
    visit("frequency_Hz", v.frequency_Hz);
    visit("is_configured", v.is_configured);
  }

  template <Like<Pilot::Memory> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("phase", v.phase);
    visit("has_path", v.has_path);
    visit("place_m", v.place_m);
    visit("angle_rad", v.angle_rad);
    visit("ends_s", v.ends_s);
    visit("arc_m", v.arc_m);
    visit("origin_s", v.origin_s);
  }

  /// Everything that a session remembers, in plain numbers.
  struct RememberedSession
  {
    StreamCounts                   counts;
    double                         next_forecast_s = 0., next_open_s = 0.;
    std::optional<double>          next_proposal_s; ///< of a more telling field
    std::vector<RememberedProgram> programs;
    Eigen::MatrixXd                samples; ///< rows: time, bx, by, sigma
    double window_start_s = 0., started_s = 0., quiet_until_s = 0., last_used_s = 0., gated_from_s = 0.,
           reference_delay_s = 0.;
    Belief                       at_window_start;
    std::optional<Belief>        kept_parameters;
    std::vector<NoiseLevel>      noise_levels;
    Eigen::MatrixXd              frames, start_frames; ///< rows: time, kind, value x, value y, sigma, place
    int                          is_searching = 0;
    std::optional<Pilot::Memory> pilot; ///< none if the twin only watches
  };
  template <Like<RememberedSession> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("counts", v.counts);
    visit("next_forecast_s", v.next_forecast_s);
    visit("next_open_s", v.next_open_s);
    visit("next_proposal_s", v.next_proposal_s);
    visit("programs", v.programs);
    visit("field_samples", v.samples);
    visit("window_start_s", v.window_start_s);
    visit("started_s", v.started_s);
    visit("quiet_until_s", v.quiet_until_s);
    visit("last_used_s", v.last_used_s);
    visit("gated_from_s", v.gated_from_s);
    visit("reference_delay_s", v.reference_delay_s);
    visit("at_window_start", v.at_window_start);
    visit("kept_parameters", v.kept_parameters);
    visit("noise_levels", v.noise_levels);
    visit("frames", v.frames);
    visit("start_frames", v.start_frames);
    visit("is_searching", v.is_searching);
    visit("pilot", v.pilot);
  }

  void                remember(const SwimmerTwin::Memory &memory, RememberedSession &session);
  SwimmerTwin::Memory recall(const RememberedSession &session);
  void                remember(const FieldSignal &field, RememberedSession &session);
  /// `configured` may be null.
  void recall(const RememberedSession &session, const Drive *configured, FieldSignal &field);
} // namespace swimtwin
