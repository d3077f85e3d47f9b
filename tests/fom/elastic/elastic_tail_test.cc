#include <fom/elastic/elastic_tail.h>

#include <fom/body/swimmer.h>
#include <fom/mesh/swimmer_outline.h>
#include <tests/fom/random_tensors.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    /// The tail of the reference swimmer on a mesh whose tip is curved.
    class ElasticTailTest : public ::testing::Test
    {
    protected:
      Scene scene =
          shipped_scene("reference-2d-casefile", {"numerics.mesh_size_m=5e-4", "numerics.mesh_size_corner_m=8e-5"});
      SwimmerOutline        outline = make_outline(scene.head, scene.tail, scene.numerics);
      Swimmer<2>            swimmer{scene, MPI_COMM_WORLD};
      const TailMesh<2>    &tail       = swimmer.tail();
      const ElasticTail<2> &elasticity = swimmer.elasticity();
      const LameConstants   lame       = lame_constants(scene.tail->young_modulus_Pa, scene.tail->poisson_ratio);
      const double          young = scene.tail->young_modulus_Pa, length = scene.tail->length_m;
      RandomNumbers         random;

      /// Bent by some tenths of its length, with a little noise so that nothing is special.
      NodalField<2> bent()
      {
        NodalField<2> d;
        for (const auto &X : tail.mesh.nodes)
        {
          const double s = X[0] / length;
          d.push_back(Tensor<1, 2>({-0.2 * length * s * s - 0.4 * s * X[1], 0.3 * length * s * s}) +
                      2e-6 * random.vector<2>());
        }
        return d;
      }

      NodalField<2> linear(const Tensor<2, 2> &gradient, const Tensor<1, 2> &shift) const
      {
        NodalField<2> d;
        for (const auto &X : tail.mesh.nodes)
          d.push_back(gradient * X + shift);
        return d;
      }

      NodalField<2> force(const NodalField<2> &displacement) const
      {
        NodalField<2>             f(tail.mesh.n_nodes());
        ElasticTail<2>::CellForce cell;
        for (unsigned int c = 0; c < tail.mesh.n_cells(); ++c)
        {
          elasticity.cell_force(c, displacement, cell);
          for (unsigned int i = 0; i < cell.size(); ++i)
            f[tail.mesh.cells[c][i / 2]][i % 2] += cell[i];
        }
        return f;
      }

      double sum_of_norms(const NodalField<2> &f) const
      {
        double sum = 0.;
        for (const auto &entry : f)
          sum += entry.norm();
        return sum;
      }
    };

    NodalField<2> operator+(NodalField<2> a, const NodalField<2> &b)
    {
      for (unsigned int i = 0; i < a.size(); ++i)
        a[i] += b[i];
      return a;
    }
    NodalField<2> operator*(const double factor, NodalField<2> a)
    {
      for (auto &entry : a)
        entry *= factor;
      return a;
    }
    double dot(const NodalField<2> &a, const NodalField<2> &b)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
      return sum;
    }
  } // namespace

  // The energy is a quartic along a line, so a difference of four points is exact but for rounding: 1e-16 of the energy
  // over the step, 1e-3 of a direction that changes strains by order one.
  TEST_F(ElasticTailTest, ForceIsTheDerivativeOfTheEnergy)
  {
    const NodalField<2> d = bent(), f = force(d);
    for (int sample = 0; sample < 5; ++sample)
    {
      NodalField<2> direction;
      for (unsigned int a = 0; a < d.size(); ++a)
        direction.push_back(1e-5 * random.vector<2>());
      constexpr double h      = 1e-2;
      const auto       energy = [&](const double t) { return elasticity.energy(d + t * direction); };
      const double     slope  = (8. * (energy(h) - energy(-h)) - (energy(2. * h) - energy(-2. * h))) / (12. * h);
      EXPECT_NEAR(dot(f, direction), slope, 100. * 1e-16 * energy(0.) / h + 1e-12 * std::abs(slope));
    }
  }

  // The force is a cubic in each displacement: the difference of four points is exact again.
  TEST_F(ElasticTailTest, CellTangentIsTheDerivativeOfTheCellForce)
  {
    const NodalField<2>         d = bent();
    ElasticTail<2>::CellForce   f, other;
    ElasticTail<2>::CellTangent K;
    for (unsigned int c = 0; c < tail.mesh.n_cells(); c += 7)
    {
      elasticity.cell_force(c, d, other);
      elasticity.cell_force_and_tangent(c, d, f, K);
      for (unsigned int i = 0; i < f.size(); ++i)
        EXPECT_NEAR(f[i], other[i],
                    1e-12 * young * 1e-4); // sums in another order; a force is at most about young * cell size
      for (unsigned int j = 0; j < f.size(); ++j)
      {
        constexpr double h             = 1e-6; // m, a hundredth of a cell
        const auto       shifted_force = [&](const double shift) {
          NodalField<2>             moved = d;
          ElasticTail<2>::CellForce result;
          moved[tail.mesh.cells[c][j / 2]][j % 2] += shift;
          elasticity.cell_force(c, moved, result);
          return result;
        };
        const auto a = shifted_force(h), b = shifted_force(-h), a2 = shifted_force(2. * h), b2 = shifted_force(-2. * h);
        for (unsigned int i = 0; i < f.size(); ++i)
          // Entries are of the size of young (2D: force per depth per length); rounding of forces over h.
          EXPECT_NEAR(K[i][j], (8. * (a[i] - b[i]) - (a2[i] - b2[i])) / (12. * h), 1e-9 * young);
      }
    }
  }

  TEST_F(ElasticTailTest, TangentIsSymmetric)
  {
    const NodalField<2>         d = bent();
    ElasticTail<2>::CellForce   f;
    ElasticTail<2>::CellTangent K;
    for (unsigned int c = 0; c < tail.mesh.n_cells(); ++c)
    {
      elasticity.cell_force_and_tangent(c, d, f, K);
      for (unsigned int i = 0; i < f.size(); ++i)
        for (unsigned int j = 0; j < i; ++j)
          EXPECT_NEAR(K[i][j], K[j][i], 1e-12 * young);
    }
  }

  // F is a rotation up to the rounding of displacements over cells: 1e-16 * 8 mm / 0.05 mm ~ 2e-14, times a safety
  // of 50.
  TEST_F(ElasticTailTest, RigidMotionCostsNothing)
  {
    constexpr double strain = 1e-12;
    Tensor<2, 2>     turn   = random.rotation<2>();
    turn -= Tensor<2, 2>(unit_symmetric_tensor<2>());
    const NodalField<2> d = linear(turn, Tensor<1, 2>({3e-3, -2e-3}));
    EXPECT_LE(elasticity.energy(d), (lame.lambda_Pa + lame.mu_Pa) * strain * strain * elasticity.volume());
    for (const auto &f : force(d))
      EXPECT_LE(f.norm(), (lame.lambda_Pa + lame.mu_Pa) * strain * 1e-3);
    EXPECT_FALSE(elasticity.is_inverted(d));
  }

  TEST_F(ElasticTailTest, InternalForcesHaveNeitherResultantNorMoment)
  {
    const NodalField<2> d = bent(), f = force(d);
    Tensor<1, 2>        resultant;
    double              moment = 0.;
    for (unsigned int a = 0; a < d.size(); ++a)
    {
      const Tensor<1, 2> x = tail.mesh.nodes[a] + d[a];
      resultant += f[a];
      moment += x[0] * f[a][1] - x[1] * f[a][0];
    }
    EXPECT_LE(resultant.norm(), 1e-13 * sum_of_norms(f));
    EXPECT_LE(std::abs(moment), 1e-13 * sum_of_norms(f) * length);
  }

  // The sides are straight. On the round tip an edge of half angle a is a parabola through three points of the arc and
  // misses the area r^2 a^5 / 30 (series of both segments' areas), the half circle pi / (2 a) times that.
  TEST_F(ElasticTailTest, VolumeIsTheAreaOfTrapezoidAndHalfDisc)
  {
    const double r = scene.tail->tip_height_m / 2, straight = length - r;
    const double exact =
        straight * (scene.tail->root_height_m + scene.tail->tip_height_m) / 2 + std::numbers::pi * r * r / 2;
    const double half_edge =
        outline.size({outline.tip()[0] - r, r}) / 2 / r; // the longest edge of the arc, half its angle
    EXPECT_NEAR(elasticity.volume(), exact, r * r * std::numbers::pi / 60 * std::pow(half_edge, 4));
    double sum = 0.;
    for (const auto volume : elasticity.volume_of_node())
      sum += volume;
    EXPECT_NEAR(sum, elasticity.volume(), 1e-13 * elasticity.volume());
  }

  // A uniform field pulls a magnetised tail by its ends only: no net force, and the moment of M e_x times the area.
  TEST_F(ElasticTailTest, AxialGradientHasNoResultantAndUnitMoment)
  {
    double       sum = 0., magnitude = 0.;
    Tensor<1, 2> first_moment;
    for (unsigned int a = 0; a < tail.mesh.n_nodes(); ++a)
    {
      const double g = elasticity.axial_gradient_of_node()[a];
      sum += g;
      magnitude += std::abs(g);
      first_moment += g * tail.mesh.nodes[a];
    }
    EXPECT_LE(std::abs(sum), 1e-13 * magnitude);
    EXPECT_NEAR(first_moment[0], elasticity.volume(), 1e-12 * elasticity.volume());
    EXPECT_NEAR(first_moment[1], 0., 1e-12 * elasticity.volume());
  }

  // Curved quadratic cells hold linear fields exactly and their quadrature integrates the gradients exactly.
  TEST_F(ElasticTailTest, UniformStrainLeavesInteriorNodesInBalance)
  {
    Tensor<2, 2> gradient;
    gradient[0]              = Tensor<1, 2>({0.1, -0.05});
    gradient[1]              = Tensor<1, 2>({0.2, 0.15});
    const auto             d = linear(gradient, Tensor<1, 2>({1e-3, 2e-3}));
    const auto             f = force(d);
    std::set<unsigned int> boundary(tail.surface_nodes.begin(), tail.surface_nodes.end());
    boundary.insert(tail.clamped_nodes.begin(), tail.clamped_nodes.end());
    for (unsigned int a = 0; a < f.size(); ++a)
      if (boundary.count(a) == 0)
      {
        EXPECT_LE(f[a].norm(), 1e-12 * young * 1e-3)
            << "node " << a; // rounding of F (2e-14) times stress times cell size
      }
    const double density = make_law<2>(MaterialModel::st_venant_kirchhoff, lame)
                               ->energy(Tensor<2, 2>(unit_symmetric_tensor<2>()) + gradient);
    EXPECT_NEAR(elasticity.energy(d), density * elasticity.volume(), 1e-12 * density * elasticity.volume());
  }

  TEST_F(ElasticTailTest, MassAndNormAreThoseOfTheShape)
  {
    const NodalField<2> one = linear(Tensor<2, 2>(), Tensor<1, 2>({3., 4.}));
    EXPECT_NEAR(elasticity.norm_square(one), 25. * elasticity.volume(), 1e-12 * 25. * elasticity.volume());
    double mass = 0.;
    for (unsigned int c = 0; c < tail.mesh.n_cells(); ++c)
      for (unsigned int a = 0; a < n_cell_nodes<2>; ++a)
        for (unsigned int b = 0; b < n_cell_nodes<2>; ++b)
          mass += elasticity.cell_mass(c, a, b);
    EXPECT_NEAR(mass, elasticity.volume(), 1e-12 * elasticity.volume());
  }

  TEST_F(ElasticTailTest, ReflectionIsFoundInverted)
  {
    Tensor<2, 2> reflection;
    reflection[1][1] = -2.;
    EXPECT_TRUE(elasticity.is_inverted(linear(reflection, {})));
  }
} // namespace swimtwin
