#include <rom/training/strain_grams.h>

#include <fom/elastic/nodal_vector.h>
#include <fom/run/run_recorder.h>
#include <rom/training/basis_builder.h>
#include <rom/training/shape_sampler.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// W and its gradient from the Gram matrices, by the formula of datasets/reduced/reduced_model.h.
    struct GramEnergy
    {
      ReducedElasticity elasticity;
      LameConstants     lame;

      double          value(const Eigen::VectorXd &q) const { return monomials(q).dot(gram() * monomials(q)); }
      Eigen::VectorXd gradient(const Eigen::VectorXd &q) const
      {
        const auto            r      = q.size();
        const Eigen::VectorXd stress = 2. * gram() * monomials(q);
        Eigen::VectorXd       g      = stress.head(r);
        for (int i = 0; i < r; ++i)
          for (int j = 0; j <= i; ++j)
          {
            const double s = stress(strain_monomial(static_cast<int>(r), i, j));
            g(i) += s * q(j);
            g(j) += s * q(i);
          }
        return g;
      }
      Eigen::MatrixXd gram() const { return lame.lambda_Pa * elasticity.gram_lambda + lame.mu_Pa * elasticity.gram_mu; }
      static Eigen::VectorXd monomials(const Eigen::VectorXd &q)
      {
        Eigen::VectorXd m(q.size() + q.size() * (q.size() + 1) / 2);
        m << q, products(q);
        return m;
      }
    };

    class StrainGramsTest : public ::testing::Test
    {
    protected:
      Scene scene =
          shipped_scene("reference-2d-casefile", {"numerics.mesh_size_m=5e-4", "numerics.mesh_size_corner_m=1.5e-4"});
      Swimmer<2>      swimmer{scene, MPI_COMM_WORLD};
      TailSpace       space = make_tail_space(RunRecorder<2>(scene).snapshots(swimmer));
      TailStiffness   stiffness{swimmer, space};
      TailBasis       basis = BasisBuilder(space, stiffness, MPI_COMM_WORLD).compute(3, 3);
      Eigen::MatrixXd modes = all_modes();
      GramEnergy      energy{compute_strain_grams(swimmer, modes),
                        lame_constants(scene.tail->young_modulus_Pa, scene.tail->poisson_ratio)};
      Eigen::VectorXd q = amplitudes();

      Eigen::MatrixXd all_modes() const
      {
        Eigen::MatrixXd all(basis.coordinates.rows(), basis.n_coordinates() + basis.n_followers());
        all << basis.coordinates, basis.followers;
        return all;
      }
      Eigen::VectorXd amplitudes() const // bent by about a third of its length, and stretched
      {
        Eigen::VectorXd a(modes.cols());
        for (Eigen::Index i = 0; i < a.size(); ++i)
          a(i) = 1e-3 * std::cos(1. + 2. * double(i)) / double(1 + i);
        return a;
      }
    };
  } // namespace

  TEST_F(StrainGramsTest, EnergyIsThatOfTheFullTail)
  {
    const double expected = swimmer.elasticity().energy(nodal_field<2>(modes * q));
    EXPECT_NEAR(energy.value(q), expected, 1e-12 * expected);
  }

  TEST_F(StrainGramsTest, ForceIsTheProjectedForceOfTheFullTail)
  {
    const auto               &mesh  = swimmer.tail().mesh;
    const NodalField<2>       shape = nodal_field<2>(modes * q);
    ElasticTail<2>::CellForce cell_force;
    Eigen::VectorXd           force = Eigen::VectorXd::Zero(modes.rows());
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      swimmer.elasticity().cell_force(c, shape, cell_force);
      for (unsigned int i = 0; i < cell_force.size(); ++i)
        force(2 * mesh.cells[c][i / 2] + i % 2) += cell_force[i];
    }
    const Eigen::VectorXd expected = modes.transpose() * force, computed = energy.gradient(q);
    EXPECT_LE((computed - expected).norm(), 1e-11 * expected.norm());
    std::printf("reduced against projected internal force: %.1e\n", (computed - expected).norm() / expected.norm());
  }
} // namespace swimtwin
