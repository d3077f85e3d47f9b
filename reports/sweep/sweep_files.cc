#include <reports/sweep/sweep_files.h>

#include <datasets/files/hdf5_file.h>
#include <datasets/files/hdf5_provenance.h>
#include <datasets/files/json_entries.h>
#include <datasets/reduced/held_out_error.h>
#include <datasets/text/csv_writer.h>
#include <datasets/text/text_line.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace swimtwin
{
  namespace
  {
    struct Column
    {
      const char                                *name, *units, *description;
      std::function<double(const SweepResult &)> value;
    };

    const std::vector<Column> &columns()
    {
      using Result                         = const SweepResult &;
      static const std::vector<Column> all = {
          {"young_modulus_Pa", "Pa", "of the tail", [](Result r) { return r.member.parameters.young_modulus_Pa; }},
          {"frequency_Hz", "Hz", "of the field", [](Result r) { return r.member.frequency_Hz; }},
          {"displacement_m", "m", "of the head in the third period, positive head first",
           [](Result r) { return r.displacement_m; }},
          {"viscosity_Pa_s", "Pa s", "of the fluid", [](Result r) { return r.member.parameters.viscosity_Pa_s; }},
          {"magnetization_A_m", "A/m", "of the head", [](Result r) { return r.member.parameters.magnetization_A_m; }},
          {"bx_T", "T", "constant component of the field", [](Result r) { return r.member.bx_T; }},
          {"by_T", "T", "amplitude of the swinging component", [](Result r) { return r.member.by_T; }},
          {"periodic_displacement_m", "m", "per period of the periodic motion, positive head first",
           [](Result r) { return r.periodic_displacement_m; }},
          {"error_indicator_m", "m", "what the last modes change in the displacement of the third period",
           [](Result r) { return r.error_indicator_m; }},
          {"inside_trained_range", "1", "1: parameters, shapes and angles are those the model was trained for; 0: not",
           [](Result r) { return r.trust.inside() ? 1. : 0.; }},
          {"held_out_error", "1", "relative error of the displacement in held-out full-order runs nearby",
           [](Result r) { return r.held_out_error; }},
          {"error_95_m", "m", "the full-order displacement is within this with 95 %",
           [](Result r) { return r.error_95_m; }}};
      return all;
    }

    std::string note(const SweepResult &result)
    {
      std::string text = result.trust.text();
      if (!result.note.empty())
        text += fmt::format("{}{}", text.empty() ? "" : "; ", result.note);
      return text.empty() ? "ok" : text;
    }

    /// The members that were not computed, and why.
    Json failures_json(const std::vector<SweepResult> &results)
    {
      Json failures = Json::array();
      for (const SweepResult &result : results)
        if (!was_computed(result))
        {
          const auto &[parameters, bx_T, by_T, frequency_Hz] = result.member;
          failures.push_back({{"young_modulus_Pa", parameters.young_modulus_Pa},
                              {"viscosity_Pa_s", parameters.viscosity_Pa_s},
                              {"magnetization_A_m", parameters.magnetization_A_m},
                              {"bx_T", bx_T},
                              {"by_T", by_T},
                              {"frequency_Hz", frequency_Hz},
                              {"note", result.note}});
        }
      return failures;
    }

    Json range_json(const TrainedRange &range)
    {
      const auto pair = [](const Interval &interval) { return std::vector<double>{interval.low, interval.high}; };
      return {{"young_modulus_Pa", pair(range.young_modulus_Pa)},
              {"viscosity_Pa_s", pair(range.viscosity_Pa_s)},
              {"magnetization_A_m", pair(range.magnetization_A_m)},
              {"frequency_Hz", pair(range.frequency_Hz)},
              {"bx_T", pair(range.bx_T)},
              {"by_T", pair(range.by_T)}};
    }

    Json model_json(const ReducedModel &model, const SweepRecord &record)
    {
      const HeldOutError error = displacement_error(model.record);
      auto               runs  = Json::array();
      for (std::size_t i = 0; i < model.record.held_out_runs.size(); ++i)
      {
        const HeldOutRun &run     = model.record.held_out_runs[i];
        const double      bound_m = left_out_bound_m(model.record, i);
        runs.push_back({{"young_modulus_Pa", run.young_modulus_Pa},
                        {"magnetization_A_m", run.magnetization_A_m},
                        {"frequency_Hz", run.frequency_Hz},
                        {"displacement_m", run.displacement_m},
                        {"displacement_error_m", run.displacement_error_m},
                        {"reduced_displacement_m", run.reduced_displacement_m},
                        {"error_indicator_m", run.indicator_m},
                        {"fit_change_m", run.fit_change_m},
                        {"error_95_by_the_others_m", std::isnan(bound_m) ? Json() : Json(bound_m)}});
      }
      return {{"file", record.model_file},
              {"n_modes", record.n_modes},
              {"trained_range", range_json(model.range)},
              {"held_out_runs", runs},
              {"held_out_error_rms", error.is_known() ? Json(error.rms) : Json()},
              {"held_out_error_worst", error.is_known() ? Json(error.worst) : Json()},
              {"target", target_of(model.record)},
              {"training", model.record.history},
              {"training_cpu_time_s", model.record.cpu_time_s},
              {"neglects", model.record.neglects}};
    }
  } // namespace

  bool was_computed(const SweepResult &result)
  {
    return std::isfinite(result.displacement_m);
  }

  std::vector<FrequencyCurve> curves_of(const std::vector<SweepResult> &results)
  {
    std::vector<SweepPoint> points;
    for (const SweepResult &result : results)
      if (const SweepMember &m = result.member; was_computed(result))
        points.push_back({m.parameters.young_modulus_Pa, m.parameters.magnetization_A_m, m.frequency_Hz,
                          result.displacement_m, m.parameters.viscosity_Pa_s, m.bx_T, m.by_T});
    return frequency_curves(points);
  }

  void write_sweep_table(const std::filesystem::path &file, const std::vector<SweepResult> &results)
  {
    std::vector<std::string> names;
    for (const Column &column : columns())
      names.emplace_back(column.name);
    names.insert(names.end(), {"status", "note"});
    CsvWriter table(names);
    for (const SweepResult &result : results)
    {
      for (const Column &column : columns())
        table.cell(column.value(result));
      table.cell(was_computed(result) ? "completed" : "failed").cell(note(result)).end_row();
    }
    table.save(file);
  }

  void write_sweep_data(const std::filesystem::path &file, const std::vector<SweepResult> &results,
                        const SweepRecord &record)
  {
    Hdf5Writer writer;
    const auto add = [&](const Column &column) {
      std::vector<double> values;
      for (const SweepResult &result : results)
        values.push_back(column.value(result));
      writer.write_vector(fmt::format("/{}", column.name), std::span<const double>(values),
                          {column.units, column.description});
    };
    std::string notes;
    for (const SweepResult &result : results)
      notes += text_line(note(result)) + "\n";
    std::for_each(columns().begin(), columns().end(), add);
    add({"largest_multiplier", "1", "largest Floquet multiplier of the periodic motion, in size",
         [](const SweepResult &r) { return r.largest_multiplier; }});
    add({"cpu_time_s", "s", "of this member", [](const SweepResult &r) { return r.cpu_time_s; }});
    writer.write_text("/notes", notes, {"1", "one line per member: why it may not be trusted, or what was not found"});
    write_provenance(writer, record.provenance);
    writer.save(file);
  }

  void write_sweep_summary(const std::filesystem::path &file, const ReducedModel &model,
                           const std::vector<SweepResult> &results, const SweepRecord &record)
  {
    auto peaks = Json::array();
    for (const FrequencyCurve &curve : curves_of(results))
      peaks.push_back({{"curve", curve.name},
                       {"frequency_Hz", curve.peak().frequency_Hz},
                       {"displacement_m", curve.peak().displacement_m},
                       {"at_end_of_curve", curve.peaks_at_its_end()}});
    write_json_file(file, {{"status", record.status},
                           {"n_members", record.n_members},
                           {"n_outside_trained_range", record.n_outside_trained_range},
                           {"n_not_computed", record.n_not_computed},
                           {"not_computed", failures_json(results)},
                           {"n_threads", record.n_threads},
                           {"wall_time_s", record.wall_time_s},
                           {"cpu_time_s", record.cpu_time_s},
                           {"peaks", peaks},
                           {"warnings", record.warnings},
                           {"model", model_json(model, record)},
                           {"provenance", json_of(record.provenance)}});
  }
} // namespace swimtwin
