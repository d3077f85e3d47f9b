#include <fom/mesh/swimmer_outline.h>

#include <fom/geometry/reflection.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    SwimmerOutline outline_of(const Scene &scene)
    {
      return make_outline(scene.head, scene.tail, scene.numerics);
    }

    const std::vector<std::string> swimmers = {
        "reference-2d-casefile", "annulus", "rigid-swimmer",        "rotating-disc",
        "passive-tail-channel",  "csm1",    "magnetised-cantilever"};
    constexpr double rounding_of_lengths = 1e-14; // of lengths of some mm up to 0.6 m
  }                                               // namespace

  TEST(SwimmerOutline, ReferenceTipIsAtTheCaseFilesPlace)
  {
    const auto outline = outline_of(shipped_scene("reference-2d-casefile"));
    EXPECT_NEAR(outline.tip()[0], 7.75e-3, 1e-17);
    EXPECT_EQ(outline.tip()[1], 0.);
  }

  TEST(SwimmerOutline, SurfaceIsItsOwnMirrorImage)
  {
    for (const auto &name : swimmers)
    {
      const auto         surface = outline_of(shipped_scene(name)).surface();
      const unsigned int n       = surface.size();
      EXPECT_EQ(n % 2, 0u);
      for (unsigned int k = 0; k < n; ++k)
        EXPECT_EQ(surface[k], mirrored(surface[(n - k) % n])) << name << " node " << k;
    }
  }

  TEST(SwimmerOutline, SurfaceIsWalkedCounterClockwise)
  {
    for (const auto &name : swimmers)
    {
      const auto surface = outline_of(shipped_scene(name)).surface();
      double     area    = 0.;
      for (unsigned int k = 0; k < surface.size(); ++k)
      {
        const auto &a = surface[k], &b = surface[(k + 1) % surface.size()];
        area += a[0] * b[1] - a[1] * b[0];
      }
      EXPECT_GT(area, 0.) << name;
    }
  }

  // Head: rectangle 0.5 x 1.5 mm. Tail: y = 0.75 mm at x = 0.25 mm to 0.1 mm at 7.65 mm, then a circle of 0.1 mm.
  TEST(SwimmerOutline, NodesLieOnTheReferenceShape)
  {
    const auto surface = outline_of(shipped_scene("reference-2d-casefile")).surface();
    for (const auto &x : surface)
    {
      const double y = std::abs(x[1]);
      if (x[0] < 0.25e-3 - rounding_of_lengths) // nose, or upper and lower side of the head
        EXPECT_TRUE(std::abs(x[0] + 0.25e-3) < 1e-17 || std::abs(y - 0.75e-3) < 1e-17) << x;
      else if (x[0] <= 7.65e-3)
        EXPECT_NEAR(y, 0.75e-3 + (0.1e-3 - 0.75e-3) * (x[0] - 0.25e-3) / 7.4e-3, 1e-17) << x;
      else
        EXPECT_NEAR(x.distance({7.65e-3, 0.}), 0.1e-3, 1e-17) << x;
    }
  }

  TEST(SwimmerOutline, NodesLieOnDiscsAndEllipses)
  {
    for (const auto &x : outline_of(shipped_scene("rotating-disc")).surface())
      EXPECT_NEAR(x.norm(), 1e-3, 1e-17);
    for (const auto &x : outline_of(shipped_scene("rigid-swimmer")).surface())
      EXPECT_NEAR(std::hypot(x[0] / 2e-3, x[1] / 0.5e-3), 1., 1e-14);
  }

  // The size field is sampled in 4000 pieces per curve: edges may exceed it by that rounding_of_lengths, and by its
  // growth along them (a graded edge is longer than the field at its finer end); compared with the larger end it never
  // is.
  TEST(SwimmerOutline, NoEdgeIsLongerThanTheSizeFieldAsks)
  {
    for (const auto &name : swimmers)
    {
      const auto         outline = outline_of(shipped_scene(name));
      const auto         surface = outline.surface();
      const unsigned int n       = surface.size();
      for (unsigned int k = 0; k < n; k += 2)
      {
        const auto &a = surface[k], &b = surface[(k + 2) % n];
        EXPECT_LE(a.distance(b), std::max(outline.size(a), outline.size(b)) * (1. + 1e-3)) << name << " at " << a;
      }
    }
  }

  TEST(SwimmerOutline, MidpointsHalveTheArcOfTheirEdge)
  {
    for (const auto &name : swimmers)
    {
      const auto         surface = outline_of(shipped_scene(name)).surface();
      const unsigned int n       = surface.size();
      for (unsigned int k = 0; k < n; k += 2)
      {
        const double to = surface[k].distance(surface[k + 1]), from = surface[k + 1].distance(surface[(k + 2) % n]);
        EXPECT_NEAR(to / from, 1., 2e-2) << name << " at "
                                         << surface[k]; // chords of equal arcs on curves of varying curvature
      }
    }
  }

  TEST(SwimmerOutline, RootLiesOnTheHead)
  {
    const auto scene = shipped_scene("csm1");
    const auto root  = outline_of(scene).upper_root;
    EXPECT_EQ(root.front()[1], 0.);
    EXPECT_NEAR(root.back()[1], 0.01, rounding_of_lengths);
    for (const auto &x : root)
      EXPECT_NEAR(x.norm(), 0.05, rounding_of_lengths);
  }
} // namespace swimtwin
