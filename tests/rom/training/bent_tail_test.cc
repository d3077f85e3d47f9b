#include <rom/training/bent_tail.h>

#include <fom/elastic/nodal_vector.h>
#include <fom/run/run_recorder.h>
#include <rom/training/relaxed_tail.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    struct BentBody
    {
      explicit BentBody(const std::string &law)
          : scene(
                shipped_scene("reference-2d-casefile", {"numerics.mesh_size_m=6e-4", "numerics.mesh_size_corner_m=2e-4",
                                                        "tail.law=\"" + law + "\""})),
            swimmer(scene, MPI_COMM_WORLD), space(make_tail_space(RunRecorder<2>(scene).snapshots(swimmer))),
            coordinates(swimmer)
      {
        coordinates.choose_modes(Eigen::MatrixXd(2 * swimmer.tail().mesh.n_nodes(), 0), 2);
        bend << 0.1 * coordinates.length_m(), -0.04 * coordinates.length_m(); // as much as a stiff clamp bears
      }

      Scene              scene;
      Swimmer<2>         swimmer;
      TailSpace          space;
      BendingCoordinates coordinates;
      Eigen::VectorXd    bend = Eigen::VectorXd::Zero(2);
    };

    class BentTails : public ::testing::TestWithParam<const char *>
    {
    protected:
      BentBody body{GetParam()};
    };
  } // namespace

  TEST(BendingCoordinates, OfATurnedTailAreItsAngle)
  {
    const BentBody        body("st-venant-kirchhoff");
    const double          angle = 2.5; // far beyond a right angle
    const Eigen::Matrix2d turn  = Eigen::Rotation2Dd(angle).toRotationMatrix() - Eigen::Matrix2d::Identity();
    Eigen::VectorXd       turned(body.space.nodes_m.size());
    for (Eigen::Index a = 0; a < body.space.nodes_m.rows(); ++a)
      turned.segment<2>(2 * a) = turn * body.space.nodes_m.row(a).transpose();
    const Eigen::VectorXd q = body.coordinates.of(turned);
    EXPECT_NEAR(q[0], angle * body.coordinates.length_m(), 1e-12 * q[0]); // the first mode is constant
    EXPECT_NEAR(q[1], 0., 1e-12 * q[0]);
  }

  TEST_P(BentTails, RelaxToTheCoordinatesThatWereAsked)
  {
    RelaxedTail tail(body.swimmer, body.coordinates);
    const auto  shapes = tail.on_the_way_to(body.bend, 4);
    ASSERT_EQ(shapes.size(), 4u);
    EXPECT_LE((body.coordinates.of(shapes.back().displacement) - body.bend).norm(), 1e-9 * body.bend.norm());
  }

  TEST_P(BentTails, HoldTheMomentsThatTheirEnergyTells)
  {
    RelaxedTail        tail(body.swimmer, body.coordinates);
    const RelaxedShape at = tail.on_the_way_to(body.bend, 4).back();
    const double       h  = 1e-4 * body.coordinates.length_m();
    for (int k = 0; k < 2; ++k)
    {
      const Eigen::VectorXd step  = h * Eigen::VectorXd::Unit(2, k);
      const double          slope = (tail.on_the_way_to(body.bend + step, 4).back().energy_m2 -
                            tail.on_the_way_to(body.bend - step, 4).back().energy_m2) /
                           (2. * h);
      EXPECT_NEAR(at.slope_m[k], slope, 1e-6 * at.slope_m.norm());
    }
  }

  TEST_P(BentTails, AreOfLeastEnergy)
  {
    RelaxedTail        tail(body.swimmer, body.coordinates);
    const RelaxedShape at = tail.on_the_way_to(body.bend, 4).back();
    // Any other shape with the same coordinates: pull the tip outwards, then bend back to them.
    const double    E   = body.scene.tail->young_modulus_Pa;
    Eigen::VectorXd off = at.displacement;
    for (Eigen::Index a = 0; a < body.space.nodes_m.rows(); ++a)
      if (!body.swimmer.is_clamped(static_cast<unsigned int>(a)))
        off[2 * a] += 1e-3 * (body.space.nodes_m(a, 0) - 0.25e-3);
    const double energy = body.swimmer.elasticity().energy(nodal_field<2>(off)) / E;
    const double moved  = at.slope_m.dot(Eigen::VectorXd(body.coordinates.of(off)) - at.q); // work of the moments
    EXPECT_GT(energy - at.energy_m2 - moved, 0.);
  }

  TEST_P(BentTails, AreFittedWithTheirEnergyAndExactParity)
  {
    Eigen::MatrixXd seen(2, 40); // a loop
    for (int k = 0; k < 40; ++k)
      seen.col(k) << body.bend[0] * std::cos(.157 * k), body.bend[1] * std::sin(.157 * k);
    const BentTail bent = fit_bent_tail(body.swimmer, body.space, body.coordinates, seen, {}, MPI_COMM_WORLD);
    EXPECT_LE(bent.shape_error, 1e-4);
    EXPECT_LE(bent.moment_error, 1e-4);

    TailBasis basis;
    basis.bent              = std::make_shared<const BentTail>(bent);
    const Eigen::VectorXd q = .6 * body.bend, d = basis.displacement(q);
    EXPECT_LE((basis.coordinates_of(body.space, d) - q).norm(), 1e-3 * q.norm());
    EXPECT_LE((body.space.mirrored(d) - basis.displacement(-q)).cwiseAbs().maxCoeff(), 1e-9 * d.cwiseAbs().maxCoeff());
    const RelaxedShape          at = RelaxedTail(body.swimmer, body.coordinates).on_the_way_to(q, 3).back();
    const CoordinatePolynomials energy(bent.energy, Eigen::VectorXi::Constant(2, -1));
    EXPECT_NEAR(energy.value(q)[0], at.energy_m2, 1e-4 * at.energy_m2);
  }

  // An independent truth: the linear tail under forces along y, spread over its volume.
  TEST_P(BentTails, ShearUnderForcesAsTheLinearTailDoes)
  {
    const auto                 &mesh = body.swimmer.tail().mesh;
    const auto                  n    = static_cast<Eigen::Index>(2 * mesh.n_nodes());
    const NodalField<2>         rest = nodal_field<2>(Eigen::VectorXd::Zero(n));
    Eigen::MatrixXd             K    = Eigen::MatrixXd::Zero(n, n);
    ElasticTail<2>::CellForce   force;
    ElasticTail<2>::CellTangent tangent;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      body.swimmer.elasticity().cell_force_and_tangent(c, rest, force, tangent);
      for (unsigned int i = 0; i < 2 * n_cell_nodes<2>; ++i)
        for (unsigned int j = 0; j < 2 * n_cell_nodes<2>; ++j)
          K(2 * mesh.cells[c][i / 2] + i % 2, 2 * mesh.cells[c][j / 2] + j % 2) += tangent[i][j];
    }
    Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(n, 2); // even, growing to the tip
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      loads.row(2 * a + 1) << 1., 200. * mesh.nodes[a][0];
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
    {
      loads.row(2 * a + 1) *= body.swimmer.elasticity().volume_of_node()[a];
      for (const Eigen::Index i : {2 * a, 2 * a + 1})
        if (body.swimmer.is_clamped(a))
        {
          K.row(i).setZero();
          K(i, i) = 1.;
          loads.row(i).setZero();
        }
    }
    Eigen::MatrixXd bends = K.lu().solve(loads);
    for (int k : {0, 1}) // bent little, so that all is linear
    {
      const double scale = 1e-3 * body.coordinates.length_m() / body.coordinates.of(bends.col(k)).norm();
      bends.col(k) *= scale;
      loads.col(k) *= scale;
    }
    Eigen::MatrixXd runs(n, 40);
    for (int k = 0; k < 40; ++k)
      runs.col(k) = bends * Eigen::Vector2d(std::cos(.157 * k), std::sin(.157 * k));
    const Eigen::MatrixXd seen = body.coordinates.of(runs);
    const Eigen::Vector2d amounts(.5, -.8);
    const Eigen::VectorXd truth = bends * amounts, q = body.coordinates.of(truth);
    const double          energy = .5 * truth.dot(loads * amounts) / body.scene.tail->young_modulus_Pa;

    const auto errors = [&](const Eigen::MatrixXd &displacements) {
      TailBasis basis;
      basis.bent = std::make_shared<const BentTail>(
          fit_bent_tail(body.swimmer, body.space, body.coordinates, seen, displacements, MPI_COMM_WORLD));
      const double told = CoordinatePolynomials(basis.bent->energy, Eigen::VectorXi::Constant(2, -1)).value(q)[0];
      return Eigen::Vector2d((basis.displacement(q) - truth).norm() / truth.norm(), std::abs(told / energy - 1.));
    };
    const Eigen::Vector2d least_energy = errors(Eigen::MatrixXd(n, 0)), with_response = errors(runs);
    EXPECT_GT(least_energy[0], 1e-2);
    EXPECT_LT(with_response[0], 1e-3);
    EXPECT_GT(least_energy[1], 5e-3);
    EXPECT_LT(with_response[1], 1e-3);
  }

  INSTANTIATE_TEST_SUITE_P(Laws, BentTails, ::testing::Values("st-venant-kirchhoff", "neo-hookean"),
                           [](const auto &instance) {
                             return instance.index == 0 ? "StVenantKirchhoff" : "NeoHookean";
                           });
} // namespace swimtwin
