#include <fom/body/mesh_around.h>
#include <fom/mesh/inverted_element.h>
#include <fom/mesh/tail_mesh.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    SimplexMesh<2> one_triangle(const double bulge)
    {
      SimplexMesh<2> mesh({{{0., 0.}, {1., 0.}, {0., 1.}}, {{0, 1, 2}}}, MPI_COMM_SELF);
      mesh.nodes[mesh.edge_node(0, 1)] += Tensor<1, 2>({0., bulge});
      return mesh;
    }

    std::vector<std::string> with_sizes(const std::string &size, std::vector<std::string> more = {})
    {
      for (const char *key : {"mesh_size_m=", "mesh_size_corner_m=", "mesh_size_far_m="})
        more.push_back("numerics." + std::string(key) + size);
      return more;
    }

    /// What meshing a shipped scene at rest is refused with; empty if it is not.
    std::string refusal(const std::string &scene_name, const std::vector<std::string> &settings)
    {
      const Scene scene = shipped_scene(scene_name, settings);
      try
      {
        const Swimmer<2> swimmer(scene, MPI_COMM_SELF);
        mesh_around(swimmer, swimmer.configuration_at_rest(), MPI_COMM_SELF);
        return "";
      }
      catch (const InputError &error)
      {
        return error.what();
      }
    }
  } // namespace

  TEST(InvertedElement, IsRefusedWhereItsDeterminantCannotBeShownToBePositive)
  {
    // The determinant is 1 - 4 b at one end of the bulging edge.
    EXPECT_NO_THROW(refuse_inverted_elements(one_triangle(0.24), "the mesh"));
    for (const double bulge : {0.26, 0.5, 3.})
    {
      const std::string text =
          message_of<InvertedElement>([&] { refuse_inverted_elements(one_triangle(bulge), "the mesh"); });
      expect_in(text, "the mesh has an element inside out at (0.3333, 0.3333) m");
      expect_in(text, "an edge of 1 m");
      expect_in(text, "bulges by");
    }
  }

  TEST(InvertedElement, LeadsToAnotherMeshAndToTheFirstRefusalIfNoneIsRight)
  {
    const auto right_below = [](const double limit) {
      return [limit](const double factor) {
        if (factor > limit)
          throw InvertedElement("at " + std::to_string(factor));
        return factor;
      };
    };
    EXPECT_EQ(first_not_inverted(right_below(1.)), 1.);
    EXPECT_EQ(first_not_inverted(right_below(0.97)), 0.95);
    EXPECT_EQ(first_not_inverted(right_below(0.92)), 0.9);
    EXPECT_EQ(first_not_inverted(right_below(0.85)), 0.8);
    EXPECT_EQ(message_of<InvertedElement>([&] { first_not_inverted(right_below(0.5)); }), "at " + std::to_string(1.));
  }

  TEST(InvertedElement, CornersOnALineAreNamedSo)
  {
    SimplexMesh<2> mesh              = one_triangle(0.);
    mesh.nodes[2]                    = Point<2>(2., 0.);
    mesh.nodes[mesh.edge_node(1, 2)] = Point<2>(1.5, 0.);
    mesh.nodes[mesh.edge_node(0, 2)] = Point<2>(1., 0.);
    expect_in(message_of<InvertedElement>([&] { refuse_inverted_elements(mesh, "the mesh"); }), "on one line");
  }

  TEST(InvertedElement, CoarseRoundHeadIsRefusedWithASizeThatWorks)
  {
    for (const char *size : {"3.2e-3", "4e-3", "1e-2"})
    {
      const std::string text = refusal("rotating-disc", with_sizes(size));
      expect_in(text, "rotating-disc: [numerics] mesh_size_m = ");
      expect_in(text, "the fluid's mesh has an element inside out at (");
      const auto at = text.find("set mesh_size_m = ");
      ASSERT_NE(at, std::string::npos) << text;
      const std::string good = text.substr(at + 18, text.find(' ', at + 18) - at - 18);
      EXPECT_EQ(refusal("rotating-disc", {"numerics.mesh_size_m=" + good, "numerics.mesh_size_corner_m=" + good,
                                          "numerics.mesh_size_far_m=" + std::string(size)}),
                "");
    }
  }

  TEST(InvertedElement, NarrowGapBetweenRoundWallsIsRefused)
  {
    expect_in(refusal("rotating-disc", with_sizes("2e-3", {"domain.radius_m=1.2e-3"})), "set mesh_size_m = ");
    expect_in(refusal("rotating-disc", with_sizes("2e-3", {"domain.radius_m=1.05e-3"})), "set mesh_size_m = ");
  }

  TEST(InvertedElement, TailThatStartsFlatOnARoundHeadIsRefused)
  {
    const std::string text =
        refusal("annulus", with_sizes("4e-3", {"head.size_m=[8e-3, 1.5e-3]", "tail.root_height_m=1.45e-3",
                                               "tail.tip_height_m=1.45e-3", "tail.length_m=1e-3"}));
    expect_in(text, "the tail's mesh (origin at the head's centre) has an element inside out");
    expect_in(text, "set mesh_size_m = 0.001 and mesh_size_corner_m = 0.001 (tried)");
  }

  TEST(InvertedElement, ShippedScenesHaveNone)
  {
    for (const char *name : {"reference-2d-casefile", "reference-2d-paper", "open-2d", "annulus", "rotating-disc",
                             "rigid-swimmer", "passive-tail-channel"})
      EXPECT_EQ(refusal(name, {}), "") << name;
  }

  TEST(InvertedElement, ReflectedHalvesAreCheckedToo)
  {
    const auto settings = with_sizes("4e-3", {"domain.walls.outer=\"no-slip\"", "numerics.symmetric_half=\"on\""});
    expect_in(refusal("rotating-disc", settings), "inside out");
  }
} // namespace swimtwin
