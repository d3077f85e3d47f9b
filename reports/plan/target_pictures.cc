#include <reports/plan/target_pictures.h>

#include <reports/page/number_text.h>
#include <reports/page/picture_extent.h>
#include <reports/page/shown_units.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {

    constexpr std::string_view target_way_script = R"gp(
left = 0.105; right = 0.965; top = 0.835; bottom = 0.115
eval(map_panel)
plot data index 0 using 1:2 with lines lw 3 lc rgb '#f3c98b' title 'target', \
     data index 2 using 1:2 with lines lw 1 lc rgb tail_color title (has_replay ? 'head of the replay' : ''), \
     data index 1 using 1:2 with lines lw 1 lc rgb head_color title 'head'
)gp";

    constexpr std::string_view target_course_script = R"gp(
set multiplot
left = 0.105; right = 0.965
set xrange [0:t_max]
set format x ''
top = 0.835; bottom = 0.50
eval(panel)
set yrange [0:*]
set ylabel "distance (body lengths)"
plot data index 0 using 1:2 with lines lw 2 lc rgb head_color notitle
unset label 1; unset label 2
set format x '%g'
top = 0.45; bottom = 0.115
eval(panel)
set yrange [*:*]
set xlabel 'time (s)'
set ylabel 'field (mT)'
plot data index 0 using 1:3 with lines lw 1 lc rgb head_color title 'b_x', \
     data index 0 using 1:4 with lines lw 1 lc rgb tail_color title 'b_y'
unset multiplot
)gp";

    std::string finding(const TargetRecord &record)
    {
      return fmt::format("{} after {} s, {} % of a body length from the target", record.status(),
                         plain_number(record.way.time_s, 4),
                         plain_number(percent * record.swim.back().distance_m / record.body_length_m, 2));
    }

    GnuplotPicture way_picture(const TargetRecord &record)
    {
      GnuplotPicture picture = titled_picture("way", target_way_script, "The way to a target", finding(record));
      picture.set_flag("has_replay", record.replay.has_value());
      PictureExtent extent;
      const auto    add = [&](const Eigen::Vector2d &point_m) {
        extent.add(mm * point_m);
        picture.table.add_row({mm * point_m.x(), mm * point_m.y()});
      };
      picture.table.begin_block("target: x (mm), y (mm)");
      const double radius = record.goal.options.distance * record.body_length_m;
      for (int i = 0; i <= 60; ++i)
      {
        const double angle = 2. * std::numbers::pi * i / 60.;
        add(record.goal.target_m + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      }
      picture.table.begin_block("swim: head x, y (mm)");
      for (const TargetInstant &i : record.swim)
        add(i.pose.position_m);
      picture.table.begin_block("replay: head x, y (mm)");
      for (const TargetInstant &i : record.replay ? *record.replay : record.swim)
        add(i.pose.position_m);
      extent.set_in(picture);
      return picture;
    }

    GnuplotPicture course_picture(const TargetRecord &record)
    {
      GnuplotPicture picture =
          titled_picture("course", target_course_script, "Distance from the target, and field",
                         fmt::format("{} periods at {} Hz; straight on and not turned, the carrier takes {} s",
                                     record.way.n_periods, plain_number(record.way.plan.carrier.frequency_Hz, 4),
                                     plain_number(record.way.straight_time_s, 4)));
      picture.set("t_max", record.swim.back().time_s);
      picture.table.begin_block("time (s), distance (body lengths), bx, by (mT)");
      for (const TargetInstant &i : record.swim)
        picture.table.add_row({i.time_s, i.distance_m / record.body_length_m, mT * i.field_T.x(), mT * i.field_T.y()});
      return picture;
    }
  } // namespace

  std::vector<GnuplotPicture> target_pictures(const TargetRecord &record)
  {
    return {way_picture(record), course_picture(record)};
  }
} // namespace swimtwin
