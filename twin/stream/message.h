// What a line of the stream says.
#pragma once

#include <twin/filter/system.h>
#include <twin/motion/field_signal.h>
#include <twin/stream/twin_config.h>

#include <string_view>
#include <variant>

namespace swimtwin
{
  /// Of the stream's schema, which every line may name.
  inline constexpr int stream_version = 1;

  /// A sinusoid that plays from an instant on, with phase 0 there.
  struct DriveMessage
  {
    double time_s = 0., bx_T = 0., by_T = 0., frequency_Hz = 0.;
  };

  /// The swimmer was taken away, or the camera's clock began anew: find it again; what was learned of it stays.
  struct RestartMessage
  {
  };

  /// Nothing comes any more.
  struct EndMessage
  {
  };

  using Message = std::variant<Frame, FieldSample, DriveMessage, RestartMessage, EndMessage>;

  /// Read a line of JSON (docs/file-formats.md, "The twin's stream"). Throws InputError of one sentence that says what
  /// is wrong with the line and what to do, without its number.
  Message parse_message(std::string_view line, const CameraConfig &camera);
} // namespace swimtwin
