#include <reports/fit/calibration_files.h>

#include <datasets/files/output_folder.h>
#include <datasets/text/csv_writer.h>
#include <datasets/text/text_line.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    CsvWriter parameters(const CalibrationResult &result)
    {
      CsvWriter table({"parameter", "role", "value", "standard_error", "interval_low", "interval_high", "method",
                       "undetermined", "note"});
      for (const CalibratedParameter &p : result.parameters)
      {
        table.cell(p.name).cell(std::string(to_string(p.role))).cell(p.value).cell(p.standard_error);
        table.cell(p.interval().low).cell(p.interval().high).cell(p.interval().method);
        table.cell(p.undetermined ? 1 : 0).cell(p.interval().note).end_row();
      }
      return table;
    }

    CsvWriter residuals(const CalibrationResult &result)
    {
      CsvWriter table({"data_set", "frequency_Hz", "observed_m", "sigma_m", "predicted_m", "model_error_m",
                       "standardised_residual", "weight", "trust"});
      for (const ObservationResidual &r : result.residuals)
      {
        table.cell(r.data_set).cell(r.frequency_Hz).cell(r.observed).cell(r.sigma).cell(r.predicted);
        table.cell(r.model_error).cell(r.standardised).cell(r.weight).cell(r.trust.empty() ? "ok" : r.trust).end_row();
      }
      return table;
    }

    CsvWriter bands(const CalibrationResult &result)
    {
      CsvWriter table(
          {"data_set", "frequency_Hz", "predicted_m", "low_m", "high_m", "observation_low_m", "observation_high_m"});
      for (const PredictionBand &b : result.bands)
        for (std::size_t i = 0; i < b.frequency_Hz.size(); ++i)
        {
          table.cell(b.data_set).cell(b.frequency_Hz[i]).cell(b.value[i]).cell(b.low[i]).cell(b.high[i]);
          table.cell(b.observation_low[i]).cell(b.observation_high[i]).end_row();
        }
      return table;
    }

    CsvWriter profiles(const CalibrationResult &result)
    {
      CsvWriter table({"parameter", "value", "misfit_increase", "threshold"});
      for (const ParameterProfile &p : result.profiles)
        for (std::size_t i = 0; i < p.value.size(); ++i)
          table.cell(p.name).cell(p.value[i]).cell(p.misfit_increase[i]).cell(p.threshold).end_row();
      return table;
    }

    CsvWriter starts(const CalibrationResult &result)
    {
      std::vector<std::string> columns = {"misfit", "misfit_at_start", "status", "evaluations", "kkt_residual"}, names;
      for (const CalibratedParameter &p : result.parameters)
        if (p.role == ParameterRole::free && p.name != "noise_scale")
          names.push_back(p.name);
      for (const char *where : {"start", "end"})
        for (const std::string &name : names)
          columns.push_back(fmt::format("{}_{}", where, name));
      CsvWriter table(columns);
      for (const FitStart &s : result.starts)
      {
        table.cell(s.misfit).cell(s.misfit_at_start).cell(s.status).cell(s.n_evaluations).cell(s.kkt_residual);
        for (const Eigen::VectorXd *values : {&s.start, &s.end})
          for (const double value : *values)
            table.cell(value);
        table.end_row();
      }
      return table;
    }

    CsvWriter posterior(const CalibrationResult &result)
    {
      CsvWriter table({"young_modulus_Pa", "viscosity_Pa_s", "magnetization_A_m", "field_scale", "geometry_scale",
                       "displacement_offset_m", "displacement_scale"});
      for (const CalibratedSwimmer &s : result.posterior)
      {
        table.cell(s.young_modulus_Pa).cell(s.viscosity_Pa_s).cell(s.magnetization_A_m).cell(s.field_scale);
        table.cell(s.geometry_scale).cell(s.displacement_offset_m).cell(s.displacement_scale).end_row();
      }
      return table;
    }

    CsvWriter next_experiment(const CalibrationResult &result)
    {
      CsvWriter table({"data_set", "frequency_Hz", "interval_ratio", "information_gain"});
      if (const auto &next = result.next)
        for (std::size_t i = 0; i < next->frequency_Hz.size(); ++i)
          table.cell(next->data_set)
              .cell(next->frequency_Hz[i])
              .cell(next->interval_ratio[i])
              .cell(next->information_gain[i])
              .end_row();
      return table;
    }

    using Table = std::pair<const char *, CsvWriter (*)(const CalibrationResult &)>;
    const std::vector<Table> &tables()
    {
      static const std::vector<Table> all = {{"parameters.csv", parameters},
                                             {"residuals.csv", residuals},
                                             {"band.csv", bands},
                                             {"profiles.csv", profiles},
                                             {"starts.csv", starts},
                                             {"posterior.csv", posterior},
                                             {"next_experiment.csv", next_experiment}};
      return all;
    }

    /// As comments of a TOML file.
    std::string origin(const CalibrationResult &result)
    {
      return fmt::format("# {}, {}\n# {}\n# model {}; scene {}\n# status of the fit: {}\n\n",
                         result.provenance.program_version, result.provenance.created,
                         text_line(result.provenance.command_line), text_line(result.model_file),
                         result.provenance.scene_hash, result.status);
    }
  } // namespace

  std::vector<std::string> calibration_file_names()
  {
    std::vector<std::string> names = {calibration_result_name, fitted_scene_name, fitted_field_name,
                                      fitted_field_period_name};
    for (const auto &[name, make] : tables())
      names.emplace_back(name);
    return names;
  }

  void write_calibration_files(const std::filesystem::path &folder, const CalibrationResult &result,
                               const Scene &fitted)
  {
    for (const auto &[name, make] : tables())
    {
      const CsvWriter table = make(result);
      if (table.n_rows() > 0)
        table.save(folder / name);
      else
        std::filesystem::remove(folder / name); // of an earlier calibration
    }
    write_text_atomically(folder / fitted_scene_name, origin(result) + fitted.text);
    write_calibration_result(folder / calibration_result_name, result);
  }
} // namespace swimtwin
