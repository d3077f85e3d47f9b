#include <reports/run/simulation_report.h>

#include <reports/page/number_text.h>
#include <reports/run/absent_figures.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    std::string displacements(const Scene &scene, const RunSummary &summary)
    {
      if (!has_full_period(summary))
        return fmt::format("  no displacement per period: no full period of {:.4g} s was computed\n",
                           scene.time.period_s);
      if (!scene.head.is_free())
        return scene.head.is_driven() ? "  no displacement: the head's motion is given\n"
                                      : "  no displacement: the head is held\n";
      std::string text;
      for (std::size_t k = 0; k < summary.displacement_per_period_m.size(); ++k)
        text += fmt::format("  period {:<3} displacement of the head {:+.5f} mm, head first\n", k + 1,
                            1e3 * summary.displacement_per_period_m[k] + 0.); // -0 is 0
      return text;
    }

    std::string balance(const RunSummary &summary)
    {
      if (summary.power_imbalance && summary.worst_power_imbalance)
        return fmt::format("  power imbalance {:+.3f} % over the last period, {:+.3f} % in the worst\n",
                           100 * *summary.power_imbalance, 100 * *summary.worst_power_imbalance);
      if (summary.worst_power_imbalance)
        return fmt::format("  power imbalance {:+.3f} % in the worst period; none over the last: {}\n",
                           100 * *summary.worst_power_imbalance, why_no_imbalance(summary));
      return fmt::format("  no power imbalance: {}\n", why_no_imbalance(summary));
    }

    std::string steps(const RunSummary &summary)
    {
      return summary.coupling_iterations_mean ? fmt::format("{} steps of {:.2f} coupling iterations", summary.n_steps,
                                                            *summary.coupling_iterations_mean)
                                              : fmt::format("{} steps", summary.n_steps);
    }

    std::string solves(const RunSummary &summary)
    {
      return summary.linear_iterations_mean ? fmt::format("{} solves of {:.1f} iterations", summary.n_linear_solves,
                                                          *summary.linear_iterations_mean)
                                            : fmt::format("{} solves", summary.n_linear_solves);
    }
  } // namespace

  std::string describe(const Scene &scene, const RunSummary &summary)
  {
    std::string text = fmt::format("{}: {}\n", scene.name, summary.status);
    text += displacements(scene, summary) + balance(summary);
    text += fmt::format("  {} unknowns, {}, {}, {} factorisations, {} remeshings, {} halved steps\n",
                        summary.n_unknowns, steps(summary), solves(summary), summary.n_factorizations,
                        summary.n_remeshes, summary.n_step_halvings);
    text += fmt::format("  {} ({:.1f} s of CPU time", duration_text(summary.wall_time_s), summary.cpu_time_s);
    for (const auto &[part, seconds] : summary.cpu_time_of_part_s)
      text += fmt::format(", {} {:.1f}", part, seconds);
    return text + fmt::format("), {:.0f} MB\n", summary.peak_memory_MB);
  }
} // namespace swimtwin
