#include <app/full_order/model_refinement.h>

#include <app/frame/ranks.h>
#include <app/frame/stage_bar.h>
#include <datasets/files/output_folder.h>
#include <datasets/system/console.h>
#include <reports/sweep/model_card.h>
#include <rom/swimmer/carried_inertia.h>
#include <rom/training/added_runs.h>
#include <rom/training/aimed_training.h>
#include <rom/training/training_runs.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    /// The training's own runs and samples, if the model lies where it was trained: they are looked at before they are
    /// used.
    void bring_work(const fs::path &from, const fs::path &to)
    {
      fs::create_directories(to);
      if (fs::is_regular_file(from / "samples.h5"))
        fs::copy_file(from / "samples.h5", to / "samples.h5", fs::copy_options::skip_existing);
      for (const char *runs : {"runs", "held-out-with-inertia"})
        if (fs::is_directory(from / runs))
          fs::copy(from / runs, to / runs, fs::copy_options::recursive | fs::copy_options::skip_existing);
      for (const auto &added : added_run_folders(from / "runs")) // their shapes are among those given
        fs::remove_all(to / "runs" / added.filename());
    }

    fs::path shape_file(const fs::path &folder, const std::size_t i)
    {
      return folder / "shapes" / fmt::format("{}.h5", i + 1);
    }

    /// Those that a model was refined with before, those of runs that were added to its training, and more.
    std::vector<fs::path> all_shapes(const fs::path &folder_before, const std::vector<int> &added_runs,
                                     const std::vector<fs::path> &snapshots)
    {
      std::vector<fs::path> all;
      while (fs::exists(shape_file(folder_before, all.size())))
        all.push_back(shape_file(folder_before, all.size()));
      for (const int number : added_runs)
        if (const auto file = folder_before / "runs" / run_folder_name(number) / "snapshots.h5"; fs::exists(file))
          all.push_back(file);
      all.insert(all.end(), snapshots.begin(), snapshots.end());
      return all;
    }

    /// With the inertia that the model before has, also where it was added to a scene without; else the very scene that
    /// its samples are of.
    Scene scene_of(const ReducedModel &model, const InertiaTerms &carried)
    {
      Scene scene = scene_with_inertia(model, "");
      if (!model.inertia.is_given())
        return scene.fluid->inertia == Inertia::none ? scene : scene_with_inertia(model, "none");
      return scene.fluid->inertia == Inertia::none && carried.any() ? scene_with_inertia(model, "full") : scene;
    }
  } // namespace

  RefinedModel refine_model(const RefinedModel &before, const std::vector<fs::path> &snapshots,
                            const InertiaTerms &carried, const CommonOptions &common, const int round)
  {
    const fs::path  folder        = common.output / fmt::format("refined-{}", round);
    const fs::path  before_folder = before.file.parent_path();
    TrainingOptions options       = options_to_refine(before.model);
    const auto      shapes        = all_shapes(before_folder, before.model.record.added_runs, snapshots);
    for (std::size_t i = 0; i < shapes.size(); ++i)
      options.snapshots.push_back(shape_file(folder, i));
    agree([&] {
      bring_work(before_folder, folder);
      fs::create_directories(folder / "shapes");
      for (std::size_t i = 0; i < shapes.size(); ++i)
        fs::copy_file(shapes[i], options.snapshots[i], fs::copy_options::overwrite_existing);
    });
    options.folder       = folder;
    options.command_line = common.command_line;
    StageBar bar(common.quiet || !is_speaker());
    options.on_progress = [&](const std::string &stage, const int done, const int total) {
      bar.show(stage, done, total);
    };
    RefinedModel refined{train(scene_of(before.model, carried), options, MPI_COMM_WORLD), folder / "model.h5"};
    agree([&] { write_text_atomically(folder / "model-card.txt", model_card(refined.model)); });
    return refined;
  }
} // namespace swimtwin
