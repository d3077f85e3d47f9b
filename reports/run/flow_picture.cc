#include <reports/run/flow_picture.h>

#include <reports/page/shown_units.h>
#include <reports/run/run_scripts.h>
#include <reports/run/shown_instants.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace swimtwin
{
  namespace
  {
    constexpr int    samples_per_arrow = 5;
    constexpr double slowest_arrow     = 0.01; ///< of the largest speed

    double speed_mm_s(const PlaneFlow &flow, const Eigen::Index sample)
    {
      return mm * flow.velocity_m_s.row(sample).norm();
    }

    double largest_speed_mm_s(const std::vector<PlaneFlow> &flows)
    {
      double largest = 0.;
      for (const PlaneFlow &flow : flows)
        largest = std::max(largest, mm * flow.velocity_m_s.rowwise().norm().maxCoeff());
      return largest;
    }

    SampledPart part_of(const PlaneFlow &flow, const Eigen::Index sample)
    {
      return static_cast<SampledPart>(flow.part[sample]);
    }

    void add_samples(const PlaneFlow &flow, GnuplotTable &table)
    {
      table.begin_block("samples: x (mm), y (mm), speed of fluid and swimmer (mm/s)");
      Eigen::Index sample = 0;
      for (const double y : flow.y_m)
        for (const double x : flow.x_m)
        {
          const bool is_nothing = part_of(flow, sample) == SampledPart::nothing;
          table.add_row(
              {mm * x, mm * y, is_nothing ? std::numeric_limits<double>::quiet_NaN() : speed_mm_s(flow, sample)});
          ++sample;
        }
    }

    /// All of one length, where the fluid moves.
    void add_arrows(const PlaneFlow &flow, const double largest_mm_s, GnuplotTable &table)
    {
      const auto   n_x = static_cast<Eigen::Index>(flow.x_m.size()), n_y = static_cast<Eigen::Index>(flow.y_m.size());
      const double length_mm = 0.8 * samples_per_arrow * mm * (flow.x_m[1] - flow.x_m[0]);
      table.begin_block("arrows: x (mm), y (mm) of the tail, x and y of the length (mm)");
      for (Eigen::Index j = (n_y / 2) % samples_per_arrow; j < n_y; j += samples_per_arrow)
        for (Eigen::Index i = (n_x / 2) % samples_per_arrow; i < n_x; i += samples_per_arrow)
        {
          const Eigen::Index    sample   = j * n_x + i;
          const Eigen::Vector2d velocity = flow.velocity_m_s.row(sample).head<2>();
          if (part_of(flow, sample) != SampledPart::fluid || mm * velocity.norm() <= slowest_arrow * largest_mm_s)
            continue;
          const Eigen::Vector2d arrow = length_mm * velocity.normalized();
          const double x = mm * flow.x_m[static_cast<std::size_t>(i)], y = mm * flow.y_m[static_cast<std::size_t>(j)];
          table.add_row({x - .5 * arrow[0], y - .5 * arrow[1], arrow[0], arrow[1]});
        }
    }

    void add_chords(const Eigen::MatrixXd &ends_m, const std::string &name, GnuplotTable &table)
    {
      table.begin_block(name + ": chords of the outline, x (mm), y (mm), from one end to the other (mm)");
      for (Eigen::Index k = 0; k < ends_m.rows(); ++k)
        table.add_row({mm * ends_m(k, 0), mm * ends_m(k, 1), mm * (ends_m(k, 2) - ends_m(k, 0)),
                       mm * (ends_m(k, 3) - ends_m(k, 1))});
    }
  } // namespace

  bool has_flow(const ShownRun &run)
  {
    return largest_speed_mm_s(run.flows) > 0.;
  }

  GnuplotPicture flow_picture(const ShownRun &run)
  {
    const double   largest_mm_s = largest_speed_mm_s(run.flows);
    const bool     periodic     = run.has_full_period();
    GnuplotPicture picture =
        make_picture(run, "flow_in_plane", gnuplot_scripts::flow_in_plane, "Flow in the plane of motion",
                     fmt::format("speed (colour) and direction (arrows) {}, up to {:.3g} mm/s",
                                 periodic ? "in the last full period" : "in the run", largest_mm_s));
    double      width_mm = 0., height_mm = 0.;
    std::string instants, middles_x, middles_y;
    const auto  add_word = [](std::string &words, const double value) {
      words += fmt::format("{}{:.4g}", words.empty() ? "" : " ", value);
    };
    for (const PlaneFlow &flow : run.flows)
    {
      add_samples(flow, picture.table);
      add_arrows(flow, largest_mm_s, picture.table);
      add_chords(flow.tail_outline_m, "tail", picture.table);
      add_chords(flow.head_outline_m, "head", picture.table);
      width_mm  = std::max(width_mm, mm * (flow.x_m.back() - flow.x_m.front()));
      height_mm = std::max(height_mm, mm * (flow.y_m.back() - flow.y_m.front()));
      add_word(instants, shown_time(run, flow.time_s));
      add_word(middles_x, .5 * mm * (flow.x_m.back() + flow.x_m.front()));
      add_word(middles_y, .5 * mm * (flow.y_m.back() + flow.y_m.front()));
    }
    picture.set("width", width_mm);
    picture.set("height", height_mm);
    picture.set_text("middles_x", middles_x);
    picture.set_text("middles_y", middles_y);
    picture.set_text("instants", instants);
    picture.set_text("instant_unit", periodic ? "periods" : "s");
    picture.set("speed_max", largest_mm_s);
    return picture;
  }
} // namespace swimtwin
