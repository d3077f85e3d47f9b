// The files of a sweep.
#pragma once

#include <datasets/system/provenance.h>
#include <reports/sweep/frequency_curves.h>
#include <rom/sweep/sweep.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// What a sweep was, besides its members.
  struct SweepRecord
  {
    std::string              status = "not run";
    std::string              model_file;
    int                      n_modes = 0, n_threads = 0;
    std::size_t              n_members = 0, n_outside_trained_range = 0, n_not_computed = 0;
    double                   wall_time_s = 0., cpu_time_s = 0.;
    std::vector<std::string> warnings;
    Provenance               provenance;
  };

  inline constexpr const char *sweep_table_name = "displacement_frequency.csv", *sweep_data_name = "sweep.h5",
                              *sweep_summary_name = "sweep.json";

  /// One row per member. A number that was not found has an empty cell; the columns status ("completed", "failed") and
  /// note say why.
  void write_sweep_table(const std::filesystem::path &file, const std::vector<SweepResult> &results);
  /// Everything of every member; NaN where a displacement was not found.
  void write_sweep_data(const std::filesystem::path &file, const std::vector<SweepResult> &results,
                        const SweepRecord &record);
  void write_sweep_summary(const std::filesystem::path &file, const ReducedModel &model,
                           const std::vector<SweepResult> &results, const SweepRecord &record);

  /// Whether the displacement of the last period is there.
  bool was_computed(const SweepResult &result);
  /// Third-period displacements, of the members that were computed.
  std::vector<FrequencyCurve> curves_of(const std::vector<SweepResult> &results);
} // namespace swimtwin
