#include <reports/sweep/sweep_folder.h>

#include <datasets/files/json_entries.h>
#include <datasets/reduced/training_folder.h>
#include <datasets/system/error.h>
#include <reports/sweep/sweep_files.h>

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    std::vector<fs::path> run_folders_in(const fs::path &folder)
    {
      std::error_code       error;
      std::vector<fs::path> found;
      for (const fs::directory_entry &entry : fs::directory_iterator(folder, error))
        if (is_run(entry.path()))
          found.push_back(entry.path());
      if (error)
        throw InputError(fmt::format("cannot read the folder {}: {}; give the folder of a run or of a sweep.",
                                     folder.string(), error.message()));
      std::sort(found.begin(), found.end());
      return found;
    }

    [[noreturn]] void refuse_folder_without_results(const fs::path &folder)
    {
      if (fs::exists(folder / "checkpoint.h5"))
        throw InputError(fmt::format("{} holds checkpoint.h5 of an interrupted run and no summary.json; finish it with "
                                     "`swimtwin simulate SCENE --output {} --resume`.",
                                     folder.string(), folder.string()));
      if (holds_training(folder))
        throw InputError(fmt::format(
            "{} is of a training, which has no page: {}.", folder.string(),
            has_trained_model(folder) ? "what its model is worth stands in model-card.txt"
                                      : "it has not ended; go on with `swimtwin train SCENE --output ... --resume`"));
      throw InputError(fmt::format("{} holds no results: neither summary.json of a run, nor displacement_frequency.csv "
                                   "of a sweep, nor folders of runs; give the --output of an earlier command.",
                                   folder.string()));
    }

    std::string comment_lines(const fs::path &file)
    {
      std::istringstream stream(read_text_file(file, "the table"));
      std::string        comments;
      for (std::string line; std::getline(stream, line);)
        if (line.starts_with('#'))
          comments += fmt::format("{}\n", line);
      return comments;
    }

    SweepOrigin read_origin(const fs::path &file)
    {
      const Json  json = Json::parse(read_text_file(file, "the summary of the sweep"), nullptr, false);
      SweepOrigin origin;
      try
      {
        read_entry(json, "provenance", origin.provenance);
        const Json model = json.value("model", Json());
        read_entry(model, "file", origin.model_file);
        read_entry(model, "n_modes", origin.n_modes);
        if (json.contains("warnings")) // earlier versions did not write them down
          read_entry(json, "warnings", origin.warnings);
      }
      catch (const InputError &problem)
      {
        throw InputError(fmt::format("{} {}; it is not a summary of swimtwin sweep: run it again, or remove the file.",
                                     file.string(), problem.what()));
      }
      return origin;
    }

    /// Per row; none for a member that was not computed, whose cell is empty.
    std::vector<std::optional<double>> displacements_of(const CsvTable &table)
    {
      constexpr auto name  = "displacement_m";
      const auto    &names = table.column_names();
      const auto     index = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
      std::vector<std::optional<double>> displacements;
      for (std::size_t i = 0; i < table.n_rows(); ++i)
      {
        displacements.push_back(table.number(i, name)); // refuses a table without the column
        if (const std::string &cell = table.cells(i)[index]; !displacements.back() && !cell.empty())
          throw InputError(fmt::format("{}: {} = \"{}\" is not a finite number.", table.where(i), name, cell));
      }
      return displacements;
    }

    std::vector<SweepPoint> points_of(const CsvTable &table, const fs::path &file)
    {
      if (table.n_rows() == 0)
        throw InputError(fmt::format("{} has a header and no rows; run the sweep again.", file.string()));
      const auto moduli = table.column("young_modulus_Pa"), frequencies = table.column("frequency_Hz");
      const auto displacements   = displacements_of(table);
      const auto column_or_zeros = [&](const char *name) {
        return table.has_column(name) ? table.column(name) : std::vector<double>(table.n_rows(), 0.);
      };
      const auto magnetizations = column_or_zeros("magnetization_A_m"), viscosities = column_or_zeros("viscosity_Pa_s"),
                 bx = column_or_zeros("bx_T"), by = column_or_zeros("by_T");
      std::vector<SweepPoint> points;
      for (std::size_t i = 0; i < table.n_rows(); ++i)
        if (displacements[i])
          points.push_back(
              {moduli[i], magnetizations[i], frequencies[i], *displacements[i], viscosities[i], bx[i], by[i]});
      return points;
    }

    /// Of the runs that swam at least one period of their field with a tail and a free head.
    std::vector<SweepPoint> points_of(const std::vector<SweepRun> &runs)
    {
      std::vector<SweepPoint> points;
      for (const auto &[folder, run] : runs)
      {
        const auto &[scene, summary] = std::tie(run.scene, run.record.summary);
        if (has_completed(summary) && summary.net_displacement_m && scene && scene->tail && scene->head.is_free() &&
            scene->field.period_s() > 0.)
          points.push_back({scene->tail->young_modulus_Pa, scene->head.magnetization_A_m, 1. / scene->field.period_s(),
                            *summary.net_displacement_m});
      }
      return points;
    }

    bool frequencies_differ(const std::vector<SweepPoint> &points)
    {
      return std::any_of(points.begin(), points.end(),
                         [&](const SweepPoint &point) { return point.frequency_Hz != points.front().frequency_Hz; });
    }
  } // namespace

  SweepFolder read_sweep(const fs::path &folder)
  {
    SweepFolder sweep;
    sweep.name = folder_name(folder);
    for (const fs::path &run_folder : run_folders_in(folder))
      sweep.runs.push_back({run_folder, read_run_record(run_folder)});
    if (const fs::path file = folder / sweep_table_name; fs::exists(file))
    {
      sweep.table                          = CsvTable::read(file);
      sweep.comments                       = comment_lines(file);
      const std::vector<SweepPoint> points = points_of(*sweep.table, file);
      sweep.n_not_computed                 = sweep.table->n_rows() - points.size();
      sweep.curves                         = frequency_curves(points);
      if (const fs::path summary = folder / sweep_summary_name; fs::exists(summary))
        sweep.origin = read_origin(summary);
    }
    else if (const auto points = points_of(sweep.runs); frequencies_differ(points))
      sweep.curves = frequency_curves(points);
    if (!sweep.table && sweep.runs.empty())
      refuse_folder_without_results(folder);
    return sweep;
  }
} // namespace swimtwin
