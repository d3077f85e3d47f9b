// The flow around the swimmer in its plane of motion, sampled while a run goes on.
#pragma once

#include <datasets/run/plane_flow.h>
#include <fom/step/full_order_model.h>

namespace swimtwin
{
  /// Whether the flow is kept after this step of the time grid: at the quarters and the end of the last full period;
  /// without one, of the whole run.
  bool is_flow_instant(const TimeSettings &time, int grid_step);

  /// At the model's present instant, which has a fluid that was solved for; every rank has it.
  template <int dim>
  PlaneFlow flow_in_plane(const FullOrderModel<dim> &model);
} // namespace swimtwin
