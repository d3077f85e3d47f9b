// Meshes of bodies of revolution and of the fluid around them: what differs in size, slenderness and profile.
#include <datasets/scene/tail_outline.h>
#include <datasets/system/error.h>
#include <fom/body/mesh_around.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    struct MeshesInSpace
    {
      unsigned int n_fluid_cells = 0, n_tail_cells = 0;
      double       fluid_quality = 0., tail_quality = 0.;
    };

    MeshesInSpace meshes_of(const Scene &scene)
    {
      const Swimmer<3>   swimmer(scene, MPI_COMM_WORLD);
      const FluidMesh<3> fluid = mesh_around(swimmer, swimmer.configuration_at_rest(), MPI_COMM_WORLD);
      const auto        &tail  = swimmer.tail().mesh;
      return {fluid.mesh.n_cells(), tail.n_cells(), worst_quality(fluid.mesh, fluid.mesh.nodes),
              worst_quality(tail, tail.nodes)};
    }

    Scene swimmer_times(const double scale)
    {
      const auto length = [&](const char *key, const double metres) { return override_entry(key, scale * metres); };
      const auto size   = [&](const std::string &key, const std::vector<double> &metres) {
        std::string text = key + "=[";
        for (const double x : metres)
          text += std::to_string(1e9 * x) + "e-9, ";
        return text + "]";
      };
      return shipped_scene("reference-3d-paper",
                           {"variant=quick", size("domain.size_m", {.04 * scale, .02 * scale, .02 * scale}),
                            size("head.size_m", {5e-4 * scale, 1.5e-3 * scale}), length("tail.length_m", 7.5e-3),
                            length("tail.root_height_m", 1.5e-3), length("tail.tip_height_m", 2e-4),
                            length("numerics.mesh_size_m", 6e-4), length("numerics.mesh_size_corner_m", 2e-4),
                            length("numerics.mesh_size_far_m", 4e-3)});
    }

    /// Nothing if they are refused, which has to name a mesh size that was tried.
    std::optional<MeshesInSpace> meshes_or_refusal(const Scene &scene)
    {
      try
      {
        return meshes_of(scene);
      }
      catch (const std::exception &error)
      {
        EXPECT_NE(std::string(error.what()).find("set mesh_size_m = "), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("(tried)"), std::string::npos) << error.what();
        return {};
      }
    }

    void expect_sound(const MeshesInSpace &meshes)
    {
      EXPECT_GT(meshes.fluid_quality, 0.);
      EXPECT_GT(meshes.tail_quality, 0.);
    }
  } // namespace

  // gmsh does not find the same tetrahedra at every scale; where one of them folds the size that works is named.
  TEST(RevolvedBody, IsMeshedAlikeAtAnyScaleOrRefusedWithASizeThatWorks)
  {
    const MeshesInSpace unit = meshes_of(swimmer_times(1.));
    expect_sound(unit);
    for (const double scale : {1e-3, 0.37, 1e5})
      if (const auto scaled = meshes_or_refusal(swimmer_times(scale)))
      {
        expect_sound(*scaled);
        EXPECT_NEAR(scaled->n_fluid_cells, unit.n_fluid_cells, .05 * unit.n_fluid_cells) << scale;
        EXPECT_NEAR(scaled->n_tail_cells, unit.n_tail_cells, .05 * unit.n_tail_cells) << scale;
      }
  }

  // A tail nearly as thick as the spherical head it leaves, at an angle of 10 degrees: in the wedge between them cells
  // can but be thin.
  TEST(RevolvedBody, IsMeshedAnewWhereItsTipFoldsAnElement)
  {
    // A blunt tip of some four elements: at about one in eight of these sizes the first mesh has an element inside out.
    for (const char *corner_m : {"1e-4", "1.2e-4", "1.5e-4", "1.7e-4", "1.87e-4"})
    {
      const Scene scene = shipped_scene(
          "reference-3d-paper", {"head.size_m=[1.5e-3, 1.2e-3]", "tail.length_m=6e-3", "tail.root_height_m=0.8e-3",
                                 "tail.tip_height_m=0.5e-3", "numerics.mesh_size_m=3.75e-4", "numerics.mesh_growth=0.3",
                                 "numerics.mesh_size_corner_m=" + std::string(corner_m)});
      EXPECT_NO_THROW(Swimmer<3>(scene, MPI_COMM_WORLD)) << corner_m;
    }
  }

  TEST(RevolvedBody, IsMeshedInAThinWedgeOrRefusedWithASizeThatWorks)
  {
    const Scene scene = shipped_scene(
        "reference-3d-paper", {"variant=quick", "head={shape=\"sphere\", diameter_m=1.5e-3, density_kg_m3=7000.0}",
                               "tail.root_height_m=1.45e-3"});
    if (const auto meshes = meshes_or_refusal(scene))
      expect_sound(*meshes);
  }

  // A hundredth and a three-hundredth of the mesh size: gmsh ended the process over a plane within the tail that was
  // too coarse for its tip.
  TEST(RevolvedBody, IsMeshedToATipThatIsMuchThinnerThanItsMesh)
  {
    expect_sound(meshes_of(shipped_scene(
        "vessel-3d", {"variant=quick", "tail.profile_m=[[0.0, 0.35e-3], [1.0e-3, 0.3e-3], [2.5e-3, 0.4e-3], "
                                       "[5.0e-3, 0.25e-3], [7.0e-3, 3e-6]]"})));
    expect_sound(meshes_of(
        shipped_scene("reference-3d-casefile", {"variant=quick", "tail.tip=flat", "tail.tip_height_m=2e-6"})));
  }

  TEST(RevolvedBody, HasThePointsOfItsProfile)
  {
    const Scene      scene = shipped_scene("vessel-3d", {"variant=quick"});
    const Swimmer<3> swimmer(scene, MPI_COMM_WORLD);
    const auto       outline = tail_outline(scene.head, *scene.tail);
    for (const auto &[x, half_height] : scene.tail->profile_m)
      EXPECT_NEAR(outline.half_height_m(x + scene.head.size_m[0] / 2), half_height, x == 0. ? 2e-5 : 1e-18);
    int n_on_side = 0;
    for (unsigned int k = 0; k < swimmer.body().surface.nodes.size(); ++k)
      if (const auto &X = swimmer.body().surface.nodes[k];
          swimmer.body().tail_node[k] >= 0 && X[0] > outline.x_root_m && X[0] < outline.x_end_m)
      {
        EXPECT_NEAR(std::hypot(X[1], X[2]), outline.half_height_m(X[0]), 1e-12);
        ++n_on_side;
      }
    EXPECT_GT(n_on_side, 100);
  }

  // Five micrometres beside a head, gmsh finds that the wall's flat triangles cut it; 20, that elements are inside
  // out, and smaller ones were tried until they were endlessly many. What gmsh throws leaves it locked: the second body
  // would not be meshed if it were not started anew.
  TEST(FluidInSpace, IsRefusedWithTheGapThatIsTooNarrowForIt)
  {
    for (const auto &[radius_m, gap] : {std::pair("0.605e-3", "5e-06 m"), std::pair("0.62e-3", "2e-05 m")})
    {
      const Scene scene = shipped_scene("vessel-3d", {"variant=quick", std::string("domain.radius_m=") + radius_m});
      expect_in(message_of<InputError>([&] { meshes_of(scene); }),
                "does (tried): widen the gap of " + std::string(gap) + " to the outer wall");
    }
  }

  // Elements of the tail alone fold, whose finer meshes cost little however large its fluid.
  TEST(RevolvedBody, ThatARoundedTipFoldsIsRefusedWithTheSizesTriedAndWhatElseToDo)
  {
    int n_refused = 0;
    for (const char *tip_m : {"2e-6", "4e-6", "16e-6"})
      try
      {
        expect_sound(meshes_of(shipped_scene("reference-3d-paper", {"variant=quick", "numerics.mesh_size_far_m=0.9e-3",
                                                                    std::string("tail.tip_height_m=") + tip_m})));
      }
      catch (const InputError &error)
      {
        const std::string text = error.what();
        ++n_refused;
        EXPECT_TRUE(text.find("set mesh_size_m = ") != std::string::npos ||
                    text.find("does (tried): blunt the tail's tip") != std::string::npos)
            << text;
      }
    EXPECT_GT(n_refused, 0);
  }

  TEST(FluidInSpace, FillsAGapOfASixtiethOfTheMeshSize)
  {
    const auto meshes =
        meshes_of(shipped_scene("reference-3d-casefile", {"variant=quick", "domain.size_m=[40e-3, 10.76e-3, 20e-3]",
                                                          "domain.center_m=[0.0, 4.62e-3]"}));
    expect_sound(meshes);
  }

  TEST(FilmBody, FillsABoxBehindACylinder)
  {
    const Scene      scene = shipped_scene("film-3d", {"variant=quick", "tail.tip_height_m=0.1e-3"});
    const Swimmer<3> swimmer(scene, MPI_COMM_WORLD);
    const Tail      &tail     = *scene.tail;
    const double     cylinder = scene.head.volume(3), film = tail.width_m * tail.length_m * tail.mean_height_m();
    // The cylinder's sides are quadratic faces.
    EXPECT_NEAR(swimmer.volume(swimmer.configuration_at_rest()), cylinder + film, 1e-3 * cylinder);
    expect_sound(meshes_of(scene));
  }

  TEST(TailOutline, IsMonotoneBetweenItsPoints)
  {
    const std::vector<std::array<double, 2>> points{{0., 1.}, {1., 1.}, {1.5, 3.}, {4., 3.1}, {5., .2}};
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      for (int k = 0; k <= 50; ++k)
      {
        const auto &[a, low]  = points[i];
        const auto &[b, high] = points[i + 1];
        const double y        = monotone_interpolation(points, a + (b - a) * k / 50.);
        EXPECT_GE(y, std::min(low, high) - 1e-14);
        EXPECT_LE(y, std::max(low, high) + 1e-14);
      }
    // A parabola that rises is met to third order.
    const auto error = [](const int n) {
      std::vector<std::array<double, 2>> parabola;
      for (int i = 0; i <= n; ++i)
        parabola.push_back({1. + double(i) / n, std::pow(1. + double(i) / n, 2)});
      double largest = 0.;
      for (int k = 0; k <= 1000; ++k)
        largest =
            std::max(largest, std::abs(monotone_interpolation(parabola, 1. + k / 1000.) - std::pow(1. + k / 1000., 2)));
      return largest;
    };
    EXPECT_LT(error(20), error(10) / 6.);
    EXPECT_LT(error(10), 2e-4);
  }
} // namespace swimtwin
