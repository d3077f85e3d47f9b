#include <reports/run/simulation_report.h>

#include <reports/page/number_text.h>

#include <fmt/format.h>

namespace swimtwin
{
  std::string describe(const Scene &scene, const RunSummary &summary)
  {
    std::string text = fmt::format("{}: {}\n", scene.name, summary.status);
    for (std::size_t k = 0; k < summary.displacement_per_period_m.size(); ++k)
      text += fmt::format("  period {:<3} displacement of the head {:+.5f} mm, head first\n", k + 1,
                          1e3 * summary.displacement_per_period_m[k]);
    text += fmt::format("  power imbalance {:+.3f} % over the last period, {:+.3f} % in the worst\n",
                        100 * summary.power_imbalance, 100 * summary.worst_power_imbalance);
    text += fmt::format(
        "  {} unknowns, {} steps of {:.2f} coupling iterations, {} factorisations, {} remeshings, {} halved steps\n",
        summary.n_unknowns, summary.n_steps, summary.coupling_iterations_mean, summary.n_factorizations,
        summary.n_remeshes, summary.n_step_halvings);
    text += fmt::format("  {} ({:.1f} s of CPU time", duration_text(summary.wall_time_s), summary.cpu_time_s);
    for (const auto &[part, seconds] : summary.cpu_time_of_part_s)
      text += fmt::format(", {} {:.1f}", part, seconds);
    return text + fmt::format("), {:.0f} MB\n", summary.peak_memory_MB);
  }
} // namespace swimtwin
