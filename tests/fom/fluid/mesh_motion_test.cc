#include <fom/fluid/mesh_motion.h>

#include <fom/body/swimmer.h>
#include <fom/fluid/fluid_domain.h>
#include <tests/fom/random_tensors.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    constexpr double degree = std::numbers::pi / 180.;

    const char *name(const MeshMotion law)
    {
      return law == MeshMotion::elastic ? "elastic" : law == MeshMotion::harmonic ? "harmonic" : "weighted harmonic";
    }

    /// A swimmer in its box.
    class SwimmerInABox : public ::testing::Test
    {
    protected:
      explicit SwimmerInABox(Scene s) : scene(std::move(s)) {}

      Scene            scene;
      Swimmer<2>       swimmer{scene, MPI_COMM_WORLD};
      Configuration<2> rest = swimmer.configuration_at_rest();
      FluidMesh<2> fluid = make_fluid_mesh(*scene.domain, swimmer.surface(rest), swimmer.surface_mesh_size(), rest.pose,
                                           rest.pose, scene.numerics, MPI_COMM_WORLD);
      NodeNumbering<2> numbering{fluid.mesh, true};

      std::vector<unsigned int> walls() const
      {
        std::vector<unsigned int> nodes;
        for (const auto &wall_node : fluid.wall_nodes)
          nodes.push_back(wall_node.node);
        return nodes;
      }
      /// Of the swimmer's surface, turned about the head's centre.
      std::vector<Tensor<1, 2>> rotation(const double angle) const
      {
        Configuration<2> turned = rest;
        turned.pose.angle += angle;
        const auto                x = swimmer.surface(turned);
        std::vector<Tensor<1, 2>> displacement;
        for (unsigned int k = 0; k < x.size(); ++k)
          displacement.push_back(x[k] - fluid.mesh.nodes[fluid.surface_nodes[k]]);
        return displacement;
      }
      double quality_after(MeshExtension<2> &extension, const std::vector<Tensor<1, 2>> &displacement) const
      {
        auto       x        = fluid.mesh.nodes;
        const auto extended = extension.extend(displacement);
        for (unsigned int i = 0; i < x.size(); ++i)
          x[i] += extended[i];
        return worst_quality(fluid.mesh, x);
      }
      MeshExtension<2> extension(const MeshMotion law)
      {
        return {fluid.mesh, numbering, law, fluid.surface_nodes, walls()};
      }

      /// In steps of 2.5 degrees.
      double first_inversion(const MeshMotion law)
      {
        auto   follows = extension(law);
        double angle   = 0.;
        while (angle < 180. && quality_after(follows, rotation(angle * degree)) > 0.)
          angle += 2.5;
        std::cout << "mesh motion: " << name(law) << " inverts a triangle at " << angle << " degrees" << std::endl;
        return angle;
      }
      std::vector<unsigned int> boundary() const
      {
        std::vector<unsigned int> nodes = fluid.surface_nodes;
        for (const auto node : walls())
          nodes.push_back(node);
        return nodes;
      }
    };

    const std::vector<std::string> coarse_motion = {"numerics.mesh_size_m=4e-4", "numerics.mesh_size_corner_m=1e-4",
                                                    "numerics.mesh_size_far_m=4e-3", "numerics.mesh_growth=0.3"};

    /// Whose tip swings past a wall, 2.25 mm away at a quarter turn.
    class MeshMotionTest : public SwimmerInABox
    {
    protected:
      MeshMotionTest() : SwimmerInABox(shipped_scene("reference-2d-casefile", coarse_motion)) {}
    };

    /// An ellipse, far from walls.
    class MeshMotionOfAnEllipseTest : public SwimmerInABox
    {
    protected:
      MeshMotionOfAnEllipseTest() : SwimmerInABox(shipped_scene("rigid-swimmer", coarse_motion)) {}
    };
  } // namespace

  // Linear fields solve every one of the laws' equations only where the stiffness is uniform (harmonic), or where their
  // stress is zero (rigid motions and, for elastic, infinitesimal turns).
  TEST_F(MeshMotionTest, HarmonicReproducesLinearDisplacements)
  {
    MeshExtension<2>          harmonic(fluid.mesh, numbering, MeshMotion::harmonic, boundary(), {});
    RandomNumbers             random;
    const Tensor<2, 2>        H = random.matrix<2>();
    std::vector<Tensor<1, 2>> displacement;
    for (const auto node : boundary())
      displacement.push_back(H * fluid.mesh.nodes[node]);
    const auto extended = harmonic.extend(displacement);
    for (unsigned int vertex = 0; vertex < fluid.mesh.n_vertices(); ++vertex)
      EXPECT_LE((extended[vertex] - H * fluid.mesh.nodes[vertex]).norm(),
                1e-11 * 20e-3); // condition 1e4 times 1e-16, with room
  }

  TEST_F(MeshMotionTest, EveryLawReproducesTranslationsAndElasticSmallTurns)
  {
    for (const auto law : {MeshMotion::elastic, MeshMotion::weighted_harmonic, MeshMotion::harmonic})
    {
      MeshExtension<2> follows(fluid.mesh, numbering, law, boundary(), {});
      Tensor<2, 2>     turn;
      if (law == MeshMotion::elastic)
      {
        turn[0][1] = -0.3;
        turn[1][0] = 0.3;
      }
      const Tensor<1, 2>        shift({1e-3, -2e-3});
      std::vector<Tensor<1, 2>> displacement;
      for (const auto node : boundary())
        displacement.push_back(turn * fluid.mesh.nodes[node] + shift);
      const auto extended = follows.extend(displacement);
      for (unsigned int vertex = 0; vertex < fluid.mesh.n_vertices(); ++vertex)
        EXPECT_LE((extended[vertex] - turn * fluid.mesh.nodes[vertex] - shift).norm(), 1e-9 * 20e-3)
            << name(law); // condition 1e6 at most
    }
  }

  TEST_F(MeshMotionTest, MeshDependsOnTheDisplacementAloneNotOnThePath)
  {
    auto       straight = extension(MeshMotion::elastic), detour = extension(MeshMotion::elastic);
    const auto expected = straight.extend(rotation(20. * degree));
    detour.extend(rotation(-35. * degree));
    detour.extend(rotation(50. * degree));
    const auto found = detour.extend(rotation(20. * degree));
    for (unsigned int i = 0; i < found.size(); ++i)
      EXPECT_LE((found[i] - expected[i]).norm(), 1e-12 * 20e-3); // one direct solve each
  }

  TEST_F(MeshMotionTest, WallsStayAndTheSurfaceIsWhereItWasPut)
  {
    auto       follows      = extension(MeshMotion::elastic);
    const auto displacement = rotation(30. * degree), extended = follows.extend(displacement);
    for (const auto node : walls())
      EXPECT_EQ(extended[node].norm(), 0.);
    for (unsigned int k = 0; k < displacement.size(); ++k)
      EXPECT_EQ((extended[fluid.surface_nodes[k]] - displacement[k]).norm(), 0.);
  }

  TEST_F(MeshMotionOfAnEllipseTest, ElasticLawSurvivesTurnsOfSixtyDegrees)
  {
    auto follows = extension(MeshMotion::elastic);
    for (const double angle : {-60., -40., -20., 20., 40., 60.})
      EXPECT_GT(quality_after(follows, rotation(angle * degree)), 0.) << angle << " degrees";
  }

  // Here the wall limits: what is stiff near the swimmer shears the cells along the wall that the tip passes.
  TEST_F(MeshMotionTest, ElasticLawSurvivesTurnsOfThirtyDegreesBesideAWall)
  {
    auto follows = extension(MeshMotion::elastic);
    for (const double angle : {-30., -15., 15., 30.})
      EXPECT_GT(quality_after(follows, rotation(angle * degree)), 0.) << angle << " degrees";
  }

  TEST_F(MeshMotionOfAnEllipseTest, ElasticLawGoesFurtherThanWeightedHarmonicThanHarmonic)
  {
    const double elastic  = first_inversion(MeshMotion::elastic),
                 weighted = first_inversion(MeshMotion::weighted_harmonic),
                 harmonic = first_inversion(MeshMotion::harmonic);
    EXPECT_GT(elastic, weighted);
    EXPECT_GT(weighted, harmonic);
  }

  // The same through the fluid's domain, in a domain that moves along: a rigid motion of the swimmer deforms nothing
  // when the domain follows it.
  TEST(FluidDomainFollows, DomainThatMovesWithTheSwimmerIsNotDeformedByRigidMotions)
  {
    const Scene scene = shipped_scene("open-2d", {"numerics.mesh_size_m=4e-4", "numerics.mesh_size_corner_m=1e-4"});
    const Swimmer<2> swimmer(scene, MPI_COMM_WORLD);
    Configuration<2> c = swimmer.configuration_at_rest();
    FluidDomain<2>   fluid(scene,
                           make_fluid_mesh(*scene.domain, swimmer.surface(c), swimmer.surface_mesh_size(), c.pose, c.pose,
                                           scene.numerics, MPI_COMM_WORLD),
                           c.pose);
    const double     at_rest = fluid.quality();
    const auto       before  = fluid.positions();
    c.pose.center += Tensor<1, 2>({0.1, -0.2});
    c.pose.angle = 2.5;
    EXPECT_NEAR(fluid.follow(swimmer.surface(c), c.pose).value(), at_rest,
                1e-9); // rounding of 0.2 m over cells of 1e-4 m, squared sides
    for (unsigned int i = 0; i < before.size(); ++i)
      EXPECT_LE(fluid.positions()[i].distance(c.pose.to_laboratory(before[i])), 1e-12);
  }
} // namespace swimtwin
