#include <datasets/files/hdf5_file.h>
#include <datasets/reduced/training_record_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace swimtwin
{
  namespace
  {
    /// One visitor for both directions.
    template <typename Record, typename Visitor>
    void for_each_figure(Record &record, const Visitor &visit)
    {
      visit("energy_captured", record.energy_captured);
      visit("n_snapshots", record.n_snapshots);
      visit("n_resistance_samples", record.n_resistance_samples);
      visit("n_held_out_samples", record.n_held_out_samples);
      visit("velocity_error_rms", record.velocity_error_rms);
      visit("velocity_error_max", record.velocity_error_max);
      visit("largest_condition", record.largest_condition);
      visit("cpu_time_s", record.cpu_time_s);
    }

    constexpr int n_run_columns = 10;

    Eigen::MatrixXd matrix_of(const std::vector<HeldOutRun> &runs)
    {
      Eigen::MatrixXd rows(static_cast<Eigen::Index>(runs.size()), n_run_columns);
      for (Eigen::Index i = 0; i < rows.rows(); ++i)
      {
        const HeldOutRun &run = runs[static_cast<std::size_t>(i)];
        rows.row(i) << run.young_modulus_Pa, run.viscosity_Pa_s, run.magnetization_A_m, run.frequency_Hz, run.bx_T,
            run.by_T, run.displacement_m, run.displacement_error_m, run.reduced_displacement_m, run.indicator_m;
      }
      return rows;
    }

    std::vector<HeldOutRun> runs_of(const Eigen::MatrixXd &rows)
    {
      std::vector<HeldOutRun> runs;
      for (const auto row : rows.rowwise())
        runs.push_back({row[0], row[1], row[2], row[3], row[4], row[5], row[6], row[7], row[8], row[9], 0.});
      return runs;
    }

    Eigen::VectorXd fit_changes_of(const std::vector<HeldOutRun> &runs)
    {
      Eigen::VectorXd changes(static_cast<Eigen::Index>(runs.size()));
      for (Eigen::Index i = 0; i < changes.size(); ++i)
        changes[i] = runs[static_cast<std::size_t>(i)].fit_change_m;
      return changes;
    }

    /// Files of before have none.
    void read_fit_changes(const Hdf5Reader &reader, std::vector<HeldOutRun> &runs)
    {
      constexpr const char *path = "/training/held_out_fit_changes_m";
      if (!reader.contains(path))
        return;
      const std::vector<double> changes = reader.read_vector(path);
      if (changes.size() != runs.size())
        reader.refuse(path, fmt::format("has {} values; there are {} held-out runs.", changes.size(), runs.size()));
      for (std::size_t i = 0; i < runs.size(); ++i)
        runs[i].fit_change_m = changes[i];
    }

    std::vector<std::string> lines_of(const std::string &text)
    {
      std::istringstream       stream(text);
      std::vector<std::string> lines;
      for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
      return lines;
    }
  } // namespace

  void write_training_record(Hdf5Writer &writer, const TrainingRecord &record)
  {
    writer.write_vector("/training/singular_values_m", record.singular_values_m, {"m", "of the snapshots"});
    writer.write_matrix("/training/held_out_runs", matrix_of(record.held_out_runs),
                        {"Pa, Pa s, A/m, Hz, T, T, m, m, m, m",
                         "young_modulus, viscosity, magnetization, frequency, bx, by, full-order displacement of the "
                         "third period and its error, the reduced model's displacement and its error indicator"});
    if (!record.held_out_runs.empty())
      writer.write_vector("/training/held_out_fit_changes_m", fit_changes_of(record.held_out_runs),
                          {"m", "what fits of the resistance to half of the samples change in the displacements"});
    if (!record.added_runs.empty())
      writer.write_vector("/training/added_runs",
                          std::vector<double>(record.added_runs.begin(), record.added_runs.end()),
                          {"1", "numbers of the full-order runs that were added near the worst of the held-out ones"});
    if (!record.history.empty())
      writer.write_text("/training/history", fmt::format("{}", fmt::join(record.history, "\n")),
                        {"1", "how training came to its model and what it spent, one sentence per line"});
    writer.write_text("/training/neglects", fmt::format("{}", fmt::join(record.neglects, "\n")),
                      {"1", "physics that the model leaves out, one sentence per line"});
    for_each_figure(record, [&](const char *name, const auto value) {
      writer.write_attribute("/training", name, static_cast<double>(value));
    });
    writer.write_attribute("/training", "target", record.target);
  }

  TrainingRecord read_training_record(const Hdf5Reader &reader)
  {
    TrainingRecord            record;
    const std::vector<double> sigma = reader.read_vector("/training/singular_values_m");
    record.singular_values_m        = Eigen::VectorXd::Map(sigma.data(), static_cast<Eigen::Index>(sigma.size()));
    record.neglects                 = lines_of(reader.read_text("/training/neglects"));
    const Eigen::MatrixXd runs      = reader.read_matrix("/training/held_out_runs");
    if (runs.cols() != n_run_columns)
      reader.refuse("/training/held_out_runs",
                    fmt::format("has {} columns; {} are needed.", runs.cols(), n_run_columns));
    if (!runs.allFinite() || !record.singular_values_m.allFinite())
      reader.refuse("/training", "holds a value that is not finite; train the model again.");
    record.held_out_runs = runs_of(runs);
    read_fit_changes(reader, record.held_out_runs);
    if (reader.contains("/training/added_runs"))
      for (const double number : reader.read_vector("/training/added_runs"))
        record.added_runs.push_back(static_cast<int>(std::clamp(number, 0., 1e9)));
    if (reader.contains("/training/history"))
      record.history = lines_of(reader.read_text("/training/history"));
    for_each_figure(record, [&](const char *name, auto &value) {
      value = static_cast<std::decay_t<decltype(value)>>(reader.read_number_attribute("/training", name));
    });
    if (reader.has_attribute("/training", "target")) // files of before have none
      record.target = reader.read_number_attribute("/training", "target");
    return record;
  }
} // namespace swimtwin
