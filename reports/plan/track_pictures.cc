#include <reports/plan/track_pictures.h>

#include <reports/page/number_text.h>
#include <reports/page/picture_extent.h>
#include <reports/page/shown_units.h>
#include <reports/plan/plan_scripts.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace swimtwin
{
  namespace
  {

    constexpr std::string_view track_path_script = R"gp(
left = 0.105; right = 0.965; top = 0.835; bottom = 0.115
eval(map_panel)
plot data index 1 using 1:2 with lines lw 0.8 lc rgb pale_color title 'head', \
     data index 0 using 1:2 with lines lw 6 lc rgb '#f3c98b' title 'path', \
     data index 2 using 1:2 with lines lw 2 lc rgb tail_color title (has_replay ? 'mean of the replay' : ''), \
     data index 1 using 3:4 with lines lw 2 lc rgb head_color title 'mean over a period'
)gp";

    std::string finding(const TrackRecord &record)
    {
      const TrackResult &r = record.result;
      return fmt::format("{} m long path, {}: mean position {} % of a body length off it (rms), {} % at most",
                         plain_number(r.path.length_m(), 3), to_string(r.status),
                         plain_number(percent * r.rms_distance_m / record.body_length_m, 2),
                         plain_number(percent * r.largest_distance_m / record.body_length_m, 2));
    }

    GnuplotPicture path_picture(const TrackRecord &record)
    {
      GnuplotPicture picture = titled_picture("path", track_path_script, "Led along a path", finding(record));
      picture.set_flag("has_replay", record.replay.has_value());
      PictureExtent extent;
      picture.table.begin_block("path: x (mm), y (mm)");
      for (const Eigen::Vector2d &point : record.result.path.points_m())
      {
        extent.add(mm * point);
        picture.table.add_row({mm * point.x(), mm * point.y()});
      }
      picture.table.begin_block("swim: head x, y (mm), mean x, y (mm)");
      for (const TrackedInstant &i : record.result.instants)
      {
        extent.add(mm * i.pose.position_m);
        picture.table.add_row(
            {mm * i.pose.position_m.x(), mm * i.pose.position_m.y(), mm * i.mean_m.x(), mm * i.mean_m.y()});
      }
      picture.table.begin_block("replay: mean x, y (mm)");
      for (const TrackedInstant &i : (record.replay ? *record.replay : record.result).instants)
        picture.table.add_row({mm * i.mean_m.x(), mm * i.mean_m.y()});
      extent.set_in(picture);
      return picture;
    }

    GnuplotPicture course_picture(const TrackRecord &record)
    {
      const TrackResult &r       = record.result;
      GnuplotPicture     picture = titled_picture(
              "course", gnuplot_scripts::led_course, "Distance from the path, field and decisions",
              fmt::format("{} decisions of {} ms on average, {} ms at most; {} came too late", r.n_decisions,
                          plain_number(ms * r.mean_decision_s, 2), plain_number(ms * r.largest_decision_s, 2), r.n_missed));
      picture.set("t_min", r.instants.front().time_s);
      picture.set("t_max", std::max(r.instants.back().time_s, r.instants.front().time_s + 1e-3));
      picture.set_flag("is_relative", true);
      picture.set_flag("has_deviation", false);
      picture.table.begin_block("time (s), distance (% of body length), bx, by (mT), time of the decision (ms)");
      for (const TrackedInstant &i : r.instants)
        picture.table.add_row({i.time_s, percent * i.distance_m / record.body_length_m, mT * i.field_T.x(),
                               mT * i.field_T.y(), ms * i.decision_cpu_s});
      return picture;
    }
  } // namespace

  std::vector<GnuplotPicture> track_pictures(const TrackRecord &record)
  {
    return {path_picture(record), course_picture(record)};
  }
} // namespace swimtwin
