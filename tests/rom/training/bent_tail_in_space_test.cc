#include <rom/training/bent_tail.h>

#include <fom/geometry/reflection.h>
#include <fom/run/run_recorder.h>
#include <rom/sweep/tail_mass_matrix.h>
#include <rom/training/relaxed_tail.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace swimtwin
{
  namespace
  {
    struct SpatialTail
    {
      SpatialTail(const std::string &name, const std::vector<std::string> &overrides, const int n_coordinates)
          : scene(shipped_scene(name, overrides)), swimmer(scene, MPI_COMM_WORLD),
            mesh(RunRecorder<3>(scene).snapshots(swimmer)), space(make_tail_space<3>(mesh, swimmer.tail().mesh)),
            coordinates(swimmer)
      {
        coordinates.choose_modes(Eigen::MatrixXd(mesh.tail_nodes_m.size(), 0), n_coordinates);
      }

      Scene              scene;
      Swimmer<3>         swimmer;
      SnapshotSet        mesh;
      TailSpace          space;
      BendingCoordinates coordinates;
    };

    SpatialTail cone(const int n_coordinates, const double finer = 1.)
    {
      return {"reference-3d-paper",
              {"tail.length_m=2.5e-3", "numerics.mesh_size_m=" + std::to_string(8e-4 / finer),
               "numerics.mesh_size_corner_m=" + std::to_string(4e-4 / finer)},
              n_coordinates};
    }

    /// Of a shape that is bent to the other side, mirrored, to one that is bent to this side; of one that is mirrored
    /// twice to itself. Relative.
    std::pair<double, double> differences_of_images(const SpatialTail &body)
    {
      RelaxedTail           tail(body.swimmer, body.coordinates);
      const Eigen::Vector2d bend  = Eigen::Vector2d(.1, -.02) * body.coordinates.length_m();
      const Eigen::VectorXd there = tail.on_the_way_to(bend, 3).back().displacement,
                            here  = tail.on_the_way_to(-bend, 3).back().displacement;
      const auto &space           = body.space;
      return {space.norm(space.mirrored(there) - here) / space.norm(here),
              space.norm(space.mirrored(space.mirrored(there)) - there) / space.norm(there)};
    }
  } // namespace

  // A thin rod that holds a mean angle c is bent to the angle 3 c (s/L - s^2 / (2 L^2)): W = 3 E I c^2 / (2 L).
  TEST(BentTailInSpace, OfAThinRodHasTheEnergyOfABeam)
  {
    const SpatialTail  rod("magnetised-cantilever-3d", {"variant=quick"}, 1);
    const double       L = 6e-3, radius = .15e-3, angle = .02;
    const RelaxedShape at = RelaxedTail(rod.swimmer, rod.coordinates)
                                .on_the_way_to(Eigen::VectorXd::Constant(1, angle * rod.coordinates.length_m()), 1)
                                .at(0);
    const double I = std::numbers::pi * std::pow(radius, 4) / 4.;
    EXPECT_NEAR(at.energy_m2, 1.5 * I * angle * angle / L, .02 * at.energy_m2); // the clamp stiffens by some radius / L
  }

  TEST(BentTailInSpace, HoldsTheMomentsThatItsEnergyTells)
  {
    const SpatialTail     body = cone(2);
    RelaxedTail           tail(body.swimmer, body.coordinates);
    const double          L = body.coordinates.length_m(), h = 1e-4 * L;
    const Eigen::Vector2d bend(.1 * L, -.02 * L);
    ASSERT_EQ(tail.on_the_way_to(bend, 4).size(), 4u);
    const RelaxedShape at = tail.on_the_way_to(bend, 4).back();
    EXPECT_LE((body.coordinates.of(at.displacement) - bend).norm(), 1e-9 * bend.norm());
    for (int k = 0; k < 2; ++k)
    {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(2, k);
      const double          slope =
          (tail.on_the_way_to(bend + step, 4).back().energy_m2 - tail.on_the_way_to(bend - step, 4).back().energy_m2) /
          (2. * h);
      EXPECT_NEAR(at.slope_m[k], slope, 1e-5 * at.slope_m.norm());
    }
  }

  // Meshes in space are no images of themselves in y -> -y; shapes are, but for their interpolation, which is less
  // off on a finer mesh: half the sizes are 1.3 times the nodes.
  TEST(BentTailInSpace, OfTheOtherSideIsItsImage)
  {
    const auto [coarse, coarse_twice] = differences_of_images(cone(2));
    const auto [fine, fine_twice]     = differences_of_images(cone(2, 2.));
    EXPECT_LE(fine, 2e-3);
    EXPECT_LE(fine, .75 * coarse);
    EXPECT_LE(fine_twice, 2e-3);
    EXPECT_LE(fine_twice, .75 * coarse_twice);
  }

  TEST(BentTailInSpace, IsFittedWithItsEnergy)
  {
    const SpatialTail body = cone(2);
    const double      L    = body.coordinates.length_m();
    Eigen::MatrixXd   seen(2, 10); // a loop
    for (int k = 0; k < 10; ++k)
      seen.col(k) << .1 * L * std::cos(.628 * k), .02 * L * std::sin(.628 * k);
    const BentTail bent = fit_bent_tail(body.swimmer, body.space, body.coordinates, seen, {}, MPI_COMM_WORLD);
    EXPECT_LE(bent.shape_error, 2e-3);
    EXPECT_LE(bent.moment_error, 2e-3);
    for (const int node : body.mesh.clamped_nodes)
      EXPECT_EQ(bent.modes.middleRows(3 * node, 3).cwiseAbs().maxCoeff(), 0.);
    const auto images = *images_of_nodes(body.swimmer.tail().mesh); // in the plane of motion
    for (Eigen::Index k = 0; k < bent.modes.cols(); ++k)
      for (unsigned int a = 0; a < images.size(); ++a)
        for (int i = 0; i < 3; ++i)
          ASSERT_NEAR(bent.modes(3 * images[a] + i, k), (i == 2 ? -1. : 1.) * bent.modes(3 * a + i, k),
                      i == 2 && images[a] == a ? 0. : 1e-12)
              << "node " << a << " of mode " << k;
    const Eigen::Vector2d       q  = Eigen::Vector2d(.06, .01) * L;
    const RelaxedShape          at = RelaxedTail(body.swimmer, body.coordinates).on_the_way_to(q, 2).back();
    const CoordinatePolynomials energy(bent.energy, Eigen::VectorXi::Constant(2, -1));
    EXPECT_NEAR(energy.value(q)[0], at.energy_m2, 2e-3 * at.energy_m2);
  }

  // What the online half integrates by its own quadrature.
  TEST(TailInSpace, HasTheMassMatrixOfItsMesh)
  {
    const SpatialTail                 body = cone(1);
    const Eigen::SparseMatrix<double> mine = tail_mass_matrix(body.mesh.tail_nodes_m, body.mesh.tail_cells);
    EXPECT_LE((mine - body.mesh.tail_mass_m2).norm(), 1e-4 * mine.norm()); // fom's is of lower degree on curved cells
  }
} // namespace swimtwin
