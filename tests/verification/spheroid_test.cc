// A prolate spheroid in an unbounded fluid: force and torque with the exact flow on the outer boundary, and how it
// turns in a shear flow.
#include <fom/body/mesh_around.h>
#include <fom/step/full_order_model.h>
#include <fom/unknowns/condensation.h>
#include <tests/fom/shipped_scene.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;
    using std::numbers::pi;

    enum class Motion { along, across, turning }; // of U along x, U along y, omega about z

    Tensor<1, 3> rigid_velocity(const Motion motion, const Point<3> &x)
    {
      if (motion == Motion::turning)
        return Tensor<1, 3>({-x[1], x[0], 0.});
      return Tensor<1, 3>({motion == Motion::along ? 1. : 0., motion == Motion::across ? 1. : 0., 0.});
    }

    /// A. T. Chwang, T. Y.-T. Wu, J. Fluid Mech. 63 (1974), 607 and 67 (1975), 787: singularities on the line between
    /// the foci, here with strengths that fit the body's velocity on its surface. Half length 1, viscosity 1.
    class SpheroidFlow
    {
    public:
      SpheroidFlow(const double radius, const Motion motion)
          : motion_(motion), c_(std::sqrt(1. - radius * radius)), strength_(n_singularities())
      {
        const int          n = n_singularities();
        FullMatrix<double> normal(n, n);
        Vector<double>     rhs(n);
        const auto         each_on_surface = [&](const auto &act) {
          for (int i = 1; i < 40; ++i)
            for (const double angle : {0., .7, 2., 3.})
            {
              const double t = pi * i / 40.;
              act(Point<3>(std::cos(t), radius * std::sin(t) * std::cos(angle),
                           radius * std::sin(t) * std::sin(angle)));
            }
        };
        each_on_surface([&](const Point<3> &x) {
          const auto basis = flows(x);
          for (int i = 0; i < n; ++i)
          {
            rhs(i) += basis[i] * rigid_velocity(motion, x);
            for (int j = 0; j < n; ++j)
              normal(i, j) += basis[i] * basis[j];
          }
        });
        normal.gauss_jordan();
        normal.vmult(strength_, rhs);
        each_on_surface(
            [&](const Point<3> &x) { misfit_ = std::max(misfit_, (velocity(x) - rigid_velocity(motion, x)).norm()); });
      }

      Tensor<1, 3> velocity(const Point<3> &x) const
      {
        const auto   basis = flows(x);
        Tensor<1, 3> u;
        for (int i = 0; i < n_singularities(); ++i)
          u += strength_(i) * basis[i];
        return u;
      }
      /// Largest difference to the body's velocity on its surface.
      double misfit() const { return misfit_; }
      /// Of the body on the fluid: of Stokeslets 8 pi mu, of rotlets 8 pi mu times their strength.
      double load() const
      {
        return 8. * pi * strength_(0) * (motion_ == Motion::turning ? 4. * std::pow(c_, 3) / 3. : 2. * c_);
      }

    private:
      int n_singularities() const { return motion_ == Motion::turning ? 3 : 2; }

      std::vector<Tensor<1, 3>> flows(const Point<3> &x) const
      {
        static const QGauss<1>    rule(120);
        std::vector<Tensor<1, 3>> sum(n_singularities());
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double       xi = c_ * (2. * rule.point(q)[0] - 1.), weight = 2. * c_ * rule.weight(q);
          const Tensor<1, 3> r = x - Point<3>(xi, 0., 0.);
          const double       R = r.norm(), R3 = R * R * R, R5 = R3 * R * R, g = c_ * c_ - xi * xi;
          if (motion_ == Motion::turning)
          {
            sum[0] += weight * g / R3 * Tensor<1, 3>({-r[1], r[0], 0.}); // rotlet about z
            sum[1] += weight * g * 3. * r[0] * r[1] / R5 * r;            // stresslet
            Tensor<1, 3> slope = -15. * r[0] * r[1] / (R5 * R * R) * r;  // d/dy of a doublet along x
            slope[0] += 3. * r[1] / R5;
            slope[1] += 3. * r[0] / R5;
            sum[2] += weight * g * g * slope;
          }
          else
          {
            const int    c = motion_ == Motion::along ? 0 : 1;
            Tensor<1, 3> unit;
            unit[c] = 1.;
            sum[0] += weight * (unit / R + r[c] / R3 * r);
            sum[1] += weight * g * (3. * r[c] / R5 * r - unit / R3);
          }
        }
        return sum;
      }

      Motion         motion_;
      double         c_; ///< foci
      Vector<double> strength_;
      double         misfit_ = 0.;
    };

    Scene spheroid_in_sphere(const double radius, const double outer, const double mesh_size)
    {
      return shipped_scene(
          "spheroid-in-shear",
          {override_entry("domain.radius_m", outer), "head.size_m=[2.0, " + std::to_string(2. * radius) + "]",
           override_entry("numerics.mesh_size_m", mesh_size), override_entry("numerics.mesh_size_corner_m", mesh_size),
           override_entry("numerics.mesh_size_far_m", .3 * outer), "numerics.mesh_growth=0.3"});
    }

    struct Loads
    {
      double       force_x = 0., force_y = 0., torque = 0.;
      unsigned int n_unknowns = 0;
    };

    /// With these velocities on both boundaries; loads of the body on the fluid by reaction.
    Loads loads_in(const FluidDomain<3> &fluid, const SpheroidFlow &exact, const Motion motion)
    {
      MotionMap<3> map(fluid.n_rows(), 0, 1.);
      fluid.describe(map, true);
      for (const auto node : fluid.fluid_mesh().surface_nodes)
        for (int c = 0; c < 3; ++c)
          map.impose(fluid.numbering().vector_index(node, c));
      fluid.describe_mirror(map);
      map.close(std::vector<unsigned int>(map.n_rows(), 0), false, MPI_COMM_WORLD);
      const auto set = [&](const unsigned int node, const Tensor<1, 3> &v) {
        for (int c = 0; c < 3; ++c)
          map.imposed[fluid.numbering().vector_index(node, c)] = v[c];
      };
      for (const auto node : fluid.fluid_mesh().surface_nodes)
        set(node, rigid_velocity(motion, fluid.positions()[node]));
      for (const auto &wall_node : fluid.fluid_mesh().wall_nodes)
        set(wall_node.node, exact.velocity(fluid.positions()[wall_node.node]));

      Condensation<3> condensation(map);
      LinearSystem    system(MPI_COMM_WORLD, {.tolerance = 1e-10, .symmetric = true});
      fluid.add_cells(condensation);
      condensation.lay_out(system);
      condensation.reset();
      fluid.assemble(condensation);
      system.set_matrix(condensation.values());
      system.set_right_hand_side(condensation.right_hand_side());
      std::vector<double> unknowns(map.n_unknowns(), 0.);
      EXPECT_TRUE(system.solve(unknowns));
      auto values = map.expand(unknowns);
      values.resize(fluid.n_rows());
      const auto force = fluid.react(values).force;
      Loads      loads;
      loads.n_unknowns = map.n_unknowns();
      for (unsigned int k = 0; k < fluid.n_surface_nodes(); ++k)
      {
        const auto  &x  = fluid.positions()[fluid.fluid_mesh().surface_nodes[k]];
        const double fx = force[fluid.surface_row(k, 0)], fy = force[fluid.surface_row(k, 1)];
        loads.force_x += fx;
        loads.force_y += fy;
        loads.torque += x[0] * fy - x[1] * fx;
      }
      return loads;
    }
  } // namespace

  TEST(Spheroid, SingularitiesOfChwangAndWuAreItsFlow)
  {
    for (const double radius : {.5, .2})
    {
      const double       e = std::sqrt(1. - radius * radius), L = std::log((1. + e) / (1. - e)), e3 = e * e * e;
      const SpheroidFlow along(radius, Motion::along), across(radius, Motion::across), turning(radius, Motion::turning);
      for (const auto *flow : {&along, &across, &turning})
        EXPECT_LE(flow->misfit(), 1e-9) << radius;
      EXPECT_NEAR(along.load(), 16. * pi * e3 / ((1. + e * e) * L - 2. * e), 1e-8);
      EXPECT_NEAR(across.load(), 32. * pi * e3 / (2. * e + (3. * e * e - 1.) * L), 1e-8);
      EXPECT_NEAR(turning.load(), 32. / 3. * pi * e3 * (2. - e * e) / ((1. + e * e) * L - 2. * e), 1e-8);
    }
  }

  TEST(Spheroid, DragAndTorqueAreThoseOfAnUnboundedFluid)
  {
    const std::pair<double, double> shapes[] = {{.5, .11}, {.2, .045}}; // radius, mesh size
    for (const auto &[radius, mesh_size] : shapes)
    {
      const Scene          scene = spheroid_in_sphere(radius, 2., mesh_size);
      const Swimmer<3>     swimmer(scene, MPI_COMM_WORLD);
      const auto           rest = swimmer.configuration_at_rest();
      const FluidDomain<3> fluid(scene, mesh_around(swimmer, rest, MPI_COMM_WORLD), rest.pose);
      const auto           error = [&](const Motion motion, const auto load) {
        const SpheroidFlow exact(radius, motion);
        const Loads        loads = loads_in(fluid, exact, motion);
        const double       off   = loads.*load / exact.load() - 1.;
        std::cout << "spheroid " << 1. / radius << ":1, " << loads.n_unknowns << " unknowns, off by " << off
                  << std::endl;
        return std::abs(off);
      };
      EXPECT_LE(error(Motion::along, &Loads::force_x), 3e-3);
      EXPECT_LE(error(Motion::across, &Loads::force_y), 3e-3);
      EXPECT_LE(error(Motion::turning, &Loads::torque), 3e-3);
    }
  }

  // G. B. Jeffery, Proc. R. Soc. A 102 (1922): the time between half turns is pi (r + 1/r) over the shear rate. At the
  // start the spheroid lies along the flow.
  TEST(Spheroid, TurnsInAShearFlowAsJefferyFound)
  {
    const Scene       scene = shipped_scene("spheroid-in-shear",
                                            {"time.steps=60", "numerics.mesh_size_m=1.6e-4", "numerics.mesh_growth=0.35"});
    FullOrderModel<3> model(scene, MPI_COMM_WORLD);
    double            time_s = 0., angle = 0., largest = 0.;
    for (int step = 0; step < scene.time.n_steps() && angle > -2. * pi; ++step)
    {
      const double angle_before = angle, time_before = model.now().time_s;
      model.advance();
      angle += std::remainder(model.now().configuration.pose.heading() - angle, 2. * pi);
      // tan(angle) = -tan(t r / (r^2 + 1)) / r, with r = 2
      const double phase = model.now().time_s * 2. / 5., exact = -std::atan2(std::sin(phase) / 2., std::cos(phase));
      largest = std::max(largest, std::abs(std::remainder(angle - exact, 2. * pi)));
      time_s  = time_before +
               (model.now().time_s - time_before) * std::min(1., (2. * pi + angle_before) / (angle_before - angle));
    }
    // What is left to a whole turn passes at the angle's exact rate along the flow.
    const double turn_s = time_s + std::max(0., 2. * pi + angle) * 5.;
    const double exact  = 2. * pi * (2. + .5);
    std::cout << "spheroid in shear: a turn takes " << turn_s / exact - 1. << " longer than Jeffery's, angle off by "
              << largest << ", " << model.n_unknowns() << " unknowns, " << model.counts().n_steps << " steps, "
              << model.coupling().counts().n_iterations << " iterations" << std::endl;
    EXPECT_NEAR(turn_s, exact, 5e-3 * exact);
    // What so much more time makes where it turns fastest, at r^2 / (r^2 + 1).
    EXPECT_LE(largest, 5e-3 * exact * .8);
  }
} // namespace swimtwin
