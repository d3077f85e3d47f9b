#include <rom/training/training_runs.h>

#include <datasets/run/run_summary_json.h>
#include <datasets/system/error.h>
#include <fom/run/simulation.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  Scene with_parameters(const Scene &scene, const RunParameters &p, const std::vector<std::string> &overrides)
  {
    std::vector<std::string> all{fmt::format("tail.young_modulus_Pa={:.17g}", p.young_modulus_Pa),
                                 fmt::format("fluid.viscosity_Pa_s={:.17g}", p.viscosity_Pa_s),
                                 fmt::format("head.magnetization_A_m={:.17g}", p.magnetization_A_m),
                                 fmt::format("field.frequency_Hz={:.17g}", p.frequency_Hz),
                                 fmt::format("field.bx_T={:.17g}", p.bx_T),
                                 fmt::format("field.by_T={:.17g}", p.by_T),
                                 "fluid.inertia=none"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    return parse_scene(scene.text, scene.name, all);
  }

  namespace
  {
    double middle(const Interval &range)
    {
      return range.low > 0. ? std::sqrt(range.low * range.high) : (range.low + range.high) / 2.;
    }

    /// The end of larger magnitude, or of smaller.
    double strongest(const Interval &range)
    {
      return std::abs(range.high) >= std::abs(range.low) ? range.high : range.low;
    }
    double weakest(const Interval &range)
    {
      return std::abs(range.high) >= std::abs(range.low) ? range.low : range.high;
    }

    bool is_complete(const std::filesystem::path &folder, const Scene &scene)
    {
      return std::filesystem::exists(folder / "snapshots.h5") && std::filesystem::exists(folder / "summary.json") &&
             read_run_summary_json(folder / "summary.json").provenance.scene_hash == scene.hash;
    }
  } // namespace

  std::vector<RunParameters> training_design(const TrainedRange &range)
  {
    std::vector<RunParameters> runs;
    for (const double frequency : {range.frequency_Hz.low, middle(range.frequency_Hz), range.frequency_Hz.high})
    {
      const double mu = middle(range.viscosity_Pa_s);
      runs.push_back({range.young_modulus_Pa.low, mu, range.magnetization_A_m.high, frequency, strongest(range.bx_T),
                      strongest(range.by_T)});
      runs.push_back({middle(range.young_modulus_Pa), mu, middle(range.magnetization_A_m), frequency,
                      middle(range.bx_T), middle(range.by_T)});
      runs.push_back({range.young_modulus_Pa.high, mu, range.magnetization_A_m.low, frequency, weakest(range.bx_T),
                      weakest(range.by_T)});
    }
    return runs;
  }

  std::vector<std::string> training_run_overrides(const int steps_per_period)
  {
    return {"time.periods=2", fmt::format("time.steps_per_period={}", steps_per_period),
            "output.snapshots_per_period=30", "output.fields_per_period=0"};
  }

  std::string run_folder_name(const int number)
  {
    return fmt::format("run-{:02}", number);
  }

  std::vector<std::filesystem::path> run_full_order(const Scene &scene, const std::vector<RunParameters> &runs,
                                                    const TrainingRunOptions &options, const MPI_Comm communicator)
  {
    int rank, n_ranks;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &n_ranks);
    std::vector<std::filesystem::path> folders;
    for (std::size_t k = 0; k < runs.size(); ++k)
    {
      folders.push_back(options.folder /
                        run_folder_name(options.numbers.empty() ? static_cast<int>(k) + 1 : options.numbers[k]));
      if (static_cast<int>(k) % n_ranks != rank)
        continue;
      const Scene member = with_parameters(scene, runs[k], options.overrides);
      std::filesystem::create_directories(folders.back());
      if (!is_complete(folders.back(), member))
      {
        SimulationOptions simulation;
        simulation.folder       = folders.back();
        simulation.command_line = options.command_line;
        simulation.resume       = true;
        simulation.keeps_flow   = false;
        simulate(member, simulation, MPI_COMM_SELF);
      }
      if (options.on_progress)
        options.on_progress(static_cast<int>(k) / n_ranks + 1,
                            static_cast<int>((runs.size() - rank - 1) / n_ranks + 1));
    }
    MPI_Barrier(communicator);
    return folders;
  }
} // namespace swimtwin
