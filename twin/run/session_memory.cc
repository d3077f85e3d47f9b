#include <twin/run/session_memory.h>

namespace swimtwin
{
  namespace
  {
    constexpr Eigen::Index n_frame_columns = 6, n_sample_columns = 4;

    Eigen::MatrixXd rows_of(const std::vector<Frame> &frames)
    {
      Eigen::Index n = 0;
      for (const Frame &frame : frames)
        n += static_cast<Eigen::Index>(frame.observations.size());
      Eigen::MatrixXd rows(n, n_frame_columns);
      Eigen::Index    i = 0;
      for (const Frame &frame : frames)
        for (const Sighting &o : frame.observations)
          rows.row(i++) << frame.time_s, static_cast<double>(o.kind), o.value.x(), o.value.y(), o.sigma, o.place;
      return rows;
    }

    std::vector<Frame> frames_of(const Eigen::MatrixXd &rows)
    {
      std::vector<Frame> frames;
      for (Eigen::Index i = 0; i < rows.rows(); ++i)
      {
        if (frames.empty() || frames.back().time_s != rows(i, 0))
          frames.push_back({rows(i, 0), {}});
        frames.back().observations.push_back(
            {static_cast<int>(rows(i, 1)), {rows(i, 2), rows(i, 3)}, rows(i, 4), rows(i, 5)});
      }
      return frames;
    }

    void require_columns(const Eigen::MatrixXd &rows, const Eigen::Index n, const char *name)
    {
      if (rows.rows() > 0 && rows.cols() != n)
        throw InputError(fmt::format("has {} columns of {} instead of {}", rows.cols(), name, n));
      if (!rows.allFinite())
        throw InputError(fmt::format("has {} that are not finite", name));
    }
  } // namespace

  void remember(const SwimmerTwin::Memory &memory, RememberedSession &session)
  {
    session.window_start_s    = memory.window_start_s;
    session.started_s         = memory.started_s;
    session.quiet_until_s     = memory.quiet_until_s;
    session.last_used_s       = memory.last_used_s;
    session.gated_from_s      = memory.gated_from_s;
    session.reference_delay_s = memory.reference_delay_s;
    session.at_window_start   = memory.at_window_start;
    session.kept_parameters   = memory.kept_parameters;
    session.noise_levels.assign(memory.noise_levels.begin(), memory.noise_levels.end());
    session.frames       = rows_of(memory.frames);
    session.start_frames = rows_of(memory.start_frames);
    session.is_searching = memory.is_searching;
  }

  SwimmerTwin::Memory recall(const RememberedSession &session)
  {
    require_columns(session.frames, n_frame_columns, "frames");
    require_columns(session.start_frames, n_frame_columns, "start_frames");
    SwimmerTwin::Memory memory;
    memory.window_start_s    = session.window_start_s;
    memory.started_s         = session.started_s;
    memory.quiet_until_s     = session.quiet_until_s;
    memory.last_used_s       = session.last_used_s;
    memory.gated_from_s      = session.gated_from_s;
    memory.reference_delay_s = session.reference_delay_s;
    memory.at_window_start   = session.at_window_start;
    memory.kept_parameters   = session.kept_parameters;
    if (session.noise_levels.size() != memory.noise_levels.size())
      throw InputError("has another number of noise_levels");
    std::copy(session.noise_levels.begin(), session.noise_levels.end(), memory.noise_levels.begin());
    memory.frames       = frames_of(session.frames);
    memory.start_frames = frames_of(session.start_frames);
    memory.is_searching = session.is_searching != 0;
    return memory;
  }

  void remember(const FieldSignal &field, RememberedSession &session)
  {
    for (const FieldSignal::Program &program : field.programs())
    {
      const auto *sinusoid = dynamic_cast<const SinusoidalField *>(program.drive.field.get());
      if (sinusoid != nullptr)
        session.programs.push_back(
            {program.start_s, program.drive.parameters[0], program.drive.parameters[1], program.drive.frequency_Hz, 0});
      else
        session.programs.push_back({program.start_s, 0., 0., program.drive.frequency_Hz, 1});
    }
    session.samples.resize(static_cast<Eigen::Index>(field.samples().size()), n_sample_columns);
    Eigen::Index i = 0;
    for (const FieldSample &sample : field.samples())
      session.samples.row(i++) << sample.time_s, sample.field_T.x(), sample.field_T.y(), sample.sigma_T;
  }

  void recall(const RememberedSession &session, const Drive *configured, FieldSignal &field)
  {
    field = {};
    for (const RememberedProgram &p : session.programs)
      if (p.is_configured == 0)
        field.play_sinusoid(p.start_s, p.bx_T, p.by_T, p.frequency_Hz);
      else if (configured != nullptr)
        field.play(p.start_s, *configured);
    require_columns(session.samples, n_sample_columns, "field_samples");
    for (Eigen::Index i = 0; i < session.samples.rows(); ++i)
      field.add({session.samples(i, 0), {session.samples(i, 1), session.samples(i, 2)}, session.samples(i, 3)});
  }
} // namespace swimtwin
