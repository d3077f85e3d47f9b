// A swimmer whose head and tail are read from one surface: that of a swimmer which is known by its shape.
#include <datasets/surface/closed_surface.h>
#include <fom/step/full_order_model.h>
#include <tests/datasets/example_surfaces.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    const std::vector<std::string> known_by_its_shape = {"fluid.inertia=none",
                                                         "domain.size_m=[20e-3,10e-3,10e-3]",
                                                         "numerics.mesh_size_m=8e-4",
                                                         "numerics.mesh_growth=0.8",
                                                         "numerics.mesh_size_corner_m=4e-4",
                                                         "numerics.mesh_size_far_m=4e-3",
                                                         "numerics.coupling_tolerance=1e-8",
                                                         "time.periods=0.1",
                                                         "time.steps_per_period=50"};

    /// The surface of a body in a file of gmsh, faces of order 2, head and tail as its physical surfaces.
    std::string surface_text(const BodyMesh<3> &body)
    {
      ExampleSurface surface;
      for (const auto &x : body.surface.nodes)
        surface.points.push_back({x[0], x[1], x[2]});
      const auto on_tail = [&](const FaceNodes<3> &face) {
        return std::all_of(face.begin(), face.end(),
                           [&](const unsigned int node) { return body.tail_node[node] >= 0; });
      };
      std::size_t first_on_tail = 0;
      for (const bool tail : {false, true})
        for (const auto &face : body.surface.faces)
          if (on_tail(face) == tail)
          {
            surface.faces.emplace_back(face.begin(), face.end());
            first_on_tail += !tail;
          }
      return msh41_text(surface, first_on_tail, {"head", "tail"});
    }

    Scene read_from_surface(const std::filesystem::path &file)
    {
      return shipped_scene(
          "reference-3d-paper",
          {"fluid.inertia=none", "domain.size_m=[20e-3,10e-3,10e-3]",
           "head={shape=\"surface\", surface=\"" + file.string() +
               "\", surface_unit_m=1.0, density_kg_m3=7000.0, magnetization_A_m=1e5}",
           "tail={law=\"st-venant-kirchhoff\", young_modulus_Pa=2e5, poisson_ratio=0.4, density_kg_m3=1200.0}",
           "numerics={mesh_size_far_m=4e-3, mesh_growth=0.8, coupling_tolerance=1e-8}", "time.periods=0.1",
           "time.steps_per_period=50"});
    }

    struct WaysInSpace
    {
      Tensor<1, 3> head, tip; ///< ways
      double       angle, tail_angle;
      unsigned int n_unknowns;
    };

    WaysInSpace ways_of(const Scene &scene)
    {
      FullOrderModel<3> model(scene, MPI_COMM_WORLD);
      const auto        tip = [&] {
        return Tensor<1, 3>(
            model.swimmer().tail_positions(model.now().configuration)[model.swimmer().tail().axis_at_tip[2]]);
      };
      const Tensor<1, 3> head_before = model.now().configuration.pose.center, tip_before = tip();
      for (int step = 0; step < scene.time.n_steps(); ++step)
        model.advance();
      const auto &now = model.now().configuration;
      return {now.pose.center - head_before, tip() - tip_before, now.pose.heading(), model.swimmer().tail_angle(now),
              model.n_unknowns()};
    }
  } // namespace

  TEST(SurfaceSwimmer, MovesAsTheOneThatIsKnownByItsShape)
  {
    const TemporaryFolder folder;
    const Scene           known = shipped_scene("reference-3d-paper", known_by_its_shape);
    const Swimmer<3>      swimmer(known, MPI_COMM_WORLD);
    const Scene           read = read_from_surface(folder.write("swimmer.msh", surface_text(swimmer.body())));
    const Swimmer<3>      same(read, MPI_COMM_WORLD);
    const double          volume = swimmer.elasticity().volume();
    EXPECT_NEAR(same.elasticity().volume(), volume, 1e-10 * volume);
    EXPECT_NEAR(read.tail->length_m, known.tail->length_m, 1e-10);
    EXPECT_NEAR(read.head.volume(3), known.head.volume(3), 1e-3 * known.head.volume(3)); // round by coarse triangles
    EXPECT_NEAR(same.tail_angle(same.configuration_at_rest()), 0., 1e-15);
    Configuration<3> rolled = same.configuration_at_rest();
    rolled.pose.turn(AngularVelocity<3>({2., 0., 0.}));
    EXPECT_NEAR(same.tail_angle(rolled), 0., 1e-14);

    const WaysInSpace one = ways_of(known), two = ways_of(read);
    std::cout << "known by its shape, " << one.n_unknowns << " unknowns: head by " << 1e6 * one.head << " um, tip by "
              << 1e6 * one.tip << " um, angles " << one.angle << ", " << one.tail_angle << "\nfrom its surface, "
              << two.n_unknowns << " unknowns: head by " << 1e6 * two.head << " um, tip by " << 1e6 * two.tip
              << " um, angles " << two.angle << ", " << two.tail_angle << std::endl;
    EXPECT_LE((one.head - two.head).norm(), .02 * one.head.norm());
    EXPECT_LE((one.tip - two.tip).norm(), .02 * one.tip.norm());
    EXPECT_NEAR(two.angle, one.angle, .02 * std::abs(one.angle));
    // Derivatives at the end of an edge, here of cells as large as the tip, converge slowly: 5.0 % here, 3.1 % on a
    // mesh that is finer by 1.6.
    EXPECT_NEAR(two.tail_angle - two.angle, one.tail_angle - one.angle, .06 * std::abs(one.tail_angle - one.angle));
  }
} // namespace swimtwin
