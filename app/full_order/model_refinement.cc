#include <app/full_order/model_refinement.h>

#include <app/ranks.h>
#include <app/stage_bar.h>
#include <datasets/files/output_folder.h>
#include <datasets/system/console.h>
#include <reports/sweep/model_card.h>
#include <rom/training/aimed_training.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    /// The training's own runs, if the model lies where it was trained: they are looked at before they are used.
    void bring_runs(const fs::path &from, const fs::path &to)
    {
      fs::create_directories(to);
      if (fs::is_directory(from / "runs"))
        fs::copy(from / "runs", to / "runs", fs::copy_options::recursive | fs::copy_options::skip_existing);
    }

    Scene scene_of(const ReducedModel &model)
    {
      std::vector<std::string> overrides;
      if (!model.inertia.is_given())
        overrides.emplace_back("fluid.inertia=none");
      return parse_scene(model.scene_text, model.scene_name + ".toml", overrides);
    }
  } // namespace

  RefinedModel refine_model(const RefinedModel &before, const std::vector<fs::path> &snapshots,
                            const CommonOptions &common, const int round)
  {
    const fs::path folder = common.output / fmt::format("refined-{}", round);
    RefinedModel   refined{{}, folder / "model.h5", before.shapes};
    for (std::size_t i = 0; i < snapshots.size(); ++i)
      refined.shapes.push_back(folder / "shapes" / fmt::format("{}.h5", i + 1));
    agree([&] {
      bring_runs(before.file.parent_path(), folder);
      fs::create_directories(folder / "shapes");
      for (std::size_t i = 0; i < snapshots.size(); ++i)
        fs::copy_file(snapshots[i], refined.shapes[before.shapes.size() + i], fs::copy_options::overwrite_existing);
    });
    TrainingOptions options = options_to_refine(before.model);
    options.folder          = folder;
    options.command_line    = common.command_line;
    options.snapshots       = refined.shapes;
    StageBar bar(common.quiet || !is_speaker());
    options.on_progress = [&](const std::string &stage, const int done, const int total) {
      bar.show(stage, done, total);
    };
    refined.model = train(scene_of(before.model), options, MPI_COMM_WORLD);
    agree([&] { write_text_atomically(folder / "model-card.txt", model_card(refined.model)); });
    return refined;
  }
} // namespace swimtwin
