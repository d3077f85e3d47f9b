// What is said of a mesh that is too coarse at rest: which sizes were tried, and what else to do.
#include <fom/body/finer_mesh.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    const ComputationError fold("it is folded");

    Scene with_size(const std::string &scene)
    {
      return shipped_scene(scene, {"numerics.mesh_size_m=8e-4"});
    }

    FinerMesh meshed_from(const double size_m, int &n_tried, const std::string &remedy = "")
    {
      return {[size_m, &n_tried](const Scene &finer) {
                ++n_tried;
                if (finer.numerics.mesh_size_m > size_m)
                  throw ComputationError("folded as well");
                return true;
              },
              [](const Scene &) { return 1.; }, remedy};
    }
  } // namespace

  TEST(FinerMesh, NamesTheFirstSizeThatWorks)
  {
    int        n_tried = 0;
    const auto text    = message_of<InputError>(
        [&] { refuse_mesh_size(with_size("reference-2d-paper"), fold, meshed_from(2.1e-4, n_tried)); });
    expect_in(text, "mesh_size_m = 0.0008 m is too coarse: it is folded; set mesh_size_m = 0.0002");
    expect_in(text, "(tried)");
    EXPECT_EQ(n_tried, 2);
  }

  TEST(FinerMesh, SaysTheRemedyWhereNoneWorks)
  {
    int        n_tried = 0;
    const auto text    = message_of<InputError>(
        [&] { refuse_mesh_size(with_size("reference-2d-paper"), fold, meshed_from(0., n_tried, "widen the gap")); });
    expect_in(text, "no size down to 1.3e-05 m does (tried): widen the gap");
    EXPECT_EQ(n_tried, 6);
  }

  TEST(FinerMesh, ThrowsTheErrorAgainWhereNothingHelps)
  {
    int n_tried = 0;
    EXPECT_EQ(message_of<ComputationError>(
                  [&] { refuse_mesh_size(with_size("reference-2d-paper"), fold, meshed_from(0., n_tried)); }),
              "it is folded");
  }

  TEST(FinerMesh, TriesNoneInSpaceThatWouldTakeMinutes)
  {
    int       n_tried   = 0;
    FinerMesh mesh      = meshed_from(0., n_tried, "widen the gap");
    mesh.expected_cells = [](const Scene &finer) { return 1e5 * (finer.numerics.mesh_size_m < 3e-4); };
    expect_in(message_of<InputError>([&] { refuse_mesh_size(with_size("reference-3d-paper"), fold, mesh); }),
              "no size down to 0.0004 m does (tried)");
    EXPECT_EQ(n_tried, 1);
    mesh.expected_cells = [](const Scene &) { return 1e5; };
    expect_in(message_of<InputError>([&] { refuse_mesh_size(with_size("reference-3d-paper"), fold, mesh); }),
              "smaller ones were not tried, whose meshes would take minutes: widen the gap");
    EXPECT_EQ(n_tried, 1);
  }

  TEST(FinerMesh, TriesNoneBeyondMemory)
  {
    int       n_tried = 0;
    FinerMesh mesh    = meshed_from(0., n_tried, "widen the gap");
    mesh.is_meshed    = [&](const Scene &) -> bool {
      ++n_tried;
      throw OutOfMemory("memory ran out");
    };
    expect_in(message_of<InputError>([&] { refuse_mesh_size(with_size("reference-2d-paper"), fold, mesh); }),
              "for half of it memory does not suffice: widen the gap");
    EXPECT_EQ(n_tried, 1);
  }
} // namespace swimtwin
