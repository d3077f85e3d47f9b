#include <reports/sweep/sweep_report.h>

#include <reports/page/number_text.h>
#include <reports/page/provenance_section.h>
#include <reports/page/shown_units.h>
#include <reports/run/absent_figures.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr int n_digits = 6, n_digits_rounded = 4;

    bool has_swum(const SweepRun &entry)
    {
      return has_completed(entry.run.record.summary);
    }

    void add_verdict(HtmlPage &page, const SweepFolder &sweep)
    {
      const auto n_runs = static_cast<std::ptrdiff_t>(sweep.runs.size());
      const auto n_done = std::count_if(sweep.runs.begin(), sweep.runs.end(), has_swum);
      if (sweep.n_not_computed > 0)
        page.add_verdict(Verdict::bad, fmt::format("{} of {} rows were not computed; the column note says why",
                                                   sweep.n_not_computed, sweep.table->n_rows()));
      else if (n_runs == 0)
        page.add_verdict(Verdict::good, fmt::format("{} rows, {} curves", sweep.table->n_rows(), sweep.curves.size()));
      else
        page.add_verdict(n_done == n_runs ? Verdict::good : Verdict::bad,
                         fmt::format("{} of {} runs completed", n_done, n_runs));
    }

    HtmlTable peak_table(const std::vector<FrequencyCurve> &curves)
    {
      HtmlTable table{{"curve", "points", "farthest (mm)", "at (Hz)", ""}, {}};
      for (const FrequencyCurve &curve : curves)
        table.rows.push_back({{curve.name},
                              {std::to_string(curve.points.size())},
                              {signed_number(mm * curve.peak().displacement_m, n_digits)},
                              {plain_number(curve.peak().frequency_Hz, n_digits)},
                              {curve.peaks_at_its_end() ? "at the end of the curve" : ""}});
      return table;
    }

    void add_curves(HtmlPage &page, const std::vector<FrequencyCurve> &curves)
    {
      page.add_heading("Peak of each curve: displacement per period, positive head first");
      page.add_table(peak_table(curves));
      for (const FrequencyCurve &curve : curves)
        if (curve.is_ambiguous())
          page.add_warning(
              fmt::format("{} has several points at one frequency: something else differs between them.", curve.name));
    }

    /// Empty if the run has no page.
    std::string target_of(const SweepRun &entry, const fs::path &page_folder)
    {
      const fs::path page = entry.folder / page_name;
      return fs::exists(page) ? link_target(fs::proximate(page, page_folder)) : "";
    }

    std::vector<HtmlCell> run_row(const SweepRun &entry, const fs::path &page_folder)
    {
      const auto &[scene, summary] = std::tie(entry.run.scene, entry.run.record.summary);
      const bool        balanced   = has_full_period(summary) && summary.power_imbalance;
      const bool        swam       = has_full_period(summary) && !(scene && !scene->head.is_free());
      const bool        periodic   = scene && scene->field.period_s() > 0.;
      const std::string none       = "–";
      return {{entry.run.name, target_of(entry, page_folder)},
              {summary.status},
              {periodic ? plain_number(1. / scene->field.period_s(), n_digits) : none},
              {scene && scene->tail ? plain_number(scene->tail->young_modulus_Pa, n_digits) : none},
              {swam ? signed_number(mm * summary.displacement_per_period_m.back(), n_digits) : none},
              {balanced ? signed_number(percent * *summary.power_imbalance, n_digits_rounded) : none},
              {plain_number(summary.cpu_time_s, n_digits)}};
    }

    void add_runs(HtmlPage &page, const SweepFolder &sweep, const fs::path &page_folder)
    {
      HtmlTable table{{"run", "status", "frequency (Hz)", "E (Pa)", "last period (mm)", "imbalance (%)", "CPU (s)"},
                      {}};
      for (const SweepRun &entry : sweep.runs)
        table.rows.push_back(run_row(entry, page_folder));
      page.add_heading("Runs");
      page.add_table(table);
      for (const SweepRun &entry : sweep.runs)
        if (!entry.run.warning.empty())
          page.add_warning(entry.run.warning);
    }

    void add_rows(HtmlPage &page, const SweepFolder &sweep)
    {
      HtmlTable table{sweep.table->column_names(), {}};
      for (std::size_t i = 0; i < sweep.table->n_rows(); ++i)
      {
        table.rows.emplace_back();
        for (const std::string &cell : sweep.table->cells(i))
          table.rows.back().push_back({cell});
      }
      page.add_heading("displacement_frequency.csv");
      page.add_table(table);
      if (!sweep.comments.empty())
        page.add_preformatted(sweep.comments);
    }
  } // namespace

  HtmlPage sweep_page(const SweepFolder &sweep, const Illustrations &illustrations, const fs::path &page_folder)
  {
    HtmlPage page(fmt::format("Sweep {}", sweep.name));
    add_verdict(page, sweep);
    if (sweep.origin)
      page.add_warnings(sweep.origin->warnings);
    add_illustrations(page, illustrations);
    if (!sweep.curves.empty())
      add_curves(page, sweep.curves);
    if (!sweep.runs.empty())
      add_runs(page, sweep, page_folder);
    if (sweep.table)
      add_rows(page, sweep);
    if (sweep.origin && sweep.comments.empty()) // older tables say it themselves
      add_provenance(page, sweep.origin->provenance,
                     {{"reduced model", fmt::format("{}, {} modes", sweep.origin->model_file, sweep.origin->n_modes)}});
    return page;
  }
} // namespace swimtwin
