#include <datasets/system/error.h>
#include <datasets/system/nearest_name.h>
#include <datasets/text/text_line.h>
#include <twin/measurement/camera_sensor.h>
#include <twin/stream/message.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    using StreamJson = nlohmann::json;

    constexpr double largest_time_s = 1e11, largest_length_m = 1e3, largest_field_T = 10., largest_frequency_Hz = 1e5,
                     largest_angle_rad = 1e6;
    constexpr std::size_t most_points  = 256;

    std::string shown(const std::string &text)
    {
      return shortened(text_line(text));
    }

    /// An object whose entries are asked for one by one; what nobody asked for is unknown.
    class Entries
    {
    public:
      Entries(const StreamJson &object, std::string what) : object_(object), what_(std::move(what))
      {
        if (!object.is_object())
          throw InputError(fmt::format("{} is no object; write {{\"key\": value, ...}}.", what_));
      }

      bool has(const char *key)
      {
        known_.emplace_back(key);
        return object_.contains(key) && !object_.at(key).is_null();
      }
      /// A finite number whose size is at most `largest`.
      std::optional<double> number(const char *key, const double largest)
      {
        if (!has(key))
          return {};
        const StreamJson &value = object_.at(key);
        if (!value.is_number())
          throw InputError(fmt::format("{} of {} is {} and not a number; leave it out, or send a number.", key, what_,
                                       value.type_name()));
        const double number = value.get<double>();
        if (!std::isfinite(number) || std::abs(number) > largest)
          throw InputError(fmt::format("{} = {:.6g} of {} is out of bounds (at most {:.0e}); check its unit, which is "
                                       "part of the key.",
                                       key, number, what_, largest));
        return number;
      }
      double required(const char *key, const double largest)
      {
        const auto value = number(key, largest);
        if (!value)
          throw InputError(fmt::format("{} lacks {}; send it with every one.", what_, key));
        return *value;
      }
      std::optional<double> positive_number(const char *key, const double largest)
      {
        const auto value = number(key, largest);
        if (value && *value <= 0.)
          throw InputError(
              fmt::format("{} = {:.6g} of {} is not positive; leave it out if it is not known.", key, *value, what_));
        return value;
      }
      std::optional<std::string> text(const char *key)
      {
        if (!has(key))
          return {};
        if (!object_.at(key).is_string())
          throw InputError(fmt::format("{} of {} is {} and not a text.", key, what_, object_.at(key).type_name()));
        return object_.at(key).get<std::string>();
      }
      const StreamJson &at(const char *key) const { return object_.at(key); }
      void              finish() const
      {
        for (const auto &[key, value] : object_.items())
          if (std::find(known_.begin(), known_.end(), key) == known_.end())
            throw InputError(fmt::format("{} has an unknown key {}; did you mean {}?", what_, shown(key),
                                         nearest_name(key, known_)));
      }

    private:
      const StreamJson        &object_;
      std::string              what_;
      std::vector<std::string> known_;
    };

    class FrameReader
    {
    public:
      explicit FrameReader(const CameraConfig &camera) : camera_(camera) {}

      Frame read(Entries &entries)
      {
        frame_.time_s = entries.required("time_s", largest_time_s);
        const double sigma_m =
            entries.positive_number("position_sigma_m", largest_length_m).value_or(camera_.position_sigma_m);
        const double sigma_rad =
            entries.positive_number("angle_sigma_rad", largest_angle_rad).value_or(camera_.angle_sigma_rad);
        const auto x = entries.number("x_m", largest_length_m), y = entries.number("y_m", largest_length_m);
        const auto angle = entries.number("angle_rad", largest_angle_rad);
        if (x.has_value() != y.has_value())
          throw InputError(
              fmt::format("a frame has {} without {}; send both, or none.", x ? "x_m" : "y_m", x ? "y_m" : "x_m"));
        if (x)
          add(head_position, {*x, sign() * *y}, sigma_m, 0.);
        if (angle)
          add(head_angle, {sign() * *angle, 0.}, sigma_rad, 0.);
        if (entries.has("points"))
          read_points(entries.at("points"), sigma_m);
        if (frame_.observations.empty())
          throw InputError("a frame shows nothing; send x_m and y_m, angle_rad or points, or no frame.");
        return std::move(frame_);
      }

    private:
      double sign() const { return camera_.y_down ? -1. : 1.; }

      void add(const SightingKind kind, const Eigen::Vector2d &value, const double sigma, const double place)
      {
        frame_.observations.push_back({kind, value, sigma, place});
      }

      void read_points(const StreamJson &points, const double sigma_m)
      {
        if (!points.is_array())
          throw InputError("points of a frame is no array; write [{\"name\": ..., \"x_m\": ..., \"y_m\": ...}, ...].");
        if (points.size() > most_points)
          throw InputError(fmt::format("a frame has {} points; at most {} can be used: send fewer of them.",
                                       points.size(), most_points));
        for (const StreamJson &point : points)
        {
          Entries               entries(point, "a point");
          const auto            name  = entries.text("name");
          const auto            share = entries.number("share", 1.);
          const Eigen::Vector2d value(entries.required("x_m", largest_length_m),
                                      sign() * entries.required("y_m", largest_length_m));
          const double          sigma = entries.positive_number("sigma_m", largest_length_m).value_or(sigma_m);
          entries.finish();
          if (share && *share < 0.)
            throw InputError(fmt::format(
                "share = {:.4g} of a point is negative; it is 0 at the tail's root and 1 at its tip.", *share));
          if (name || share)
            add(tail_point, value, sigma, share ? *share : share_of(*name));
          else
            add(tail_distance, value, sigma, 0.);
        }
      }

      double share_of(const std::string &name) const
      {
        const auto found = camera_.points.find(name);
        if (found == camera_.points.end())
          throw InputError(
              fmt::format("a point is called {}, which [camera.points] does not name; name it there with its "
                          "share of the tail's axis, or leave its name out.",
                          shown(name)));
        return found->second;
      }

      const CameraConfig &camera_;
      Frame               frame_;
    };

    FieldSample read_sample(Entries &entries)
    {
      return {entries.required("time_s", largest_time_s),
              {entries.required("bx_T", largest_field_T), entries.required("by_T", largest_field_T)},
              entries.positive_number("sigma_T", largest_field_T).value_or(0.)};
    }

    DriveMessage read_drive(Entries &entries)
    {
      const DriveMessage drive{entries.required("time_s", largest_time_s), entries.required("bx_T", largest_field_T),
                               entries.required("by_T", largest_field_T),
                               entries.required("frequency_Hz", largest_frequency_Hz)};
      if (drive.frequency_Hz <= 0.)
        throw InputError(
            fmt::format("frequency_Hz = {:.6g} of a drive is not positive; send field samples for a constant "
                        "field.",
                        drive.frequency_Hz));
      return drive;
    }

    PlayMessage read_play(Entries &entries)
    {
      PlayMessage play{entries.required("time_s", largest_time_s), entries.required("until_s", largest_time_s), {}};
      for (const char *other : {"phase", "decided_s", "took_s", "late"}) // the twin's own, for people
        static_cast<void>(entries.has(other));
      if (!entries.has("samples") || !entries.at("samples").is_array() || entries.at("samples").empty())
        throw InputError("a play lacks samples; send [[time_s, bx_T, by_T], ...], in order of time.");
      for (const StreamJson &row : entries.at("samples"))
      {
        const bool fits = row.is_array() && row.size() == 3 &&
                          std::all_of(row.begin(), row.end(), [](const StreamJson &v) { return v.is_number(); });
        if (!fits)
          throw InputError("a sample of a play is no array of three numbers; write [time_s, bx_T, by_T].");
        const FieldSample sample{row[0].get<double>(), {row[1].get<double>(), row[2].get<double>()}, 0.};
        if (!std::isfinite(sample.time_s) || std::abs(sample.time_s) > largest_time_s ||
            !(sample.field_T.cwiseAbs().maxCoeff() <= largest_field_T))
          throw InputError(fmt::format("a sample of a play is out of bounds (at most {:.0e} s, {:.0e} T); check its "
                                       "units.",
                                       largest_time_s, largest_field_T));
        if (!play.samples.empty() && sample.time_s <= play.samples.back().time_s)
          throw InputError(
              fmt::format("the samples of a play are not in order of time at {:.6g} s; sort them.", sample.time_s));
        play.samples.push_back(sample);
      }
      return play;
    }

    StreamJson parse(const std::string_view line)
    {
      try
      {
        return StreamJson::parse(line);
      }
      catch (const StreamJson::exception &error)
      {
        const bool is_cut = std::string_view(error.what()).find("unexpected end of input") != std::string_view::npos;
        throw InputError(is_cut
                             ? "the line is cut short; send every line whole, with its line break."
                             : "the line is not JSON; send one object per line, numbers finite (no NaN, no Infinity).");
      }
    }
  } // namespace

  Message parse_message(const std::string_view line, const CameraConfig &camera)
  {
    const StreamJson json = parse(line);
    Entries          entries(json, "the line");
    const auto       type = entries.text("type");
    if (!type)
      throw InputError("the line lacks its type; send \"type\": \"frame\", \"field\", \"drive\", \"play\", \"clock\", "
                       "\"restart\" or "
                       "\"end\".");
    if (const auto version = entries.number("version", largest_time_s); version && *version != stream_version)
      throw InputError(fmt::format("version {:.6g} of the stream is not known; this program speaks version {}.",
                                   *version, stream_version));
    Message message;
    if (*type == "frame")
      message = FrameReader(camera).read(entries);
    else if (*type == "field")
      message = read_sample(entries);
    else if (*type == "drive")
      message = read_drive(entries);
    else if (*type == "play")
      message = read_play(entries);
    else if (*type == "clock")
      message = ClockMessage{entries.required("time_s", largest_time_s)};
    else if (*type == "restart")
      message = RestartMessage();
    else if (*type == "end")
      message = EndMessage();
    else
      throw InputError(
          fmt::format("type {} is not known; did you mean {}?", shown(*type),
                      nearest_name(*type, {"frame", "field", "drive", "play", "clock", "restart", "end"})));
    entries.finish();
    return message;
  }
} // namespace swimtwin
