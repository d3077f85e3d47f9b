#include <reports/page/number_text.h>
#include <reports/page/picture_extent.h>
#include <reports/page/shown_units.h>
#include <reports/plan/plan_scripts.h>
#include <reports/twin/twin_pictures.h>
#include <reports/twin/twin_scripts.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double      two_sided_95 = 1.96;
    constexpr std::size_t most_panels = 6, most_alarms = 40;
    constexpr double      settled_share = 0.15; // of the time: before it the bands are those of the prior

    void set_time(const TwinRecord &record, GnuplotPicture &picture)
    {
      const double first = record.time_s().front(), last = record.time_s().back();
      picture.set("t_min", first);
      picture.set("t_max", std::max(last, first + 1e-3));
      std::string times;
      for (std::size_t i = 0; i < std::min(record.alarms.size(), most_alarms); ++i)
        times += fmt::format("{}{:.6g}", times.empty() ? "" : " ", record.alarms[i].since_s);
      picture.set_text("alarm_times", times);
    }

    std::string time_text(const TwinRecord &record)
    {
      return fmt::format("{} estimates over {}", record.n_rows,
                         duration_text(record.time_s().back() - record.time_s().front()));
    }

    std::string alarm_text(const TwinRecord &record)
    {
      return record.alarms.empty()
                 ? "no alarm"
                 : fmt::format("{} {} (dashed)", record.alarms.size(), record.alarms.size() == 1 ? "alarm" : "alarms");
    }

    std::string label(const TwinParameterName &p)
    {
      return p.unit.empty() ? p.symbol : fmt::format("{} ({})", p.symbol, p.unit);
    }

    /// The band where it has settled decides what is shown; what is wider before leaves the panel.
    void add_parameter(const TwinRecord &record, const TwinParameterName &p, const std::size_t k,
                       GnuplotPicture &picture)
    {
      const auto &time = record.time_s(), &value = record.columns.at(p.column),
                 &sd       = record.columns.at("sd_of_" + p.column);
      const double settled = time.front() + settled_share * (time.back() - time.front());
      double       low = std::numeric_limits<double>::infinity(), high = -low;
      picture.table.begin_block(fmt::format("{}: time (s), estimate, lower, upper", p.column));
      for (std::size_t i = 0; i < time.size(); ++i)
      {
        const double v = p.factor * value[i], half = two_sided_95 * p.factor * sd[i];
        picture.table.add_row({time[i], v, v - half, v + half});
        if (time[i] >= settled)
        {
          low  = std::min(low, v - half);
          high = std::max(high, v + half);
        }
      }
      const double margin = std::max(0.25 * (high - low), 1e-6 * std::max(1e-3, std::abs(high)));
      picture.set(fmt::format("low_{}", k), low - margin);
      picture.set(fmt::format("high_{}", k), high + margin);
      picture.set_text(fmt::format("name_{}", k), label(p));
    }

    GnuplotPicture parameters_picture(const TwinRecord &record)
    {
      const std::size_t n       = std::min(most_panels, record.parameters.size());
      GnuplotPicture    picture = titled_picture(
             "parameters", gnuplot_scripts::twin_parameters, "What the swimmer and its surroundings are like",
             fmt::format("{}; {}{}", time_text(record), alarm_text(record),
                      n < record.parameters.size()
                             ? fmt::format("; the first {} of {} parameters", n, record.parameters.size())
                             : ""));
      set_time(record, picture);
      picture.set("n_panels", static_cast<double>(n));
      for (std::size_t k = 0; k < n; ++k)
        add_parameter(record, record.parameters[k], k, picture);
      return picture;
    }

    GnuplotPicture innovations_picture(const TwinRecord &record)
    {
      const TwinColumns &c = record.columns;
      const auto        &x = c.at("innovation_x_m"), &y = c.at("innovation_y_m"), &s = c.at("innovation_sd_m"),
                 &a = c.at("innovation_angle_rad"), &sa = c.at("innovation_angle_sd_rad"), &trust = c.at("trust");
      long         n = 0, n_inside = 0;
      GnuplotTable table;
      table.begin_block("time (s), x, y, angle (standard deviations), trust");
      for (std::size_t i = 0; i < x.size(); ++i)
      {
        const std::array<double, 3> whitened = {x[i] / s[i], y[i] / s[i], a[i] / sa[i]};
        for (const double w : whitened)
          if (std::isfinite(w))
          {
            ++n;
            n_inside += std::abs(w) <= two_sided_95;
          }
        table.add_row({record.time_s()[i], whitened[0], whitened[1], whitened[2], trust[i]});
      }
      const double   inside = n > 0 ? static_cast<double>(n_inside) / static_cast<double>(n) : 0.;
      GnuplotPicture picture =
          titled_picture("innovations", gnuplot_scripts::twin_innovations, "Seen less expected, and trust",
                         n == 0 ? "neither position nor angle was seen"
                                : fmt::format("{} % of the innovations are inside their 95 % region; {}",
                                              plain_number(percent * inside, 3), alarm_text(record)));
      picture.table = std::move(table);
      set_time(record, picture);
      return picture;
    }

    void add_alarm_places(const TwinRecord &record, GnuplotPicture &picture)
    {
      picture.table.begin_block("alarms: x (mm), y (mm)");
      const auto &time = record.time_s();
      for (const RecordedAlarm &alarm : record.alarms)
      {
        const auto next = std::lower_bound(time.begin(), time.end(), alarm.since_s);
        const auto i    = static_cast<std::size_t>(std::min(next - time.begin(), static_cast<long>(time.size()) - 1));
        picture.table.add_row({mm * record.columns.at("x_m")[i], mm * record.columns.at("y_m")[i]});
      }
      if (record.alarms.empty())
        picture.table.add_row({std::nan(""), std::nan("")});
    }

    GnuplotPicture swim_picture(const TwinRecord &record)
    {
      const auto    &x = record.columns.at("x_m"), &y = record.columns.at("y_m");
      const double   net_m   = std::hypot(x.back() - x.front(), y.back() - y.front());
      GnuplotPicture picture = titled_picture(
          "swim", gnuplot_scripts::twin_swim, "Where it swam",
          fmt::format("{}; {} mm from where it was seen first", time_text(record), plain_number(mm * net_m, 3)));
      set_time(record, picture);
      picture.set_flag("has_path", !record.path_m.empty());
      picture.set_flag("has_alarms", !record.alarms.empty());
      PictureExtent extent(0.1);
      picture.table.begin_block("time (s), head x, y (mm)");
      for (std::size_t i = 0; i < x.size(); ++i)
      {
        extent.add(mm * Eigen::Vector2d(x[i], y[i]));
        picture.table.add_row({record.time_s()[i], mm * x[i], mm * y[i]});
      }
      picture.table.begin_block("path: x (mm), y (mm)");
      for (const Eigen::Vector2d &point : record.path_m)
      {
        extent.add(mm * point);
        picture.table.add_row({mm * point.x(), mm * point.y()});
      }
      if (record.path_m.empty())
        picture.table.add_row({std::nan(""), std::nan("")});
      add_alarm_places(record, picture);
      extent.set_in(picture);
      return picture;
    }

    GnuplotPicture steering_picture(const TwinRecord &record)
    {
      const TwinColumns &c       = record.steering;
      GnuplotPicture     picture = titled_picture(
              "steering", gnuplot_scripts::led_course, "Distance from the path, field and decisions",
              fmt::format("{} decisions; {}; {} % of the path", record.n_steering_rows,
                      record.phase.empty() ? "interrupted" : record.phase,
                          plain_number(record.path_length_m > 0. ? percent * record.arc_m / record.path_length_m : 0., 3)));
      const auto &time = c.at("time_s");
      picture.set("t_min", time.front());
      picture.set("t_max", std::max(time.back(), time.front() + 1e-3));
      picture.set_flag("is_relative", false);
      picture.set_flag("has_deviation", true);
      picture.table.begin_block("time (s), distance (µm), bx, by (mT), time of the decision (ms), deviation (µm)");
      for (std::size_t i = 0; i < time.size(); ++i)
        picture.table.add_row({time[i], um * c.at("distance_m")[i], mT * c.at("bx_T")[i], mT * c.at("by_T")[i],
                               ms * c.at("took_s")[i], um * c.at("doubt_m")[i]});
      return picture;
    }
  } // namespace

  std::vector<GnuplotPicture> twin_pictures(const TwinRecord &record)
  {
    std::vector<GnuplotPicture> pictures;
    if (!record.parameters.empty())
      pictures.push_back(parameters_picture(record));
    pictures.push_back(innovations_picture(record));
    pictures.push_back(swim_picture(record));
    if (record.n_steering_rows > 0)
      pictures.push_back(steering_picture(record));
    return pictures;
  }
} // namespace swimtwin
