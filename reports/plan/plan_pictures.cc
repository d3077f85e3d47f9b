#include <reports/plan/plan_pictures.h>

#include <control/goal/measured_field.h>
#include <reports/page/number_text.h>
#include <reports/page/picture_extent.h>
#include <reports/page/shown_units.h>
#include <reports/plan/plan_scripts.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {

    /// Fields that are compared in pictures, those that move: the tuned sinusoid and the optimum, or what there is.
    std::vector<const PlannedField *> shown(const PlanResult &plan)
    {
      std::vector<const PlannedField *> fields;
      for (const char *name : {tuned_field_name, optimal_field_name})
        if (const PlannedField *field = plan.find(name); field != nullptr && field->moves)
          fields.push_back(field);
      return fields;
    }

    GnuplotPicture picture_of(const PlanFolder &folder, const std::string &name, const std::string_view script,
                              const std::string &heading, const std::string &finding)
    {
      return titled_picture(name, script, heading, fmt::format("{}: {}", folder.name, finding));
    }

    void set_names(GnuplotPicture &picture, const std::vector<const PlannedField *> &fields)
    {
      picture.set("n_fields", static_cast<double>(fields.size()));
      for (std::size_t k = 0; k < fields.size(); ++k)
        picture.set_text(fmt::format("name_{}", k),
                         fmt::format("{}, {} Hz", fields[k]->name, plain_number(fields[k]->frequency_Hz, 3)));
    }

    void add_samples(GnuplotPicture &picture, const PlannedField &field)
    {
      constexpr int n     = 400;
      const Drive   drive = drive_of(field);
      picture.table.begin_block(field.name + ": phase, bx (mT), by (mT), |B| (mT)");
      for (int i = 0; i <= n; ++i)
      {
        const double          phase = static_cast<double>(i) / n;
        const Eigen::Vector2d b     = mT * drive.field->value_T(phase, drive.parameters);
        picture.table.add_row({phase, b.x(), b.y(), b.norm()});
      }
    }

    GnuplotPicture field_picture(const PlanFolder &folder, const std::vector<const PlannedField *> &fields)
    {
      GnuplotPicture picture =
          picture_of(folder, "field", gnuplot_scripts::planned_field, "Field over a period",
                     fmt::format("largest |B| {} mT", plain_number(mT * fields.back()->largest_field_T, 4)));
      set_names(picture, fields);
      for (const PlannedField *field : fields)
        add_samples(picture, *field);
      return picture;
    }

    GnuplotPicture hodograph(const PlanFolder &folder, const std::vector<const PlannedField *> &fields)
    {
      GnuplotPicture picture = picture_of(folder, "hodograph", gnuplot_scripts::hodograph, "Hodograph of the field",
                                          "phase by colour, largest |B| dashed");
      set_names(picture, fields);
      double largest = 0.;
      for (const PlannedField *field : fields)
        largest = std::max(largest, mT * field->largest_field_T);
      picture.set("largest", largest);
      PictureExtent extent;
      extent.add({-largest, -largest});
      extent.add({largest, largest});
      extent.set_in(picture);
      for (const PlannedField *field : fields)
        add_samples(picture, *field);
      return picture;
    }

    GnuplotPicture head_path(const PlanFolder &folder)
    {
      GnuplotPicture picture = picture_of(folder, "head_path", gnuplot_scripts::head_path, "Path of the head",
                                          "the same time for every field, a mark after every period");
      PictureExtent  extent(0.1);
      double         duration_s = std::numeric_limits<double>::infinity();
      for (const PlannedMotion &motion : folder.motions)
        duration_s = std::min(duration_s, motion.trajectory.back().time_s);
      std::size_t k = 0;
      for (const PlannedMotion &motion : folder.motions)
      {
        picture.set_text(fmt::format("name_{}", k++), motion.name);
        picture.table.begin_block(motion.name + ": x (mm), y (mm), time (s)");
        for (const TrajectoryRow &row : motion.trajectory)
          if (row.time_s <= duration_s)
          {
            picture.table.add_row({mm * row.head_x_m, mm * row.head_y_m, row.time_s});
            extent.add(mm * Eigen::Vector2d(row.head_x_m, row.head_y_m));
          }
      }
      for (const PlannedMotion &motion : folder.motions)
      {
        const PlannedField *field = folder.plan.find(motion.name);
        picture.table.begin_block(motion.name + ": x (mm), y (mm) after each period");
        const double last = field == nullptr ? 0. : field->frequency_Hz * duration_s;
        for (const TrajectoryRow &row : motion.trajectory)
          if (const double phase = field == nullptr ? 0.5 : row.time_s * field->frequency_Hz;
              phase <= last + 1e-6 && std::abs(phase - std::round(phase)) < 1e-6)
            picture.table.add_row({mm * row.head_x_m, mm * row.head_y_m});
      }
      picture.set("n_fields", static_cast<double>(folder.motions.size()));
      extent.set_in(picture);
      return picture;
    }

    void add_bar(GnuplotPicture &picture, int &n, const std::string &name, const double speed_m_s, const int kind)
    {
      picture.set_text(fmt::format("bar_{}", n), name);
      picture.table.add_row({static_cast<double>(n++), um * speed_m_s, static_cast<double>(kind)});
    }

    GnuplotPicture gains_picture(const PlanFolder &folder)
    {
      const PlanResult &plan  = folder.plan;
      const std::string proof = plan.replay ? plain_number(plan.replay->gain(), 3) + " on the full-order model"
                                            : "not confirmed on the full-order model";
      GnuplotPicture    picture =
          picture_of(folder, "gains", gnuplot_scripts::gains, "Mean speed of each field",
                     fmt::format("gain {} over the tuned sinusoid, {}", plain_number(plan.gain(), 3), proof));
      int n = 0;
      picture.table.begin_block("bar, mean speed (um/s), 0: reduced, 1: full order");
      for (const PlannedField &field : plan.fields)
        if (field.moves)
          add_bar(picture, n, field.name, field.mean_speed_m_s, 0);
      if (plan.replay)
        for (const ReplayedField &field : plan.replay->fields)
          add_bar(picture, n, field.name.substr(0, field.name.find(' ')) + ", full order", field.mean_speed_m_s, 1);
      picture.set("n_bars", n);
      return picture;
    }

    GnuplotPicture trade_off_picture(const PlanFolder &folder)
    {
      GnuplotPicture picture =
          picture_of(folder, "trade_off", gnuplot_scripts::trade_off, "Speed against heading stability",
                     "largest Floquet multiplier per period that is allowed");
      picture.table.begin_block("multiplier, tuned (um/s), optimal (um/s), gain");
      for (const TradeOffPoint &point : folder.plan.trade_off)
        picture.table.add_row({point.largest_multiplier, um * point.tuned_speed_m_s, um * point.optimal_speed_m_s,
                               point.optimal_speed_m_s / point.tuned_speed_m_s});
      return picture;
    }

    GnuplotPicture trace_picture(const PlanFolder &folder)
    {
      GnuplotPicture picture = picture_of(folder, "trace", gnuplot_scripts::search_trace, "Searches",
                                          "best field so far that keeps to all limits");
      int            n       = 0;
      for (const PlannedField &field : folder.plan.fields)
      {
        if (field.trace.empty())
          continue;
        picture.set_text(fmt::format("name_{}", n++), field.name);
        picture.table.begin_block(field.name + ": periods integrated, objective, violation");
        for (const PlanTraceStep &step : field.trace)
          picture.table.add_row({static_cast<double>(step.n_periods), -step.objective, step.violation});
      }
      picture.set("n_fields", n);
      return picture;
    }

    bool has_trace(const PlanResult &plan)
    {
      return std::any_of(plan.fields.begin(), plan.fields.end(), [](const auto &f) { return !f.trace.empty(); });
    }
  } // namespace

  std::vector<GnuplotPicture> plan_pictures(const PlanFolder &folder)
  {
    std::vector<GnuplotPicture>             pictures;
    const std::vector<const PlannedField *> fields = shown(folder.plan);
    if (!fields.empty())
    {
      pictures.push_back(field_picture(folder, fields));
      pictures.push_back(hodograph(folder, fields));
      pictures.push_back(gains_picture(folder));
    }
    if (!folder.motions.empty())
      pictures.push_back(head_path(folder));
    if (!folder.plan.trade_off.empty())
      pictures.push_back(trade_off_picture(folder));
    if (has_trace(folder.plan))
      pictures.push_back(trace_picture(folder));
    return pictures;
  }
} // namespace swimtwin
