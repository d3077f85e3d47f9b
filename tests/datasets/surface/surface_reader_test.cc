#include <datasets/surface/surface_reader.h>

#include <datasets/system/error.h>
#include <tests/datasets/example_surfaces.h>
#include <tests/datasets/temporary_folder.h>

#include <limits>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    using std::numbers::pi;

    ClosedSurface read(const std::string &name, const std::string &content, const double unit_m = 1.,
                       const SurfaceUse use = SurfaceUse::body)
    {
      const TemporaryFolder folder;
      return read_closed_surface(folder.write(name, content), unit_m, use);
    }

    void expect_refused(const std::string &name, const std::string &content, const std::string &part,
                        const SurfaceUse use = SurfaceUse::body)
    {
      expect_in(message_of<InputError>([&] { read(name, content, 1., use); }), part);
    }
    void expect_refused(const ExampleSurface &surface, const std::string &part, const SurfaceUse use = SurfaceUse::body)
    {
      expect_refused("surface.stl", stl_text(surface), part, use);
    }

    const ExampleSurface box = example_box({2., 3., 4.}, 2);
  } // namespace

  TEST(SurfaceReader, ReadsEveryFormatAlike)
  {
    for (const auto &[name, content] : std::vector<std::pair<std::string, std::string>>{{"a.stl", stl_text(box)},
                                                                                        {"b.STL", stl_bytes(box)},
                                                                                        {"c.msh", msh_text(box)},
                                                                                        {"d.msh", msh41_text(box, 10)}})
    {
      const ClosedSurface surface = read(name, content, 1e-3);
      EXPECT_EQ(surface.faces.size(), box.faces.size()) << name;
      EXPECT_EQ(surface.nodes.size(), box.points.size() + box.faces.size() * 3 / 2) << name;
      const EnclosedVolume enclosed = enclosed_volume(surface);
      EXPECT_NEAR(enclosed.volume_m3, 24e-9, 1e-20) << name;
      EXPECT_NEAR(enclosed.center_m.norm(), 0., 1e-15) << name;
      EXPECT_FALSE(surface.is_curved);
      EXPECT_EQ(surface.sha256.size(), 64u);
    }
  }

  TEST(SurfaceReader, NamesPatchesByPhysicalSurfaces)
  {
    const ClosedSurface surface = read("d.msh", msh41_text(box, 10));
    EXPECT_EQ(surface.patches, (std::vector<std::string>{"sides", "open"}));
    EXPECT_EQ(std::count(surface.patch_of_face.begin(), surface.patch_of_face.end(), 0u), 10);
    EXPECT_EQ(read("c.msh", msh_text(box)).patches, std::vector<std::string>{"outer"});
  }

  TEST(SurfaceReader, VolumeAndMomentsOfABoxAreExact)
  {
    const EnclosedVolume of = enclosed_volume(read("a.stl", stl_text(box.moved({5., 6., 7.}))));
    EXPECT_NEAR(of.volume_m3, 24., 1e-12);
    EXPECT_NEAR((of.center_m - Eigen::Vector3d(5., 6., 7.)).norm(), 0., 1e-12);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(of.second_moment_m5(c, c), 24. * (c + 2.) * (c + 2.) / 12., 1e-10);
    EXPECT_NEAR(of.second_moment_m5(0, 1), 0., 1e-10);
  }

  TEST(SurfaceReader, CurvedTrianglesOfASphereConvergeWithOrderFour)
  {
    double error[2];
    for (int n = 1; n <= 2; ++n)
    {
      const ClosedSurface sphere = read("s.msh", msh_text(example_sphere(n, 1., true)));
      EXPECT_TRUE(sphere.is_curved);
      error[n - 1] = std::abs(enclosed_volume(sphere).volume_m3 / (4. * pi / 3.) - 1.);
      EXPECT_NEAR(enclosed_volume(sphere).second_moment_m5(2, 2) / (4. * pi / 15.), 1., 10. * error[n - 1]);
    }
    EXPECT_GT(error[0] / error[1], 12.);
    EXPECT_LT(error[1], 1e-3);
  }

  TEST(SurfaceReader, MendsOrientationAndRounding)
  {
    ExampleSurface turned = box;
    for (std::size_t f = 0; f < turned.faces.size(); f += 3)
      std::swap(turned.faces[f][0], turned.faces[f][1]);
    EXPECT_NEAR(enclosed_volume(read("a.stl", stl_text(turned))).volume_m3, 24., 1e-12);
    ExampleSurface inside_out = box;
    for (auto &face : inside_out.faces)
      std::swap(face[0], face[1]);
    EXPECT_NEAR(enclosed_volume(read("a.stl", stl_text(inside_out))).volume_m3, 24., 1e-12);
    std::string text = stl_text(box); // as programs write it that round each triangle by itself
    text.replace(text.find("vertex -1 -1.5 -2"), 17, "vertex -1.000001 -1.5 -2");
    EXPECT_EQ(read("a.stl", text).faces.size(), box.faces.size());
  }

  TEST(SurfaceReader, RefusesSurfacesThatEncloseNothing)
  {
    ExampleSurface open = box;
    open.faces.erase(open.faces.begin() + 5);
    expect_refused(open,
                   "surface.stl: it is not closed: 3 of its edges belong to one triangle alone, the first from (");
    ExampleSurface with_wall = box;
    with_wall.faces.push_back({box.faces[0][0], box.faces[0][1], box.faces[20][2]});
    expect_refused(with_wall, "belongs to more than two triangles (up to 3), the first from (");
    ExampleSurface twice = box;
    twice.faces.push_back(box.faces[3]);
    expect_refused(twice, "3 of its edges belong to more than two triangles");
    ExampleSurface flat = box;
    flat.points.push_back({0., 0., 0.});
    flat.faces.push_back({0, 1, 1});
    expect_refused(flat, "1 of its 49 triangles has no area, the first at (");
    expect_refused("s.stl", stl_text({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}), "s.stl: ");
    ExampleSurface touching = box;
    touching.add(box.moved({2., 3., 4.}));
    expect_refused(touching, "it touches itself at 1 point, the first (1, 1.5, 2)");
  }

  TEST(SurfaceReader, RefusesSurfacesThatGoThroughThemselves)
  {
    ExampleSurface crossing = box;
    crossing.add(box.moved({.7, .4, .3}));
    expect_refused(crossing, "it goes through itself: ");
    ExampleSurface face_on_face = example_box({1., 1., 1.});
    face_on_face.add(example_box({.5, .5, .5}).moved({.75, .1, .1}));
    expect_refused(face_on_face, "it goes through itself: ");
    ExampleSurface pierced = example_sphere(2, 1., true);
    pierced.points[0]      = {-2. * pierced.points[0][0], -2. * pierced.points[0][1], -2. * pierced.points[0][2]};
    expect_refused("s.msh", msh_text(pierced), "it goes through itself: ");
  }

  TEST(SurfaceReader, RefusesSliversThatNoMeshCanBeMadeOf)
  {
    // Right triangles with legs in a ratio of n: of quality sqrt(3) n / (n^2 + 1).
    const auto needle = [](const double n) { return example_box({n, 1., 1.}); };
    EXPECT_NO_THROW(read("box.stl", stl_text(needle(340.))));
    expect_refused(needle(1000.), "8 of its 12 triangles are thinner than a mesh can be made of: quality 0.0017 (1: "
                                  "equilateral) at (");
    expect_refused(needle(1000.), "at least 0.005 is needed; remesh the surface");
  }

  TEST(SurfaceReader, KnowsPartsWithinOthers)
  {
    ExampleSurface nested = example_box({4., 4., 4.}, 2);
    nested.add(example_box({1., 1., 1.}));
    expect_refused(nested, "is inside another one; a body's cavities are not met by the fluid");
    const EnclosedVolume fluid = enclosed_volume(read("w.stl", stl_text(nested), 1., SurfaceUse::walls));
    EXPECT_NEAR(fluid.volume_m3, 63., 1e-12);
    ExampleSurface apart = box;
    apart.add(box.moved({10., 0., 0.}));
    EXPECT_NEAR(enclosed_volume(read("w.stl", stl_text(apart))).volume_m3, 48., 1e-12);
    expect_refused(apart, "it bounds 2 rooms that are apart", SurfaceUse::walls);
  }

  TEST(SurfaceReader, RefusesWhatIsNoSurface)
  {
    expect_in(message_of<InputError>([] { read_closed_surface("/nowhere/helix.stl", 1., SurfaceUse::body); }),
              "cannot read the surface /nowhere/helix.stl");
    expect_refused("s.stl", "version https://git-lfs.github.com/spec/v1\noid sha256:12\nsize 3\n", "git lfs pull");
    expect_refused("s.stl", "<!DOCTYPE html><html>no</html>", "web page (HTML)");
    expect_refused("s.stl", "v 0 0 0\n", "it is no STL, but a text that begins with \"v 0 0 0\"");
    expect_refused("s.stl", std::string("\0\1\2", 3), "it ends within the header of 84 bytes");
    expect_refused("s.obj", "v 0 0 0\n", "neither STL (.stl) nor a mesh of gmsh (.msh)");
    expect_refused("s.msh", stl_text(box), "it is no file of gmsh");
    expect_refused("s.stl", "solid empty\nendsolid empty\n", "it holds no triangles");
    expect_refused("s.stl", stl_bytes(box).substr(0, 1000), "2484 bytes were to come, and the file has 1000");
    expect_refused("s.stl", stl_text(box).substr(0, 900),
                   "the file ends here, in mid-surface; copy or export it again");
    expect_refused("s.stl", stl_text(box).substr(0, stl_text(box).find("endsolid")),
                   "it is cut off; copy or export it again");
    ExampleSurface not_a_number = box;
    not_a_number.points[3][1]   = std::numeric_limits<double>::quiet_NaN();
    expect_refused("s.stl", stl_bytes(not_a_number), "which is no point");
    expect_refused("s.stl", stl_text(not_a_number), "a coordinate is \"nan\"");
    std::string comma = stl_text(box);
    comma.replace(comma.find("-1.5"), 4, "-1,5");
    expect_refused("s.stl", comma, "line 4: \"-1,5\" is not a number (decimals take a point)");
  }

  TEST(SurfaceReader, RefusesFilesOfGmshThatDoNotHoldIt)
  {
    std::string text = msh_text(box);
    expect_refused("s.msh", text.substr(0, 200), "the file ends here, in mid-surface");
    const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";
    expect_refused("s.msh", head, "it has no mesh, or is cut off");
    expect_refused("s.msh", head + "$Elements\n1\n1 1 2 0 1 1 2\n$EndElements\n",
                   "it holds no triangles; mesh the surface");
    expect_refused("s.msh", head + "$Elements\n1\n1 3 2 0 1 1 2 3 1\n$EndElements\n", "there are quadrangles");
    expect_refused("s.msh", head + "$Elements\n1\n1 2 2 0 1 1 2 4\n$EndElements\n",
                   "has node 4, which is not among $Nodes");
    expect_refused("s.msh", "$MeshFormat\n4.1 1 8\n", "it is written in bytes; save it as text");
    expect_refused("s.msh", "$MeshFormat\n4 0 8\n", "it is of gmsh's format 4; save it in 4.1 or 2.2");
  }
} // namespace swimtwin
