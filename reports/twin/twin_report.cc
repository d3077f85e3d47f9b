#include <reports/page/number_text.h>
#include <reports/page/provenance_section.h>
#include <reports/page/shown_units.h>
#include <reports/twin/twin_report.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    std::string value_text(const double value)
    {
      return std::isfinite(value) ? plain_number(value, result_digits) : "";
    }

    void add_verdict(HtmlPage &page, const TwinRecord &record)
    {
      if (record.n_rows == 0)
        return page.add_verdict(Verdict::bad, "nothing was seen");
      const bool ended = record.status.has_value();
      page.add_verdict(
          ended ? Verdict::good : Verdict::bad,
          fmt::format("{}; {} estimates over {}; {}", ended ? *record.status : "interrupted", record.n_rows,
                      duration_text(record.time_s().back() - record.time_s().front()),
                      record.alarms.empty() ? "no alarm" : fmt::format("{} alarms", record.alarms.size())));
      if (!ended)
        page.add_warning("The twin did not come to its end; go on with it with --resume.");
      for (const std::string &direction : record.keeps_its_prior)
        page.add_warning("The motion does not tell " + direction + ".");
    }

    HtmlTable parameter_table(const TwinRecord &record)
    {
      HtmlTable table{{"parameter", "unit", "at the start", "± sd", "at the end", "± sd"}, {}};
      for (const TwinParameterName &p : record.parameters)
      {
        const auto &value = record.columns.at(p.column), &sd = record.columns.at("sd_of_" + p.column);
        table.rows.push_back({{p.symbol},
                              {p.unit},
                              {value_text(p.factor * value.front())},
                              {plain_number(p.factor * sd.front(), 2)},
                              {value_text(p.factor * value.back())},
                              {plain_number(p.factor * sd.back(), 2)}});
      }
      return table;
    }

    HtmlTable alarm_table(const TwinRecord &record)
    {
      constexpr std::size_t most = 200;
      HtmlTable             table{{"since (s)", "until (s)", "alarm", "what", "what to do"}, {}, true};
      for (std::size_t i = 0; i < std::min(most, record.alarms.size()); ++i)
      {
        const RecordedAlarm &a = record.alarms[i];
        table.rows.push_back({{fmt::format("{:.2f}", a.since_s)},
                              {a.until_s ? fmt::format("{:.2f}", *a.until_s) : ""},
                              {a.name},
                              {a.what},
                              {a.remedy}});
      }
      return table;
    }

    HtmlTable proposal_table(const TwinRecord &record)
    {
      constexpr std::size_t most = 200;
      HtmlTable             table{{"at (s)", "parameter", "after (s)", "± sd as it is", "± sd proposed", "at (Hz)",
                                   "largest |B| (mT)", "speed (µm/s), was"},
                      {},
                      true};
      const auto            sd = [](const double value) { return plain_number(value, 3); };
      for (std::size_t i = 0; i < std::min(most, record.proposals.size()); ++i)
      {
        const RecordedProposal        &p = record.proposals[i];
        const RecordedProposal::Field &f = p.proposed.value_or(p.as_is);
        table.rows.push_back(
            {{fmt::format("{:.2f}", p.time_s)},
             {p.parameter},
             {fmt::format("{:.2f}", p.ahead_s)},
             {sd(p.as_is.sd)},
             {p.proposed ? sd(f.sd) : "nothing better"},
             {plain_number(f.frequency_Hz, 3)},
             {plain_number(1e3 * f.largest_T, 3)},
             {fmt::format("{}, {}", plain_number(1e6 * f.speed_m_s, 3), plain_number(1e6 * p.as_is.speed_m_s, 3))}});
      }
      return table;
    }

    HtmlTable count_table(const TwinRecord &record)
    {
      HtmlTable table{{}, {}};
      for (const auto &[name, n] : record.counts)
        table.rows.push_back({{name}, {std::to_string(n)}});
      return table;
    }

    /// Over the shown rows on the path.
    HtmlTable goal_table(const TwinRecord &record)
    {
      double sum = 0., largest = 0., took = 0.;
      long   n = 0, n_late = 0;
      for (std::size_t i = 0; i < record.steering.at("distance_m").size(); ++i)
      {
        const double distance = record.steering.at("distance_m")[i];
        n_late += record.steering.at("decided_in_time")[i] == 0.;
        took = std::max(took, record.steering.at("took_s")[i]);
        if (!std::isfinite(distance))
          continue;
        sum += distance * distance;
        largest = std::max(largest, distance);
        ++n;
      }
      const double rms = n > 0 ? std::sqrt(sum / static_cast<double>(n)) : std::nan("");
      return {{},
              {{{"where it ended"}, {record.phase.empty() ? "interrupted" : record.phase}},
               {{"along the path (mm)"},
                {fmt::format("{} of {}", value_text(mm * record.arc_m), value_text(mm * record.path_length_m))}},
               {{"mean position to path as estimated, rms (mm)"}, {value_text(mm * rms)}},
               {{"largest (mm)"}, {value_text(mm * largest)}},
               {{"decisions"}, {std::to_string(record.n_steering_rows)}},
               {{"too late, of those shown"}, {std::to_string(n_late)}},
               {{"slowest of those shown (ms)"}, {value_text(ms * took)}}}};
    }
  } // namespace

  HtmlPage twin_page(const TwinRecord &record, const Illustrations &illustrations)
  {
    HtmlPage page(fmt::format("Twin {}", record.name));
    add_verdict(page, record);
    if (record.n_rows > 0 && !record.parameters.empty())
    {
      page.add_heading("Parameters");
      page.add_table(parameter_table(record));
    }
    if (record.n_steering_rows > 0)
    {
      page.add_heading("Goal");
      page.add_table(goal_table(record));
    }
    if (!record.alarms.empty())
    {
      page.add_heading("Alarms");
      page.add_table(alarm_table(record));
    }
    if (!record.proposals.empty())
    {
      page.add_heading("Fields that would tell more");
      page.add_table(proposal_table(record));
    }
    add_illustrations(page, illustrations);
    if (!record.counts.empty())
    {
      page.add_heading("Lines");
      page.add_table(count_table(record));
    }
    if (record.provenance)
      add_provenance(page, *record.provenance);
    return page;
  }
} // namespace swimtwin
