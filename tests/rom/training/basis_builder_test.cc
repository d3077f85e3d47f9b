#include <rom/training/basis_builder.h>

#include <datasets/system/error.h>
#include <fom/elastic/nodal_vector.h>
#include <fom/run/run_recorder.h>
#include <rom/training/shape_sampler.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    class BasisBuilderTest : public ::testing::Test
    {
    protected:
      Scene scene =
          shipped_scene("reference-2d-casefile", {"numerics.mesh_size_m=5e-4", "numerics.mesh_size_corner_m=1.5e-4"});
      Swimmer<2>    swimmer{scene, MPI_COMM_WORLD};
      TailSpace     space = make_tail_space(RunRecorder<2>(scene).snapshots(swimmer));
      TailStiffness stiffness{swimmer, space};
      TailBasis     basis = elastic(4, 4);

      TailBasis elastic(const int r, const int s) const
      {
        return BasisBuilder(space, stiffness, MPI_COMM_WORLD).compute(r, s);
      }

      double gram_error(const Eigen::MatrixXd &fields) const
      {
        return (fields.transpose() * (space.mean_product * fields) -
                Eigen::MatrixXd::Identity(fields.cols(), fields.cols()))
            .cwiseAbs()
            .maxCoeff();
      }
    };
  } // namespace

  TEST_F(BasisBuilderTest, AreOrthonormalInTheMeanOverTheTail)
  {
    EXPECT_EQ(basis.n_coordinates(), 4);
    EXPECT_LE(gram_error(basis.coordinates), 1e-12);
    EXPECT_LE(gram_error(basis.followers), 1e-10);
  }

  TEST_F(BasisBuilderTest, HaveExactParity)
  {
    EXPECT_LE((space.mirrored(basis.coordinates) + basis.coordinates).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LE((space.mirrored(basis.followers) - basis.followers).cwiseAbs().maxCoeff(), 1e-10);
  }

  TEST_F(BasisBuilderTest, VanishOnTheHead)
  {
    for (const auto a : swimmer.tail().clamped_nodes)
      EXPECT_LE(basis.coordinates.middleRows(2 * a, 2).cwiseAbs().maxCoeff(), 1e-9);
  }

  // Bending costs the least energy if the tail may shorten: with followers the energy of a bent tail is that of
  // bending alone, without them stretching dominates. Their right amplitude is where it is least.
  TEST_F(BasisBuilderTest, FollowersRelaxTheEnergyOfBending)
  {
    Eigen::VectorXd q(4);
    q << 4e-4, 0., 0., 0.;
    const Eigen::VectorXd bent = basis.coordinates * q, followed = basis.followers * basis.follower_amplitudes(q);
    const auto            energy = [&](const double share) {
      return swimmer.elasticity().energy(nodal_field<2>(bent + share * followed));
    };
    EXPECT_LT(energy(1.), .5 * energy(0.));
    EXPECT_LT(energy(1.), energy(.9));
    EXPECT_LT(energy(1.), energy(1.1));
  }

  TEST_F(BasisBuilderTest, TangentIsTheDerivativeOfTheDisplacement)
  {
    Eigen::VectorXd q(4), direction(4);
    q << 4e-4, -1e-4, 3e-5, 1e-5;
    direction << .3, -.5, .7, .2;
    const double          step = 1e-6;
    const Eigen::VectorXd difference =
        (basis.displacement(q + step * direction) - basis.displacement(q - step * direction)) / (2. * step);
    EXPECT_LE((basis.tangent(q) * direction - difference).norm(), 1e-9 * difference.norm());
  }

  /// Snapshots that bend as the elastic tail does, along a path in its two lowest modes, and shorten with it.
  SnapshotSet snapshots_along(const TailBasis &basis, SnapshotSet set, const int n)
  {
    set.tail_displacement_m.resize(n, basis.coordinates.rows());
    for (int k = 0; k < n; ++k)
    {
      Eigen::VectorXd q              = Eigen::VectorXd::Zero(basis.n_coordinates());
      q(0)                           = 5e-4 * std::cos(2. * 3.14159 * k / n);
      q(1)                           = 1e-4 * std::sin(2. * 3.14159 * k / n);
      set.tail_displacement_m.row(k) = basis.displacement(q).transpose();
    }
    return set;
  }

  TEST_F(BasisBuilderTest, FindsTheModesOfSnapshotsAndTheirShortening)
  {
    const SnapshotSet set = snapshots_along(basis, RunRecorder<2>(scene).snapshots(swimmer), 50);
    BasisBuilder      builder(space, stiffness, MPI_COMM_WORLD);
    builder.add(set, "made up");
    const TailBasis found = builder.compute(2, 3);
    // The elastic tail's answer has the weight 0.02^2 against the snapshots', whose followers move by up to 50 um.
    EXPECT_LT(found.projection_error_m, 0.02 * 0.02 * 50e-6);
    EXPECT_GT(found.energy_captured, 1. - 1e-8);
  }

  TEST_F(BasisBuilderTest, FillsUpWithElasticModesWhereSnapshotsHaveNone)
  {
    BasisBuilder builder(space, stiffness, MPI_COMM_WORLD);
    builder.add(snapshots_along(basis, RunRecorder<2>(scene).snapshots(swimmer), 50), "made up");
    const TailBasis four = builder.compute(4, 8);
    EXPECT_EQ(four.n_coordinates(), 4);
    EXPECT_LE(gram_error(four.coordinates), 1e-10);
    const Eigen::MatrixXd left =
        basis.coordinates - four.coordinates * space.amplitudes(four.coordinates, basis.coordinates);
    EXPECT_LE(left.cwiseAbs().maxCoeff(), 1e-6); // the space of the four lowest modes
  }

  TEST_F(BasisBuilderTest, RefusesSnapshotsOfAnotherTail)
  {
    SnapshotSet set = RunRecorder<2>(scene).snapshots(swimmer);
    set.tail_nodes_m *= 1.01;
    BasisBuilder builder(space, stiffness, MPI_COMM_WORLD);
    EXPECT_THROW(builder.add(set, "snapshots.h5"), InputError);
  }
} // namespace swimtwin
