#include <control/steering/steered_field.h>
#include <datasets/files/json_entries.h>
#include <twin/stream/records.h>

namespace swimtwin
{
  namespace
  {
    Json record(const char *type)
    {
      return {{"type", type}, {"version", stream_version}};
    }

    std::string line_of(const Json &json)
    {
      return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    }

    /// Pose and shape, and their standard deviations under "sd".
    void add_state(const SwimmerTwin &twin, const Belief &belief, Json &json)
    {
      const int   n       = twin.swimmer().n_modes();
      Json        sd      = Json::object();
      const char *names[] = {"x_m", "y_m", "angle_rad"};
      for (int i = 0; i < 3; ++i)
      {
        json[names[i]] = belief.mean[i];
        sd[names[i]]   = belief.standard_deviation(i);
      }
      Json shape = Json::array(), shape_sd = Json::array();
      for (int i = 0; i < n; ++i)
      {
        shape.push_back(belief.mean[3 + i]);
        shape_sd.push_back(belief.standard_deviation(3 + i));
      }
      json["shape_m"]         = shape;
      sd["shape_m"]           = shape_sd;
      const double          c = std::cos(belief.mean[2]), s = std::sin(belief.mean[2]);
      const Eigen::Vector2d tip = twin.swimmer().tip().position_m(belief.mean.segment(3, n));
      json["tip_m"] = {belief.mean[0] + c * tip.x() - s * tip.y(), belief.mean[1] + s * tip.x() + c * tip.y()};
      json["sd"]    = sd;
    }

    const char *name_of(const int kind)
    {
      switch (kind)
      {
      case head_position:
        return "position_m";
      case head_angle:
        return "angle_rad";
      case tail_point:
        return "tail_point_m";
      default:
        return "tail_distance_m";
      }
    }

    Json innovation_json(const EstimateRecord &r)
    {
      Json list = Json::array();
      for (const Innovation &i : r.innovations)
      {
        Json residual = Json::array(), sd = Json::array();
        for (int k = 0; k < i.n_rows; ++k)
        {
          residual.push_back(i.residual[k]);
          sd.push_back(i.standard_deviation[k]);
        }
        list.push_back({{"of", name_of(i.kind)}, {"residual", residual}, {"sd", sd}, {"weight", i.weight}});
      }
      return list;
    }
  } // namespace

  std::vector<NamedParameter> named_parameters(const SwimmerTwin &twin, const Belief &belief)
  {
    const SwimmerParameters    &nominal = twin.options().nominal;
    std::vector<NamedParameter> list;
    for (int i = 0; i < n_twin_parameters; ++i)
    {
      const auto p = static_cast<TwinParameter>(i);
      if (!twin.layout().is_estimated(p))
        continue;
      const double value = belief.mean[twin.layout().place(p)], sd = belief.standard_deviation(twin.layout().place(p));
      const auto   ratio = [&](const char *name, const char *units, const double start, const double bias) {
        list.push_back({name, units, start * std::exp(value), start * std::exp(value) * std::sqrt(sd * sd + bias)});
      };
      const Eigen::Matrix2d &bias = twin.options().ratio_bias;
      if (p == TwinParameter::stiffness)
        ratio("young_modulus_over_viscosity_1_s", "1/s", nominal.young_modulus_Pa / nominal.viscosity_Pa_s, bias(0, 0));
      else if (p == TwinParameter::magnetization)
        ratio("magnetization_over_viscosity_A_m_Pa_s", "A/(m Pa s)", nominal.magnetization_A_m / nominal.viscosity_Pa_s,
              bias(1, 1));
      else if (p == TwinParameter::camera_scale)
        ratio("camera_scale", "1", 1., 0.);
      else
      {
        const auto place = static_cast<std::size_t>(i);
        list.push_back({twin_parameter_names[place], twin_parameter_units[place], value, sd});
      }
    }
    return list;
  }

  std::string greeting_line(const SwimmerTwin &twin, const std::string &model_name)
  {
    Json names = Json::array();
    for (int i = 0; i < n_twin_parameters; ++i)
      if (twin.layout().is_estimated(static_cast<TwinParameter>(i)))
        names.push_back(twin_parameter_names[static_cast<std::size_t>(i)]);
    Json json             = record("twin");
    json["model"]         = model_name;
    json["body_length_m"] = twin.swimmer().length_m();
    json["n_modes"]       = twin.swimmer().n_modes();
    json["estimates"]     = names;
    return line_of(json);
  }

  std::string estimate_line(const SwimmerTwin &twin, const EstimateRecord &r)
  {
    Json json      = record("estimate");
    json["time_s"] = r.time_s;
    json["line"]   = r.line;
    if (r.is_predicted)
      json["predicted"] = true;
    add_state(twin, r.belief, json);
    Json parameters = Json::object();
    for (const NamedParameter &p : named_parameters(twin, r.belief))
      parameters[p.name] = {{"value", p.value}, {"sd", p.standard_deviation}};
    json["parameters"]   = parameters;
    json["innovations"]  = innovation_json(r);
    json["significance"] = r.significance;
    json["trust"]        = r.trust;
    json["flags"]        = r.flags;
    return line_of(json);
  }

  std::string forecast_line(const SwimmerTwin &twin, const ForecastRecord &r)
  {
    Json json      = record("forecast");
    json["time_s"] = r.from_s;
    Json list      = Json::array();
    for (const auto &[time_s, belief] : r.instants)
    {
      Json instant      = Json::object();
      instant["time_s"] = time_s;
      add_state(twin, belief, instant);
      list.push_back(instant);
    }
    json["instants"] = list;
    return line_of(json);
  }

  std::string smoothed_line(const SwimmerTwin &twin, const double time_s, const Belief &belief)
  {
    Json json      = record("smoothed");
    json["time_s"] = time_s;
    add_state(twin, belief, json);
    return line_of(json);
  }

  std::string open_line(const double time_s, const std::vector<UnlearnedDirection> &directions)
  {
    Json json      = record("open");
    json["time_s"] = time_s;
    Json list      = Json::array();
    for (const UnlearnedDirection &d : directions)
    {
      Json entries = Json::object();
      for (const auto &[name, weight] : d.direction)
        entries[name] = weight;
      list.push_back({{"direction", entries}, {"variance_left", d.variance_left}});
    }
    json["keeps_its_prior"] = list;
    return line_of(json);
  }

  std::string alarm_line(const Alarm &alarm, const double time_s)
  {
    Json json       = record("alarm");
    json["time_s"]  = time_s;
    json["name"]    = alarm.name;
    json["since_s"] = alarm.since_s;
    json["over"]    = alarm.is_over;
    if (!alarm.is_over)
    {
      json["what"]   = alarm.what;
      json["remedy"] = alarm.remedy;
    }
    return line_of(json);
  }

  std::string proposal_line(const SwimmerTwin &twin, const TellingField &p)
  {
    // Standard deviations of logarithms are shares already; others are in the parameter's unit.
    const auto described = [](const Drive &drive, const TrialResult &result) {
      Json json = {{"frequency_Hz", drive.frequency_Hz}, {"largest_T", largest_T(drive)}};
      if (drive.field->parameter_names() == std::vector<std::string>{"bx_T", "by_T"})
      {
        json["bx_T"] = drive.parameters[0];
        json["by_T"] = drive.parameters[1];
      }
      json["sd"]        = result.standard_deviation;
      json["speed_m_s"] = result.speed_m_s;
      return json;
    };
    Json json         = record("proposal");
    json["time_s"]    = p.time_s;
    json["parameter"] = twin_parameter_names[static_cast<std::size_t>(p.parameter)];
    json["sd"]        = twin.belief().standard_deviation(twin.layout().place(p.parameter));
    json["ahead_s"]   = p.duration_s;
    json["as_is"]     = described(p.as_is, p.of_as_is);
    if (p.is_better)
    {
      json["proposed"]             = described(p.proposed, p.of_proposed);
      json["proposed"]["bx_times"] = p.change.bx_times;
      json["proposed"]["by_times"] = p.change.by_times;
    }
    else
      json["proposed"] = nullptr;
    return line_of(json);
  }

  std::string play_line(const PlayRecord &r)
  {
    Json json       = record("play");
    json["time_s"]  = r.time_s;
    json["until_s"] = r.until_s;
    Json samples    = Json::array();
    for (const FieldSample &sample : r.samples)
      samples.push_back({sample.time_s, sample.field_T.x(), sample.field_T.y()});
    json["samples"]   = samples;
    json["phase"]     = to_string(r.phase);
    json["decided_s"] = r.decided_s;
    json["took_s"]    = r.took_s;
    json["late"]      = r.is_late;
    return line_of(json);
  }

  std::string path_line(const double time_s, const Path &path)
  {
    Json json      = record("path");
    json["time_s"] = time_s;
    Json points    = Json::array();
    for (const Eigen::Vector2d &point : path.points_m())
      points.push_back({point.x(), point.y()});
    json["points_m"] = points;
    return line_of(json);
  }

  std::string clock_line(const double time_s)
  {
    Json json      = record("clock");
    json["time_s"] = time_s;
    return line_of(json);
  }

  std::string error_line(const long line, const std::string &sentence)
  {
    Json json       = record("error");
    json["line"]    = line;
    json["message"] = sentence;
    return line_of(json);
  }

  std::string end_line(const StreamCounts &counts)
  {
    Json json      = record("end");
    json["lines"]  = counts.n_lines;
    json["frames"] = counts.n_frames;
    json["late"]   = counts.n_late;
    json["errors"] = counts.n_errors;
    json["alarms"] = counts.n_alarms;
    return line_of(json);
  }
} // namespace swimtwin
