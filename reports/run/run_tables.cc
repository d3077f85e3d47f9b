#include <reports/run/run_tables.h>

#include <datasets/scene/scene_names.h>
#include <reports/page/number_text.h>
#include <reports/page/shown_units.h>
#include <reports/run/absent_figures.h>
#include <reports/run/motion_curves.h>
#include <reports/run/run_picture.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    constexpr int n_digits = 6, n_digits_rounded = 4;

    using Row = std::vector<HtmlCell>;

    Row number_row(const std::string &name, const double value)
    {
      return {{name}, {plain_number(value, n_digits)}};
    }

    Row count_row(const std::string &name, const int count)
    {
      return {{name}, {std::to_string(count)}};
    }

    std::string remeshing_rule(const Numerics &numerics)
    {
      const std::string by_quality = fmt::format("below quality {}", numerics.remesh_quality);
      return numerics.remesh_every_steps > 0
                 ? fmt::format("every {} steps, and {}", numerics.remesh_every_steps, by_quality)
                 : by_quality;
    }
  } // namespace

  HtmlTable displacement_table(const RunFolder &run)
  {
    HtmlTable table{{"period", "displacement (mm)"}, {}};
    if (run.scene)
      table.header.push_back("in body lengths");
    int period = 0;
    for (const double displacement_m : run.record.summary.displacement_per_period_m)
    {
      table.rows.push_back({{std::to_string(++period)}, {signed_number(mm * displacement_m, n_digits)}});
      if (run.scene)
        table.rows.back().push_back({in_body_lengths(run, displacement_m)});
    }
    return table;
  }

  bool has_works(const RunFolder &run)
  {
    return run.scene && run.trajectory.size() > 1;
  }

  HtmlTable work_table(const RunFolder &run)
  {
    // Runs of earlier versions have their works in the rows alone.
    const auto       &known = run.record.summary.work_of_last_period;
    const WorkBalance balance =
        known ? *known : work_balance(last_periods(run.trajectory, time_axis(*run.scene, run.trajectory), 1));
    const bool   is_in_space = run.scene->dimension == 3; // works are whole there, and small
    const double scale = balance.scale_J_m(), unit = is_in_space ? nJ : uJ;
    const auto   row = [&](const char *name, const double work_J_m) {
      return Row{{name},
                 {plain_number(unit * work_J_m, n_digits)},
                 {scale > 0. ? plain_number(percent * work_J_m / scale, n_digits_rounded) : ""}};
    };
    return {{"in the last full period", is_in_space ? "nJ" : "µJ/m", "%"},
            {row("magnetic work", balance.magnetic_J_m),
             row("work of gravity, walls and inflows", balance.external_J_m),
             row("viscous dissipation", balance.dissipated_J_m),
             row("dissipation by the stabilisation of streams", balance.stabilization_J_m),
             row("gain of elastic and kinetic energy", balance.stored_J_m),
             row("kinetic energy that left with the fluid", balance.outflow_J_m), row("missing", balance.missing_J_m()),
             row("of this taken by the time steps from inertia", balance.numerical_J_m)}};
  }

  HtmlTable imbalance_table(const RunSummary &summary)
  {
    return {{},
            {{{"imbalance of the last full period (%)"},
              {imbalance_text(summary.power_imbalance, summary, n_digits_rounded)}},
             {{"imbalance of the worst period (%)"},
              {imbalance_text(summary.worst_power_imbalance, summary, n_digits_rounded)}}}};
  }

  HtmlTable effort_table(const RunSummary &summary)
  {
    return {{},
            {count_row("unknowns", summary.n_unknowns),
             count_row("steps", summary.n_steps),
             {{"coupling iterations per step"},
              {summary.coupling_iterations_mean ? plain_number(*summary.coupling_iterations_mean, n_digits)
                                                : "no step was done"}},
             count_row("linear solves", summary.n_linear_solves),
             {{"iterations per solve"},
              {summary.linear_iterations_mean ? plain_number(*summary.linear_iterations_mean, n_digits) : ""}},
             count_row("factorisations", summary.n_factorizations),
             count_row("remeshings", summary.n_remeshes),
             count_row("halved steps", summary.n_step_halvings),
             number_row("wall time (s)", summary.wall_time_s),
             number_row("CPU time (s)", summary.cpu_time_s),
             number_row("peak memory (MB)", summary.peak_memory_MB)}};
  }

  HtmlTable cpu_table(const RunSummary &summary)
  {
    HtmlTable  table{{"part", "CPU time (s)", "%"}, {}};
    double     rest_s = summary.cpu_time_s;
    const auto add    = [&](std::string part, const double seconds) {
      std::replace(part.begin(), part.end(), '_', ' ');
      const double share = summary.cpu_time_s > 0. ? percent * seconds / summary.cpu_time_s : 0.;
      table.rows.push_back({{part}, {plain_number(seconds, n_digits)}, {fmt::format("{:.1f}", share)}});
    };
    for (const auto &[part, seconds] : summary.cpu_time_of_part_s)
    {
      add(part, seconds);
      rest_s -= seconds;
    }
    add("all else", std::max(0., rest_s));
    add("total", summary.cpu_time_s);
    return table;
  }

  HtmlTable numerics_table(const Scene &scene)
  {
    const Numerics &numerics = scene.numerics;
    HtmlTable       table{{}, {number_row("time step (s)", scene.time.time_step_s())}};
    const auto      add = [&](const char *name, const std::string_view choice) {
      table.rows.push_back({{name}, {std::string(choice)}});
    };
    if (scene.fluid)
    {
      table.rows.push_back(number_row("mesh size at the swimmer (µm)", um * numerics.mesh_size_m));
      table.rows.push_back(number_row("mesh size at corners and tip (µm)", um * numerics.mesh_size_corner_m));
      table.rows.push_back(number_row("mesh size far away (µm)", um * numerics.mesh_size_far_m));
      table.rows.push_back(number_row("growth of the mesh size", numerics.mesh_growth));
      add("mesh motion", to_string(numerics.mesh_motion));
      add("remeshing", remeshing_rule(numerics));
    }
    if (scene.tail)
      add("tail", fmt::format("P{}, {}", numerics.tail_order, to_string(scene.tail->law)));
    add("coupling", to_string(numerics.coupling));
    add("coupling tolerance (body lengths)", plain_number(numerics.coupling_tolerance, n_digits));
    add("coupling iterations at most", std::to_string(numerics.max_coupling_iterations));
    add("linear tolerance", plain_number(numerics.linear_tolerance, n_digits));
    add("factorisations", numerics.reuse_factorization ? "reused while they serve" : "made anew each time");
    return table;
  }

  std::string in_body_lengths(const RunFolder &run, const double displacement_m)
  {
    return signed_number(displacement_m / run.scene->body_length_m(), n_digits_rounded);
  }
} // namespace swimtwin
