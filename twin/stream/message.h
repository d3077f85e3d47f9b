// What a line of the stream says.
#pragma once

#include <twin/filter/system.h>
#include <twin/motion/field_signal.h>
#include <twin/stream/twin_config.h>

#include <string_view>
#include <variant>
#include <vector>

namespace swimtwin
{
  /// Of the stream's schema, which every line may name.
  inline constexpr int stream_version = 1;

  /// A sinusoid that plays from an instant on, with phase 0 there.
  struct DriveMessage
  {
    double time_s = 0., bx_T = 0., by_T = 0., frequency_Hz = 0.;
  };

  /// It is this time now, whatever was captured when: a control period may be over.
  struct ClockMessage
  {
    double time_s = 0.;
  };

  /// What a twin has the coils play, as it said: linear between samples, the last one is kept.
  struct PlayMessage
  {
    double                   time_s = 0., until_s = 0.;
    std::vector<FieldSample> samples;
  };

  /// The swimmer was taken away, or the camera's clock began anew: find it again; what was learned of it stays.
  struct RestartMessage
  {
  };

  /// Nothing comes any more.
  struct EndMessage
  {
  };

  using Message = std::variant<Frame, FieldSample, DriveMessage, ClockMessage, PlayMessage, RestartMessage, EndMessage>;

  /// Read a line of JSON (docs/file-formats.md, "The twin's stream"). Throws InputError of one sentence that says what
  /// is wrong with the line and what to do, without its number.
  Message parse_message(std::string_view line, const CameraConfig &camera);
} // namespace swimtwin
