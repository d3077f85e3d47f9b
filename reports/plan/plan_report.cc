#include <reports/plan/plan_report.h>

#include <reports/page/number_text.h>
#include <reports/page/provenance_section.h>
#include <reports/page/refinement_table.h>
#include <reports/page/shown_units.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {

    std::string number(const double value)
    {
      return plain_number(value, result_digits);
    }

    void add_verdict(HtmlPage &page, const PlanResult &plan)
    {
      const bool found = plan.status == "converged";
      page.add_verdict(found ? Verdict::good : Verdict::bad,
                       fmt::format("{}: gain {} over the tuned sinusoid", plan.status, number(plan.gain())));
      page.add_paragraph(plan.message + ".");
      page.add_paragraph("The gain is " + plan.confirmation() + ".");
      page.add_warnings(plan.warnings);
    }

    HtmlTable field_table(const PlanResult &plan)
    {
      HtmlTable table{{"field", "mean speed (µm/s)", "per period (mm)", "frequency (Hz)", "multiplier", "|B| (mT)",
                       "dB/dt (T/s)", "shape radius", "tail strain", "head angle (degrees)"},
                      {}};
      for (const PlannedField &field : plan.fields)
        if (field.moves)
          table.rows.push_back({{field.name},
                                {number(um * field.mean_speed_m_s)},
                                {number(mm * field.displacement_m)},
                                {number(field.frequency_Hz)},
                                {field.multipliers.empty() ? "unknown" : number(field.multipliers.front())},
                                {number(mT * field.largest_field_T)},
                                {number(field.largest_slew_T_s)},
                                {number(field.largest_shape_radius)},
                                {number(field.largest_strain)},
                                {number(degrees * field.largest_heading_deviation_rad)}});
        else
          table.rows.push_back({{field.name}, {field.message}});
      return table;
    }

    HtmlTable search_table(const PlanResult &plan)
    {
      HtmlTable table{{"search", "status", "first-order residual", "starts", "evaluations", "with gradients",
                       "periods integrated", "limits exceeded by (%)"},
                      {}};
      for (const PlannedField &field : plan.fields)
        if (field.n_evaluations > 0)
          table.rows.push_back({{field.name},
                                {field.status},
                                {number(field.kkt_residual)},
                                {std::to_string(field.n_starts)},
                                {std::to_string(field.n_evaluations)},
                                {std::to_string(field.n_gradients)},
                                {std::to_string(field.n_periods)},
                                {number(percent * std::max({0., field.field_excess, field.motion_excess}))}});
      return table;
    }

    HtmlTable coefficient_table(const PlannedField &field)
    {
      HtmlTable table{{"", "bx (mT)", "by (mT)"}, {}};
      for (std::size_t i = 0; i < field.bx_T.size(); ++i)
        table.rows.push_back({{i == 0 ? "bias" : fmt::format("{} {}", i % 2 == 1 ? "cos" : "sin", (i + 1) / 2)},
                              {number(mT * field.bx_T[i])},
                              {number(mT * field.by_T[i])}});
      return table;
    }

    HtmlTable replay_table(const PlanReplay &replay)
    {
      HtmlTable table{{"field", "period", "full order (mm)", "reduced (mm)", "difference (%)"}, {}};
      for (const ReplayedField &field : replay.fields)
        for (std::size_t i = 0; i < field.displacement_m.size(); ++i)
          table.rows.push_back({{field.name},
                                {std::to_string(i + 1)},
                                {number(mm * field.displacement_m[i])},
                                {number(mm * field.reduced_displacement_m[i])},
                                {number(percent * (field.reduced_displacement_m[i] / field.displacement_m[i] - 1.))}});
      return table;
    }

    HtmlTable trade_off_table(const PlanResult &plan)
    {
      HtmlTable table{{"largest multiplier", "tuned (µm/s)", "at (Hz)", "optimal (µm/s)", "at (Hz)", "gain", ""}, {}};
      for (const TradeOffPoint &point : plan.trade_off)
        table.rows.push_back({{number(point.largest_multiplier)},
                              {number(um * point.tuned_speed_m_s)},
                              {number(point.tuned_frequency_Hz)},
                              {number(um * point.optimal_speed_m_s)},
                              {number(point.optimal_frequency_Hz)},
                              {number(point.optimal_speed_m_s / point.tuned_speed_m_s)},
                              {point.optimal_status}});
      return table;
    }

    HtmlTable member_table(const PlanResult &plan)
    {
      HtmlTable table{
          {"E (Pa)", "viscosity (Pa s)", "magnetization (A/m)", "optimal (µm/s)", "tuned (µm/s)", "gain", "multiplier"},
          {}};
      for (const PlannedMember &member : plan.members)
        table.rows.push_back(
            {{number(member.young_modulus_Pa)},
             {number(member.viscosity_Pa_s)},
             {number(member.magnetization_A_m)},
             {number(um * member.mean_speed_m_s)},
             {number(um * member.tuned_speed_m_s)},
             {number(member.mean_speed_m_s / member.tuned_speed_m_s)},
             {std::isfinite(member.largest_multiplier) ? number(member.largest_multiplier) : "unknown"}});
      return table;
    }
  } // namespace

  HtmlPage plan_page(const PlanFolder &folder, const Illustrations &illustrations)
  {
    const PlanResult &plan = folder.plan;
    HtmlPage          page(fmt::format("Field plan {}", folder.name));
    add_verdict(page, plan);
    page.add_heading("Fields");
    page.add_table(field_table(plan));
    if (plan.replay)
    {
      page.add_heading("Replay on the full-order model: displacement per period");
      page.add_table(replay_table(*plan.replay));
    }
    add_refinement(page, plan.refinement);
    if (!plan.members.empty())
    {
      page.add_heading("Swimmers of the calibration's sample");
      page.add_table(member_table(plan));
    }
    if (!plan.trade_off.empty())
    {
      page.add_heading("Speed against heading stability");
      page.add_table(trade_off_table(plan));
    }
    add_illustrations(page, illustrations);
    page.add_heading("Searches");
    page.add_table(search_table(plan));
    if (const PlannedField *best = plan.find(optimal_field_name); best != nullptr && !best->bx_T.empty())
    {
      page.add_heading("Harmonics of the optimal field");
      page.add_table(coefficient_table(*best));
    }
    page.add_heading("Goal");
    page.add_preformatted(plan.goal_text);
    add_provenance(page, plan.provenance);
    return page;
  }
} // namespace swimtwin
