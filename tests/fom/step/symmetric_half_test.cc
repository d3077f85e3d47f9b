#include <datasets/scene/mirror_plane.h>
#include <fom/run/checkpoint.h>
#include <fom/step/full_order_model.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;
    using Overrides = std::vector<std::string>;

    struct Case
    {
      std::string name, scene;
      Overrides   overrides;
    };

    void PrintTo(const Case &example, std::ostream *out)
    {
      *out << example.name;
    }

    const Overrides tight          = {"numerics.coupling_tolerance=1e-11", "numerics.linear_tolerance=1e-13"},
                    coarse_swimmer = {"numerics.mesh_size_m=6e-4", "numerics.mesh_size_corner_m=2e-4",
                                      "numerics.mesh_size_far_m=4e-3", "numerics.mesh_growth=0.5", "field.by_T=0.0"},
                    coarse_channel = {"numerics.mesh_size_m=4e-4", "numerics.mesh_size_corner_m=1.5e-4",
                                      "numerics.mesh_size_far_m=2e-3", "numerics.mesh_growth=0.5",
                                      "head.center_m=[0.0, 0.0]"},
                    falls          = {"gravity.acceleration_m_s2=[9.81, 0.0]"};

    Overrides operator+(Overrides a, const Overrides &b)
    {
      a.insert(a.end(), b.begin(), b.end());
      return a;
    }

    const std::vector<Case> cases = {
        {"AnElasticSwimmerFalls", "reference-2d-casefile", coarse_swimmer + falls},
        {"ARigidBodyFalls",
         "rigid-swimmer",
         {"field.by_T=0.0", "gravity.acceleration_m_s2=[-9.81, 0.0]", "numerics.mesh_size_m=3e-4"}},
        {"AMagnetisedTailIsStretchedByAnAxialField", "reference-2d-casefile",
         coarse_swimmer + Overrides{"tail.magnetization_A_m=1e6", "field.ramp_s=1.0"}},
        {"ALinearTail", "reference-2d-casefile", coarse_swimmer + falls + Overrides{"numerics.tail_order=1"}},
        {"ATailBehindAFixedDiscInAChannel", "passive-tail-channel", coarse_channel},
        {"WallsOfAClosedBoxMove", "passive-tail-channel",
         coarse_channel + Overrides{"head.motion=free", "head.density_kg_m3=7000.0",
                                    "domain.walls={left=\"no-slip\", right=\"no-slip\", "
                                    "bottom={condition=\"moving-wall\", speed_m_s=1e-2}, "
                                    "top={condition=\"moving-wall\", speed_m_s=1e-2}}"}},
        {"AClosedDomainThatMovesWithTheSwimmer", "open-2d",
         coarse_swimmer + falls + Overrides{"numerics.mesh_size_far_m=8e-3"}},
        {"BetweenTwoCircles", "annulus",
         coarse_swimmer + falls + Overrides{"head.center_m=[-13e-3, 0.0]", "numerics.mesh_size_m=3e-4"}},
        {"AnAxisAwayFromZero", "passive-tail-channel",
         coarse_channel + Overrides{"domain.center_m=[5e-3, 3.7e-3]", "head.center_m=[0.0, 3.7e-3]"}},
        {"AHangingFlagInVacuum",
         "csm1",
         {"gravity.acceleration_m_s2=[2.0, 0.0]", "numerics.mesh_size_m=1e-2", "numerics.mesh_size_corner_m=5e-3",
          "numerics.mesh_size_far_m=1e-2"}}};

    Scene with_half(const Case &example, const std::string &choice, const Overrides &more = {})
    {
      return shipped_scene(example.scene,
                           tight + example.overrides + more + Overrides{"numerics.symmetric_half=" + choice});
    }

    /// Start the whole scene where the half is, on the same mesh.
    void adopt(FullOrderModel<2> &whole, FullOrderModel<2> &half)
    {
      ModelState<2> state = half.state();
      if (state.fluid_mesh)
        state.fluid_mesh->image_of_vertex.clear();
      state.coupling = {};
      whole.restore(state);
    }

    double largest_difference(const Configuration<2> &a, const Configuration<2> &b)
    {
      double largest = std::max(a.pose.center.distance(b.pose.center), std::abs(a.pose.angle - b.pose.angle));
      for (unsigned int i = 0; i < a.shape.size(); ++i)
        largest = std::max(largest, (a.shape[i] - b.shape[i]).norm());
      return largest;
    }

    double largest_of(const std::vector<double> &values)
    {
      double largest = 0.;
      for (const double value : values)
        largest = std::max(largest, std::abs(value));
      return largest;
    }

    std::vector<double> difference(std::vector<double> a, const std::vector<double> &b)
    {
      for (unsigned int i = 0; i < a.size(); ++i)
        a[i] -= b.at(i);
      return a;
    }

    /// Nothing, not even rounding, tells the lower half of the body and of the mesh from the upper one.
    void expect_exact_symmetry(const FullOrderModel<2> &model)
    {
      const auto &[pose, shape] = model.now().configuration;
      EXPECT_EQ(pose.center[1], 0.);
      EXPECT_EQ(pose.angle, 0.);
      const auto surface = model.swimmer().surface(model.now().configuration);
      for (unsigned int k = 1; k < surface.size(); ++k)
      {
        EXPECT_EQ(surface[k][0], surface[surface.size() - k][0]);
        EXPECT_EQ(surface[k][1], -surface[surface.size() - k][1]);
      }
      const auto &mesh = model.fluid()->fluid_mesh();
      ASSERT_EQ(mesh.image_of_vertex.size(), mesh.mesh.n_vertices());
      for (const auto *nodes : {&mesh.mesh.nodes, &model.fluid()->positions()})
        for (unsigned int v = 0; v < mesh.mesh.n_vertices(); ++v)
        {
          EXPECT_EQ((*nodes)[v][0], (*nodes)[mesh.image_of_vertex[v]][0]);
          EXPECT_EQ((*nodes)[v][1], -(*nodes)[mesh.image_of_vertex[v]][1]);
        }
    }

    class HalfOfAScene : public testing::TestWithParam<Case>
    {
    };
  } // namespace

  // The same discrete equations on the same mesh, with half of the unknowns: what the iterations' tolerances (1e-11
  // body lengths, 1e-13 of the solution) and rounding leave.
  TEST_P(HalfOfAScene, MovesAsTheWhole)
  {
    const Scene       half_scene = with_half(GetParam(), "on"), whole_scene = with_half(GetParam(), "off");
    FullOrderModel<2> half(half_scene, MPI_COMM_WORLD), whole(whole_scene, MPI_COMM_WORLD);
    const auto        rest = half.now().configuration;
    adopt(whole, half);
    for (int step = 0; step < 3; ++step)
    {
      half.advance();
      whole.advance();
    }
    EXPECT_LT(half.n_unknowns(), .55 * whole.n_unknowns());
    ASSERT_EQ(whole.counts().n_remeshes, 0) << "the meshes differ";
    const double length = half_scene.body_length_m();
    EXPECT_GT(largest_difference(half.now().configuration, rest), 1e-6 * length) << "nothing moves";
    EXPECT_LE(largest_difference(half.now().configuration, whole.now().configuration), 1e-10 * length);
    EXPECT_EQ(half.now().configuration.pose.center[1], rest.pose.center[1]);

    const auto &a = half.balance(), &b = whole.balance();
    EXPECT_NEAR(a.dissipation, b.dissipation, 1e-9 * std::abs(b.dissipation));
    // quadratic in deformations from 3e-5 lengths on (the moving walls), which are off by up to 1e-11
    EXPECT_NEAR(a.elastic_energy, b.elastic_energy, 1e-6 * std::abs(b.elastic_energy));
    EXPECT_NEAR(a.wall, b.wall, 1e-9 * b.dissipation);
    EXPECT_NEAR(a.gravity, b.gravity, 1e-8 * std::abs(b.gravity));
    EXPECT_NEAR(a.load_that_holds_head.force[0], b.load_that_holds_head.force[0],
                1e-8 * std::abs(b.load_that_holds_head.force[0]));
    EXPECT_NEAR(a.load_that_holds_head.force[1], 0., 1e-8 * std::abs(b.load_that_holds_head.force[0]));
    const auto flow = half.coupling().fluid_values(), whole_flow = whole.coupling().fluid_values();
    EXPECT_LE(largest_of(difference(flow, whole_flow)), 1e-8 * largest_of(whole_flow));
  }

  INSTANTIATE_TEST_SUITE_P(Scenes, HalfOfAScene, testing::ValuesIn(cases),
                           [](const auto &example) { return example.param.name; });

  TEST(SymmetricRun, RemeshingKeepsTheSymmetryExactly)
  {
    const Scene       scene = with_half(cases.front(), "on", {"numerics.remesh_every_steps=1"});
    FullOrderModel<2> model(scene, MPI_COMM_WORLD);
    for (int step = 0; step < 3; ++step)
      model.advance();
    EXPECT_GE(model.counts().n_remeshes, 2);
    expect_exact_symmetry(model);
  }

  // Through the file: the pairs of the mesh are in it.
  TEST(SymmetricRun, ARestoredRunKeepsTheSymmetryExactlyAndContinuesAsIfItHadNotStopped)
  {
    const Scene       scene = with_half(cases.front(), "on");
    FullOrderModel<2> stopped(scene, MPI_COMM_WORLD), restored(scene, MPI_COMM_WORLD);
    stopped.advance();
    const TemporaryFolder folder;
    Provenance            provenance;
    provenance.scene_hash = scene.hash;
    write_checkpoint<2>(folder.path / "checkpoint.h5", {stopped.state(), {numbers_of({})}, {{0.}}}, provenance);
    restored.restore(read_checkpoint<2>(folder.path / "checkpoint.h5", scene).model);
    stopped.advance();
    restored.advance();
    expect_exact_symmetry(restored);
    EXPECT_EQ(largest_difference(stopped.now().configuration, restored.now().configuration), 0.);
  }
} // namespace swimtwin
