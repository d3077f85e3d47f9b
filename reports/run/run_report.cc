#include <reports/run/run_report.h>

#include <reports/page/number_text.h>
#include <reports/page/provenance_section.h>
#include <reports/page/shown_units.h>
#include <reports/run/absent_figures.h>
#include <reports/run/run_picture.h>
#include <reports/run/run_tables.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    std::string displacement_text(const RunFolder &run)
    {
      if (run.scene && !run.scene->head.is_free())
        return run.scene->head.is_driven() ? "the head's motion is given" : "the head is held";
      const RunSummary &summary = run.record.summary;
      const double      net_m   = summary.displacement_per_period_m.back();
      return fmt::format("{} mm{} in period {}, positive head first", signed_number(mm * net_m, 4),
                         run.scene ? fmt::format(" ({} body lengths)", in_body_lengths(run, net_m)) : "",
                         summary.displacement_per_period_m.size());
    }

    std::string verdict_text(const RunFolder &run)
    {
      const RunSummary &summary = run.record.summary;
      if (!has_full_period(summary))
        return fmt::format("{}; no full period was computed", summary.status);
      return fmt::format("{}; {}; {}", summary.status, displacement_text(run),
                         summary.power_imbalance
                             ? fmt::format("power imbalance {} %", signed_number(percent * *summary.power_imbalance, 2))
                             : "no power imbalance: " + why_no_imbalance(summary));
    }

    void add_power_balance(HtmlPage &page, const RunFolder &run)
    {
      page.add_heading("Power balance");
      if (!has_full_period(run.record.summary))
        return page.add_paragraph("It is closed over full periods, and there is none.");
      if (has_works(run))
        page.add_table(work_table(run));
      page.add_table(imbalance_table(run.record.summary));
    }
  } // namespace

  HtmlPage run_page(const RunFolder &run, const Illustrations &illustrations)
  {
    const auto &[summary, provenance] = run.record;
    HtmlPage page(fmt::format("Run {}", run.name));
    page.add_verdict(has_completed(summary) ? Verdict::good : Verdict::bad, verdict_text(run));
    page.add_warnings(summary.warnings);
    if (!run.warning.empty())
      page.add_warning(run.warning);
    if (has_full_period(summary) && !(run.scene && !run.scene->head.is_free()))
    {
      page.add_heading("Displacement of the head, positive head first");
      page.add_table(displacement_table(run));
    }
    add_illustrations(page, illustrations);
    add_power_balance(page, run);
    page.add_heading("Effort");
    page.add_table(effort_table(summary));
    page.add_table(cpu_table(summary));
    if (run.scene)
    {
      page.add_heading("Mesh and numerics");
      page.add_table(numerics_table(*run.scene));
    }
    add_provenance(page, provenance);
    page.add_heading("Scene");
    page.add_preformatted(provenance.scene_text);
    return page;
  }
} // namespace swimtwin
