#include <datasets/surface/elastic_part.h>

#include <datasets/surface/surface_reader.h>
#include <datasets/system/error.h>
#include <tests/datasets/example_scenes.h>
#include <tests/datasets/example_surfaces.h>
#include <tests/datasets/temporary_folder.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    /// A body whose tail is where the middles of its triangles are asked for, the rest is its head.
    template <typename IsTail>
    ClosedSurface read_body(ExampleSurface body, const IsTail &is_tail)
    {
      const TemporaryFolder folder;
      const std::size_t     first = sort_tail_last(body, is_tail);
      return read_closed_surface(folder.write("body.msh", msh41_text(body, first, {"head", "tail"})), 1.,
                                 SurfaceUse::body);
    }

    template <typename IsTail>
    void expect_refused(const ExampleSurface &body, const IsTail &is_tail, const std::string &part)
    {
      const ClosedSurface surface = read_body(body, is_tail);
      expect_in(message_of<InputError>([&] { elastic_part(surface, "tail"); }), part);
    }

    /// With triangles of order 2.
    ExampleSurface with_middles(ExampleSurface surface)
    {
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> middle;
      for (auto &face : surface.faces)
        for (int v = 0; v < 3; ++v)
        {
          const auto [a, b]          = std::minmax(face[v], face[(v + 1) % 3]);
          const auto [entry, is_new] = middle.try_emplace({a, b}, surface.points.size());
          if (is_new)
          {
            auto x = surface.points[a];
            for (int c = 0; c < 3; ++c)
              x[c] = .5 * (x[c] + surface.points[b][c]);
            surface.points.push_back(x);
          }
          face.push_back(entry->second);
        }
      return surface;
    }

    const ExampleSurface long_box = example_box({4., 1., 2.}, 4); // from -2 to 2 along x, in steps of 1

    const auto behind = [](const std::array<double, 3> &x) { return x[0] > 1.; };
  } // namespace

  TEST(ElasticPart, BothPartsEncloseWhatTheyShould)
  {
    const ClosedSurface body = read_body(long_box, behind);
    const ElasticPart   part = elastic_part(body, "tail");
    EXPECT_EQ(part.rim.size(), 32u); // of 16 edges
    const EnclosedVolume tail = enclosed_volume(closed_part(body, part, true)),
                         head = enclosed_volume(closed_part(body, part, false));
    EXPECT_NEAR(tail.volume_m3, 2., 1e-13);
    EXPECT_NEAR(head.volume_m3, 6., 1e-13);
    EXPECT_LE((tail.center_m - Eigen::Vector3d(1.5, 0., 0.)).norm(), 1e-13);
    EXPECT_LE((head.center_m - Eigen::Vector3d(-.5, 0., 0.)).norm(), 1e-13);
    EXPECT_NEAR(head.second_moment_m5(0, 0), 6. * 9. / 12., 1e-13);
    EXPECT_NEAR(head.second_moment_m5(2, 2), 6. * 4. / 12., 1e-13);
  }

  // Curved triangles, and a rim that a fan around its middle does not see all of.
  TEST(ElasticPart, VolumesOfPartsAddUp)
  {
    ExampleSurface bent = with_middles(example_box({4., 1., 2.}, 4));
    for (auto &x : bent.points)
      x = {x[0], x[1] + 2. * x[2] * x[2], x[2]};
    const ClosedSurface body = read_body(bent, [](const std::array<double, 3> &x) { return x[0] > 0.; });
    EXPECT_TRUE(body.is_curved);
    const ElasticPart part = elastic_part(body, "tail");
    const double      tail = enclosed_volume(closed_part(body, part, true)).volume_m3,
                 head      = enclosed_volume(closed_part(body, part, false)).volume_m3,
                 all       = enclosed_volume(body).volume_m3;
    EXPECT_NEAR(tail + head, all, 1e-12);
    EXPECT_NEAR(tail, head, 1e-12); // its own mirror image
  }

  TEST(ElasticPart, WhatIsNoTailIsRefusedInASentence)
  {
    const auto named = [](const ExampleSurface &body, const std::array<std::string, 2> &names,
                          const std::size_t first) {
      const TemporaryFolder folder;
      return read_closed_surface(folder.write("body.msh", msh41_text(body, first, names)), 1., SurfaceUse::body);
    };
    const ClosedSurface nameless = named(long_box, {"head", "flagellum"}, 100);
    expect_in(
        message_of<InputError>([&] { elastic_part(nameless, "tail"); }),
        "body.msh: it has no physical surface named \"tail\", only \"head\", \"flagellum\"; name the elastic part");
    const ClosedSurface all = named(long_box, {"tail", "head"}, long_box.faces.size());
    expect_in(message_of<InputError>([&] { elastic_part(all, "tail"); }), "all of it is \"tail\"; leave a part of it");
    expect_refused(
        long_box, [](const std::array<double, 3> &x) { return std::abs(x[0]) < 1.; }, "has several rims");
    expect_refused(
        long_box, [](const std::array<double, 3> &x) { return x[0] < -1.; },
        "lies before its rim; turn the body so that the tail points along +x");
    expect_refused(
        long_box, [](const std::array<double, 3> &x) { return x[1] > .49; }, "leaves the plane across x by 2 m");
    ExampleSurface two = long_box;
    two.add(example_box({1., 1., 1.}, 1).moved({4., 0., 0.}));
    expect_refused(
        two, [](const std::array<double, 3> &x) { return x[0] > 3.; },
        "is a piece of its own, which nothing holds; join it to the head");
    expect_refused(two, behind, "has a piece of its own, which nothing holds; join it to the head");
  }
} // namespace swimtwin
