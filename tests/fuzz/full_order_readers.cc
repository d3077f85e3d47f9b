#include <tests/fuzz/fuzzed_readers.h>

#include <datasets/files/hdf5_open.h>
#include <fom/run/checkpoint.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/places.h>

namespace swimtwin
{
  namespace
  {
    namespace fs = std::filesystem;

    const Scene &scene_of_checkpoints()
    {
      static const Scene scene = read_scene(std::string(places::scenes) + "/reference-2d-casefile.toml");
      return scene;
    }

    /// Two triangles of fluid and their past, a tail of three nodes; what matters is that every entry is there.
    std::string small_checkpoint()
    {
      Checkpoint<2> checkpoint;
      auto         &model           = checkpoint.model;
      model.now.configuration.shape = NodalField<2>(3);
      model.now.rates.shape_rate    = NodalField<2>(3);
      model.before                  = model.now;
      model.grid_step               = 4;
      model.coupling.unknowns       = {1., 2., 3.};
      model.fluid_mesh.emplace();
      model.fluid_mesh->soup.vertices   = {{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}};
      model.fluid_mesh->soup.cells      = {{0, 1, 2}, {0, 2, 3}};
      model.fluid_mesh->nodes           = model.fluid_mesh->soup.vertices;
      model.fluid_mesh->surface_nodes   = {0, 1};
      model.fluid_mesh->wall_nodes      = {2, 3};
      model.fluid_mesh->wall_names      = {"top", "left"};
      model.fluid_mesh->image_of_vertex = {1, 0, 3, 2};
      model.balance.emplace();
      model.fluid_past.now.positions = model.fluid_mesh->nodes;
      model.fluid_past.now.velocity  = NodalField<2>(4);
      model.fluid_past.before        = model.fluid_past.now;
      checkpoint.rows                = {numbers_of(TrajectoryRow()), numbers_of(TrajectoryRow())};
      checkpoint.shapes              = {std::vector<double>(19, 0.)};
      checkpoint.first_works         = {{1., 2., 3.}};
      const TemporaryFolder folder;
      const fs::path        file = folder.path / "checkpoint.h5";
      write_checkpoint(file, checkpoint,
                       {"swimtwin", "", scene_of_checkpoints().text, scene_of_checkpoints().hash, "", 0.});
      return content(file);
    }

    void read(const fs::path &file)
    {
      read_checkpoint<2>(file, scene_of_checkpoints());
    }

    /// As if another version had written it: the checksum is right.
    void seal(const fs::path &file)
    {
      const std::string text = content(file);
      std::ofstream(file, std::ios::binary | std::ios::app) << seal_of(text);
    }
  } // namespace

  std::vector<FuzzedReader> all_readers()
  {
    std::vector<FuzzedReader> readers = online_readers();
    readers.push_back({"damaged checkpoint", "checkpoint.h5", {small_checkpoint()}, {}, true, read});
    readers.push_back({"checkpoint of another version", "checkpoint.h5", {small_checkpoint()}, {}, true, read, seal});
    return readers;
  }
} // namespace swimtwin
