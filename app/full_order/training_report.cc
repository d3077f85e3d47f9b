// The training of a reduced swimmer, with its report.
#include <app/full_order/training_report.h>

#include <app/frame/claimed_folder.h>
#include <app/frame/ranks.h>
#include <app/frame/shipped_files.h>
#include <app/frame/stage_bar.h>
#include <app/frame/written_files.h>
#include <datasets/files/output_folder.h>
#include <datasets/reduced/held_out_error.h>
#include <datasets/run/run_summary_json.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <reports/sweep/model_card.h>
#include <rom/training/aimed_training.h>
#include <rom/training/training_runs.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    /// Whether a training that is resumed has nothing left to do: rank 0 looks, the others learn it. A model that
    /// misses the target, or has less than what is asked for now, is gone on with.
    bool nothing_to_resume(const TrainingOptions &own)
    {
      bool complete = is_speaker() && std::filesystem::exists(own.folder / "model.h5");
      if (complete)
      {
        const ReducedModel model = read_reduced_model(own.folder / "model.h5");
        complete                 = model.record.target == own.target && missed_target(model.record).empty() &&
                   model.n_modes() >= own.n_coordinates &&
                   static_cast<int>(model.record.held_out_runs.size()) >= own.n_held_out;
      }
      MPI_Bcast(&complete, sizeof complete, MPI_BYTE, 0, MPI_COMM_WORLD);
      return complete;
    }

    /// Throws InputError if the folder holds the training of another swimmer, or of other ranges.
    void require_own_training(const Scene &scene, const TrainingOptions &own)
    {
      const auto refuse = [&](const std::filesystem::path &file) {
        throw InputError(
            fmt::format("--resume: {} is of another scene, or of other ranges or --steps; repeat the options "
                        "that this training began with, or give another --output.",
                        file.string()));
      };
      if (const auto file = own.folder / "model.h5"; std::filesystem::exists(file))
        if (const ReducedModel model = read_reduced_model(file);
            parse_scene(model.scene_text, model.scene_name).hash != scene.hash || model.range != own.range)
          refuse(file);
      const Scene first =
          with_parameters(scene, training_design(own.range).front(), training_run_overrides(own.steps_per_period));
      if (const auto file = own.folder / "runs/run-01/summary.json"; std::filesystem::exists(file))
        if (read_run_summary_json(file).provenance.scene_hash != first.hash)
          refuse(file);
    }

    /// The model is kept and says what it is worth; scripts learn from the exit code whether that is enough.
    void conclude(const TrainingRecord &record, const std::filesystem::path &file)
    {
      if (const std::string missed = missed_target(record); !missed.empty())
        throw ComputationError(
            fmt::format("{}: {}; use it for less, or train it on a narrower range, with a larger --budget (--resume "
                        "goes on), or with a wider --target",
                        file.string(), missed));
    }

    void train_in_folder(TrainCommand &command, const Scene &scene, const Begun &begun)
    {
      TrainingOptions &own   = command.training;
      const bool       quiet = command.common.quiet || !is_speaker();
      if (command.resume && nothing_to_resume(own))
      {
        if (!quiet)
          say("{} is complete: nothing to resume\n", own.folder.string());
        conclude(read_reduced_model(own.folder / "model.h5").record, own.folder / "model.h5");
        return;
      }
      StageBar bar(quiet);
      own.on_progress = [&](const std::string &stage, const int done, const int total) {
        begun();
        bar.show(stage, done, total);
      };
      const ReducedModel model = train(scene, own, MPI_COMM_WORLD);
      if (is_speaker())
        write_text_atomically(own.folder / "model-card.txt", model_card(model));
      if (!quiet)
        say("{}  results in {}\n", model_card(model), own.folder.string());
      conclude(model.record, own.folder / "model.h5");
    }
  } // namespace

  void train_and_report(const Scene &scene, TrainCommand &command)
  {
    std::vector<std::filesystem::path> inputs = command.training.snapshots;
    inputs.push_back(find_scene(command.common.scene)); // the sinusoid that can be trained on has no file
    OutputRequest request = output_request(command.common, written_by::train(), inputs);
    request.resume        = command.resume;
    if (command.resume)
      agree([&] { require_own_training(scene, command.training); });
    work_in_folder_together(request, [&](const Begun &begun) { train_in_folder(command, scene, begun); });
  }
} // namespace swimtwin
