// Turek-Hron with inertia: whole shipped scenes where they are quick, shrunk ones else (docs/benchmarks.md has the
// rest).
#include <fom/step/full_order_model.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    struct SteadyState
    {
      dealii::Tensor<1, 2> tip_mm;
      double               drag, lift; ///< N/m
      unsigned int         n_unknowns;
    };

    SteadyState steady_state(const std::string &name)
    {
      const Scene       scene = shipped_scene(name);
      FullOrderModel<2> model(scene, MPI_COMM_WORLD);
      model.advance();
      const auto &load = model.balance().load_of_fluid.force;
      std::cout << name << ": drag " << load[0] << ", lift " << load[1] << " N/m, " << model.n_unknowns() << " unknowns"
                << std::endl;
      return {1e3 * model.now().configuration.shape[model.swimmer().tail().axis_at_tip[2]], load[0], load[1],
              model.n_unknowns()};
    }

    void expect_close(const double value, const double reference, const double share)
    {
      EXPECT_NEAR(value, reference, share * std::abs(reference));
    }
  } // namespace

  TEST(TurekHron, Cfd1DragAndLift)
  {
    const SteadyState state = steady_state("cfd1");
    expect_close(state.drag, 14.2929, 5e-4);
    expect_close(state.lift, 1.11905, 2e-3);
    EXPECT_LE(state.n_unknowns, 40000u);
  }

  TEST(TurekHron, Cfd2DragAndLift)
  {
    const SteadyState state = steady_state("cfd2");
    expect_close(state.drag, 136.70, 1e-3);
    expect_close(state.lift, 10.534, 5e-3);
  }

  // Converged values to which several codes agree (docs/benchmarks.md).
  TEST(TurekHron, Fsi1DisplacementAndForces)
  {
    const SteadyState state = steady_state("fsi1");
    expect_close(state.tip_mm[0], 0.022676, 2e-3);
    expect_close(state.tip_mm[1], 0.819155, 2e-3);
    expect_close(state.drag, 14.29371, 3e-3);
    expect_close(state.lift, 0.764806, 3e-3);
    EXPECT_LE(state.n_unknowns, 35000u);
  }

  // The first swing, where codes agree whatever their steps: biquadratic quadrilaterals with an energy-momentum scheme
  // give (-14.64 +- 14.64, -64.82 +- 64.85) mm and a period of 0.9137 s, converged in space and time
  // (docs/benchmarks.md).
  TEST(TurekHron, Csm3FirstSwing)
  {
    const Scene          scene = shipped_scene("csm3", {"time.duration_s=1.1", "time.steps=440"});
    FullOrderModel<2>    model(scene, MPI_COMM_WORLD);
    dealii::Tensor<1, 2> lowest;
    double               y_before = 0., rise_s = 0., back = 0.;
    for (int step = 0; step < scene.time.n_steps(); ++step)
    {
      model.advance();
      const auto tip = 1e3 * model.now().configuration.shape[model.swimmer().tail().axis_at_tip[2]];
      for (int c = 0; c < 2; ++c)
        lowest[c] = std::min(lowest[c], tip[c]);
      constexpr double middle_mm = -64.8;
      if (y_before < middle_mm && tip[1] >= middle_mm)
        rise_s = model.now().time_s;
      if (rise_s > 0.)
        back = rise_s == model.now().time_s ? tip[1] : std::max(back, tip[1]);
      y_before = tip[1];
    }
    std::cout << "lowest " << lowest << " mm, crosses the middle at " << rise_s << " s, comes back to " << back << " mm"
              << std::endl;
    expect_close(lowest[0], -29.28, 5e-3);
    expect_close(lowest[1], -129.67, 5e-3);
    expect_close(rise_s, 0.75 * 0.9137, 5e-3);
    EXPECT_NEAR(back, 0., 0.005 * 129.67);
  }
} // namespace swimtwin
