#include <reports/fit/calibration_files.h>

#include <datasets/output_folder.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace swimtwin
{
  namespace
  {
    /// A table as text, without its header comment.
    class CsvText
    {
    public:
      explicit CsvText(const std::vector<std::string> &columns) : text_(fmt::format("{}\n", fmt::join(columns, ","))) {}

      CsvText &cell(const double value) { return word(std::isfinite(value) ? fmt::format("{:.12g}", value) : ""); }
      CsvText &cell(const std::optional<double> &value) { return value ? cell(*value) : word(""); }
      /// Without the table's separator.
      CsvText &cell(std::string value)
      {
        std::replace(value.begin(), value.end(), ',', ';');
        return word(value);
      }
      CsvText &cell(const int value) { return word(fmt::format("{}", value)); }
      void     end_row()
      {
        text_ += line_ + "\n";
        line_.clear();
        begun_ = false;
        ++n_rows_;
      }

      const std::string &text() const { return text_; }
      int                n_rows() const { return n_rows_; }

    private:
      CsvText &word(const std::string &value)
      {
        line_ += (begun_ ? "," : "") + value;
        begun_ = true;
        return *this;
      }

      std::string text_, line_;
      bool        begun_  = false;
      int         n_rows_ = 0;
    };

    CsvText parameters(const CalibrationResult &result)
    {
      CsvText table({"parameter", "role", "value", "standard_error", "interval_low", "interval_high", "method",
                     "undetermined", "note"});
      for (const CalibratedParameter &p : result.parameters)
      {
        table.cell(p.name).cell(std::string(to_string(p.role))).cell(p.value).cell(p.standard_error);
        table.cell(p.interval().low).cell(p.interval().high).cell(p.interval().method);
        table.cell(p.undetermined ? 1 : 0).cell(p.interval().note).end_row();
      }
      return table;
    }

    CsvText residuals(const CalibrationResult &result)
    {
      CsvText table({"data_set", "frequency_Hz", "observed_m", "sigma_m", "predicted_m", "model_error_m",
                     "standardised_residual", "weight", "trust"});
      for (const ObservationResidual &r : result.residuals)
      {
        table.cell(r.data_set).cell(r.frequency_Hz).cell(r.observed).cell(r.sigma).cell(r.predicted);
        table.cell(r.model_error).cell(r.standardised).cell(r.weight).cell(r.trust.empty() ? "ok" : r.trust).end_row();
      }
      return table;
    }

    CsvText bands(const CalibrationResult &result)
    {
      CsvText table(
          {"data_set", "frequency_Hz", "predicted_m", "low_m", "high_m", "observation_low_m", "observation_high_m"});
      for (const PredictionBand &b : result.bands)
        for (std::size_t i = 0; i < b.frequency_Hz.size(); ++i)
        {
          table.cell(b.data_set).cell(b.frequency_Hz[i]).cell(b.value[i]).cell(b.low[i]).cell(b.high[i]);
          table.cell(b.observation_low[i]).cell(b.observation_high[i]).end_row();
        }
      return table;
    }

    CsvText profiles(const CalibrationResult &result)
    {
      CsvText table({"parameter", "value", "misfit_increase", "threshold"});
      for (const ParameterProfile &p : result.profiles)
        for (std::size_t i = 0; i < p.value.size(); ++i)
          table.cell(p.name).cell(p.value[i]).cell(p.misfit_increase[i]).cell(p.threshold).end_row();
      return table;
    }

    CsvText starts(const CalibrationResult &result)
    {
      std::vector<std::string> columns = {"misfit", "misfit_at_start", "status", "evaluations", "kkt_residual"}, names;
      for (const CalibratedParameter &p : result.parameters)
        if (p.role == ParameterRole::free && p.name != "noise_scale")
          names.push_back(p.name);
      for (const char *where : {"start", "end"})
        for (const std::string &name : names)
          columns.push_back(fmt::format("{}_{}", where, name));
      CsvText table(columns);
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

    CsvText posterior(const CalibrationResult &result)
    {
      CsvText table({"young_modulus_Pa", "viscosity_Pa_s", "magnetization_A_m", "field_scale", "geometry_scale",
                     "displacement_offset_m", "displacement_scale"});
      for (const CalibratedSwimmer &s : result.posterior)
      {
        table.cell(s.young_modulus_Pa).cell(s.viscosity_Pa_s).cell(s.magnetization_A_m).cell(s.field_scale);
        table.cell(s.geometry_scale).cell(s.displacement_offset_m).cell(s.displacement_scale).end_row();
      }
      return table;
    }

    CsvText next_experiment(const CalibrationResult &result)
    {
      CsvText table({"data_set", "frequency_Hz", "interval_ratio", "information_gain"});
      if (const auto &next = result.next)
        for (std::size_t i = 0; i < next->frequency_Hz.size(); ++i)
          table.cell(next->data_set)
              .cell(next->frequency_Hz[i])
              .cell(next->interval_ratio[i])
              .cell(next->information_gain[i])
              .end_row();
      return table;
    }

    using Table = std::pair<const char *, CsvText (*)(const CalibrationResult &)>;
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

    std::string origin(const CalibrationResult &result)
    {
      return fmt::format("# {}, {}\n# {}\n# model {}; scene {}\n", result.provenance.program_version,
                         result.provenance.created, result.provenance.command_line, result.model_file,
                         result.provenance.scene_hash);
    }
  } // namespace

  std::vector<std::string> calibration_file_names()
  {
    std::vector<std::string> names = {calibration_result_name, fitted_scene_name, fitted_field_name};
    for (const auto &[name, make] : tables())
      names.emplace_back(name);
    return names;
  }

  void write_calibration_files(const std::filesystem::path &folder, const CalibrationResult &result,
                               const Scene &fitted)
  {
    for (const auto &[name, make] : tables())
    {
      const CsvText table = make(result);
      if (table.n_rows() > 0)
        write_text_atomically(folder / name, origin(result) + table.text());
      else
        std::filesystem::remove(folder / name); // of an earlier calibration
    }
    write_text_atomically(folder / fitted_scene_name,
                          origin(result) + "# status of the fit: " + result.status + "\n\n" + fitted.text);
    write_calibration_result(folder / calibration_result_name, result);
  }
} // namespace swimtwin
