#include <reports/fit/calibration_report.h>

#include <reports/fit/calibration_tables.h>
#include <reports/fit/fitted_quantity.h>
#include <reports/page/number_text.h>
#include <reports/page/provenance_section.h>
#include <reports/page/refinement_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {

    std::string headline(const CalibrationResult &result)
    {
      std::string text = result.status;
      for (const CalibratedParameter &parameter : result.parameters)
        if (parameter.role != ParameterRole::fixed && !parameter.undetermined && parameter.interval().is_finite())
        {
          const ShownQuantity shown = shown_quantity(parameter.name, parameter.value);
          text += fmt::format("; {} = {} ({})", shown.label(), plain_number(shown.factor * parameter.value, 4),
                              interval_text(parameter.interval(), shown));
        }
      return text;
    }

    void add_verdict(HtmlPage &page, const CalibrationResult &result)
    {
      page.add_verdict(result.converged() ? Verdict::good : Verdict::bad, headline(result));
      if (!result.message.empty())
        page.add_paragraph(result.message);
      page.add_warnings(result.warnings);
    }

    /// The reasons why bounds are missing, each once.
    std::vector<std::string> notes_of(const CalibratedParameter &parameter)
    {
      std::vector<std::string> notes;
      for (const ClaimedInterval *interval : {&parameter.profile, &parameter.bootstrap, &parameter.curvature})
        if (!interval->note.empty() && std::find(notes.begin(), notes.end(), interval->note) == notes.end())
          notes.push_back(interval->note);
      return notes;
    }

    void add_notes_on_intervals(HtmlPage &page, const CalibrationResult &result)
    {
      for (const CalibratedParameter &parameter : result.parameters)
        for (const std::string &note : notes_of(parameter))
          page.add_paragraph(fmt::format("{}: {}", shown_quantity(parameter.name, parameter.value).symbol, note));
    }

    void add_parameters(HtmlPage &page, const CalibrationResult &result)
    {
      page.add_heading("Parameters");
      page.add_table(parameter_table(result));
      add_notes_on_intervals(page, result);
      if (const HtmlTable correlations = correlation_table(result); !correlations.rows.empty())
      {
        page.add_heading("Correlations");
        page.add_table(correlations);
      }
      page.add_heading("The swimmer at the estimate");
      page.add_table(swimmer_table(result.swimmer));
    }

    /// What hardly takes part is left out.
    std::string components_of(const NullDirection &null, const CalibrationResult &result)
    {
      std::string                    text;
      const std::vector<std::string> names = result.free_names();
      for (Eigen::Index k = 0; k < null.direction.size() && k < static_cast<Eigen::Index>(names.size()); ++k)
        if (std::abs(null.direction[k]) > 0.01)
          text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                              shown_quantity(names[static_cast<std::size_t>(k)], 1.).symbol,
                              signed_number(null.direction[k], rounded_digits));
      return text;
    }

    void add_null_directions(HtmlPage &page, const CalibrationResult &result)
    {
      page.add_heading("What the data cannot tell");
      if (result.null_directions.empty())
        return page.add_paragraph("Every free parameter is determined by the data.");
      HtmlTable table{{"direction (in logarithms)", "strength", "decided by", "meaning"}, {}, true};
      for (const NullDirection &null : result.null_directions)
        table.rows.push_back({{components_of(null, result)},
                              {plain_number(null.strength, rounded_digits)},
                              {null.has_prior ? "its prior alone" : "nothing"},
                              {null.reading}});
      page.add_table(table);
    }

    void add_discrepancy(HtmlPage &page, const ModelDiscrepancy &discrepancy)
    {
      page.add_heading("The reduced model's own error");
      page.add_paragraph(fmt::format("{} % of the displacement (standard deviation), from: {}.",
                                     plain_number(100. * discrepancy.relative_size, rounded_digits),
                                     discrepancy.origin.empty() ? "none" : discrepancy.origin));
      if (!discrepancy.checks.empty())
        page.add_table(full_order_table(discrepancy));
      if (!discrepancy.verdict.empty())
        page.add_paragraph(discrepancy.verdict);
    }

    void add_next(HtmlPage &page, const NextExperiment &next)
    {
      page.add_heading("The next experiment");
      page.add_paragraph(fmt::format(
          "One more observation at {} Hz in the field of {} would shrink the interval of {} to {} % "
          "of today's; for all parameters together the most informative frequency is {} Hz.",
          plain_number(next.best_frequency_Hz, rounded_digits), next.data_set,
          shown_quantity(next.parameter, 1.).symbol, plain_number(100. * next.best_interval_ratio, rounded_digits),
          plain_number(next.most_informative_frequency_Hz, rounded_digits)));
    }

    void add_origin(HtmlPage &page, const CalibrationResult &result)
    {
      add_provenance(page, result.provenance,
                     {{"reduced model", result.model_file},
                      {"scene", result.scene_name},
                      {"data", fmt::format("{}", fmt::join(result.data_files, ", "))}});
      page.add_heading("Problem");
      page.add_preformatted(result.problem_text);
    }
  } // namespace

  bool is_calibration(const fs::path &folder)
  {
    std::error_code unreadable;
    return fs::exists(folder / "calibration.json", unreadable);
  }

  HtmlPage calibration_page(const CalibrationResult &result, const std::string &name,
                            const Illustrations &illustrations)
  {
    HtmlPage page(fmt::format("Fit {}", name));
    add_verdict(page, result);
    add_parameters(page, result);
    add_null_directions(page, result);
    add_illustrations(page, illustrations);
    page.add_heading("Observations and residuals");
    page.add_table(observation_table(result));
    add_discrepancy(page, result.discrepancy);
    add_refinement(page, result.refinement);
    if (result.next)
      add_next(page, *result.next);
    page.add_heading("How the minimum was found");
    page.add_table(search_table(result));
    add_origin(page, result);
    return page;
  }
} // namespace swimtwin
