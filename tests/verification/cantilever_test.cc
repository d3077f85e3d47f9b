// A magnetised cantilever in a uniform field against the elastica.
#include <fom/step/full_order_model.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    using std::numbers::pi;

    struct Tip
    {
      double angle_rad, x, y; ///< place in lengths, from the root
    };

    constexpr double group = 6.4, field_angle = 120. * pi / 180.;
    /// Published: tip angle 98.636 degrees, tip at (0.29063, 0.83419) L.
    constexpr Tip published = {98.636 * pi / 180., 0.29063, 0.83419};

    /// Inextensible rod of length 1, angle t(s): t'' + group sin(field_angle - t) = 0, t(0) = 0, t'(1) = 0.
    struct RodState
    {
      double angle, curvature, x, y;
    };
    RodState operator+(const RodState &a, const RodState &b)
    {
      return {a.angle + b.angle, a.curvature + b.curvature, a.x + b.x, a.y + b.y};
    }
    RodState operator*(const double f, const RodState &a)
    {
      return {f * a.angle, f * a.curvature, f * a.x, f * a.y};
    }
    RodState slope(const RodState &r)
    {
      return {r.curvature, -group * std::sin(field_angle - r.angle), std::cos(r.angle), std::sin(r.angle)};
    }

    /// Classical Runge-Kutta from the clamp with a curvature there.
    RodState shoot(const double curvature_at_clamp)
    {
      constexpr int    n = 1000;
      constexpr double h = 1. / n;
      RodState         r = {0., curvature_at_clamp, 0., 0.};
      for (int i = 0; i < n; ++i)
      {
        const RodState k1 = slope(r), k2 = slope(r + .5 * h * k1), k3 = slope(r + .5 * h * k2), k4 = slope(r + h * k3);
        r = r + h / 6. * (k1 + 2. * k2 + 2. * k3 + k4);
      }
      return r;
    }

    Tip elastica()
    {
      double low  = 0.,
             high = std::sqrt(2. * group * (1. - std::cos(field_angle))); // the rod that reaches the field's angle
      for (int i = 0; i < 60; ++i)
      {
        const double middle                         = .5 * (low + high);
        (shoot(middle).curvature > 0. ? high : low) = middle;
      }
      const RodState tip = shoot(low);
      return {tip.angle, tip.x, tip.y};
    }

    template <int dim>
    Tip tip_at_full_field(const Scene &scene)
    {
      FullOrderModel<dim> model(scene, MPI_COMM_WORLD);
      for (int step = 0; step < scene.time.n_steps(); ++step)
        model.advance();
      const auto  &configuration = model.now().configuration;
      const auto   tip           = model.swimmer().tail_positions(configuration)[model.swimmer().tail().axis_at_tip[2]];
      const double root = scene.head.size_m[0] / 2, length = scene.tail->length_m;
      const Tip    result = {model.swimmer().tail_angle(configuration), (tip[0] - root) / length, tip[1] / length};
      std::cout << "cantilever in " << dim << "D, h/L = " << scene.tail->root_height_m / length << ": tip angle "
                << result.angle_rad * 180. / pi << " degrees at (" << result.x << ", " << result.y << ") L, "
                << model.n_unknowns() << " unknowns" << std::endl;
      return result;
    }

    /// The shipped beam with another thickness, its stiffness scaled to keep the group.
    Tip finite_element_beam(const double slenderness)
    {
      const Scene              shipped = shipped_scene("magnetised-cantilever");
      const double             length = shipped.tail->length_m, height = slenderness * length;
      const double             shipped_h = shipped.tail->root_height_m, ratio = height / shipped_h;
      std::vector<std::string> overrides;
      if (ratio != 1.)
        overrides = {
            override_entry("tail.root_height_m", height),
            override_entry("tail.tip_height_m", height),
            override_entry("tail.young_modulus_Pa", shipped.tail->young_modulus_Pa / (ratio * ratio)),
            "head.size_m=[0.5e-3, 1e-3]",
            override_entry("numerics.mesh_size_m", shipped.numerics.mesh_size_m * std::min(ratio, 3.)),
            override_entry("numerics.mesh_size_corner_m", shipped.numerics.mesh_size_corner_m * std::min(ratio, 3.)),
            override_entry("numerics.mesh_size_far_m", shipped.numerics.mesh_size_far_m * std::min(ratio, 3.))};
      return tip_at_full_field<2>(shipped_scene("magnetised-cantilever", overrides));
    }

    double distance(const Tip &a, const Tip &b)
    {
      return std::hypot(a.x - b.x, a.y - b.y);
    }
  } // namespace

  // Half a unit in the last published digit.
  TEST(Cantilever, ShootingConfirmsThePublishedElastica)
  {
    const Tip tip = elastica();
    std::cout << "elastica: " << tip.angle_rad * 180. / pi << " degrees at (" << tip.x << ", " << tip.y << ") L"
              << std::endl;
    EXPECT_NEAR(tip.angle_rad * 180. / pi, 98.636, 6e-4);
    EXPECT_NEAR(tip.x, published.x, 6e-6);
    EXPECT_NEAR(tip.y, published.y, 6e-6);
  }

  TEST(Cantilever, SlenderBeamFollowsTheElastica)
  {
    const Tip exact = elastica(), beam = finite_element_beam(0.02);
    EXPECT_NEAR(beam.angle_rad, exact.angle_rad, 0.01 * exact.angle_rad);
    EXPECT_NEAR(beam.x, exact.x, 0.01 * exact.x);
    EXPECT_NEAR(beam.y, exact.y, 0.01 * exact.y);
  }

  // Extension and shear, relative to bending, go with (h/L)^2 and the clamp's restraint of the cross-section with h/L
  // at most: the distance to the elastica falls at least in proportion to h/L.
  TEST(Cantilever, BeamApproachesTheElasticaAsItThins)
  {
    const Tip exact = elastica(), thick = finite_element_beam(0.1), medium = finite_element_beam(0.05),
              thin        = finite_element_beam(0.02);
    const double errors[] = {distance(thick, exact), distance(medium, exact), distance(thin, exact)};
    std::cout << "cantilever: tip is off the elastica's by " << errors[0] << ", " << errors[1] << ", " << errors[2]
              << " L; angle by " << thick.angle_rad - exact.angle_rad << ", " << medium.angle_rad - exact.angle_rad
              << ", " << thin.angle_rad - exact.angle_rad << " rad" << std::endl;
    EXPECT_LE(errors[1], errors[0] * 0.5);
    EXPECT_LE(errors[2], errors[1] * 0.4);
  }

  // A film, twice as wide as thick, h/L = 0.05 and without lateral contraction: 12 M B L^2 / (E h^2) = 6.4.
  TEST(Cantilever, FilmInSpaceFollowsTheElastica)
  {
    const double h     = 0.3e-3;
    const Tip    exact = elastica(),
              film     = tip_at_full_field<3>(
                  shipped_scene("magnetised-cantilever-3d",
                                    {"variant=quick", "head.size_m=[0.3e-3, 0.8e-3]", "tail.section=rectangular",
                                     override_entry("tail.width_m", 2. * h), override_entry("tail.root_height_m", h),
                                     override_entry("tail.tip_height_m", h), "tail.poisson_ratio=0.0",
                                     override_entry("tail.young_modulus_Pa", 12. * 1e3 * std::pow(6e-3 / h, 2) / group)}));
    EXPECT_NEAR(film.angle_rad, exact.angle_rad, 0.01 * exact.angle_rad);
    EXPECT_LE(distance(film, exact), 0.01);
  }

  // Its own weight bends a rod of circular section alike in every direction across it, on the half of a mesh or the
  // whole.
  TEST(Cantilever, WeightBendsARodAlikeInEveryDirection)
  {
    const auto end = [](const std::string &acceleration_m_s2) {
      const Scene       scene = shipped_scene("magnetised-cantilever-3d",
                                              {"variant=quick", "time.steps=4", "numerics.mesh_size_m=3e-4",
                                               "numerics.mesh_size_far_m=3e-4", "tail.magnetization_A_m=0",
                                               "gravity={acceleration_m_s2=" + acceleration_m_s2 + ", ramp_s=1}"});
      FullOrderModel<3> model(scene, MPI_COMM_WORLD);
      for (int step = 0; step < scene.time.n_steps(); ++step)
        model.advance();
      const unsigned int tip = model.swimmer().tail().axis_at_tip[2];
      return model.now().configuration.shape[tip] / scene.tail->length_m;
    };
    const auto along_y = end("[0, -25]"), along_z = end("[0, 0, -25]"), between = end("[0, -15, -20]");
    EXPECT_GT(-along_y[1], 0.1);
    EXPECT_EQ(along_y[2], 0.);
    EXPECT_NEAR(along_z[2], along_y[1], 2e-3);
    EXPECT_NEAR(along_z[1], 0., 2e-3);
    EXPECT_NEAR(between[1], 0.6 * along_y[1], 2e-3);
    EXPECT_NEAR(between[2], 0.8 * along_y[1], 2e-3);
    for (const auto &other : {along_z, between})
      EXPECT_NEAR(other[0], along_y[0], 2e-3);
  }

  // A rod of circular section, h/L = 0.05: as far off the elastica as a beam in the plane of that thickness.
  TEST(Cantilever, RodInSpaceFollowsTheElastica)
  {
    const Tip exact = elastica(),
              rod   = tip_at_full_field<3>(shipped_scene("magnetised-cantilever-3d", {"variant=quick"}));
    EXPECT_NEAR(rod.angle_rad, exact.angle_rad, 0.01 * exact.angle_rad);
    EXPECT_LE(distance(rod, exact), 0.01);
  }
} // namespace swimtwin
