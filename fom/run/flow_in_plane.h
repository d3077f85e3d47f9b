// The flow around the swimmer in its plane of motion, sampled while a run goes on.
#pragma once

#include <datasets/run/plane_flow.h>
#include <fom/run/field_output.h>

namespace swimtwin
{
  /// Whether the flow is kept after this step of a time grid: at the quarters and the end of the last full period;
  /// without one, of the whole run. A period has steps.
  bool is_flow_instant(int n_steps, int steps_per_period, int step);

  /// Of an instant with a fluid that was solved for. One rank can do it without the others.
  template <int dim>
  PlaneFlow flow_in_plane(const FieldInstant<dim> &instant);
} // namespace swimtwin
