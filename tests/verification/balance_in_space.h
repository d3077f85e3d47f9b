// The power balance of a step in space, as its tests look at it.
#pragma once

#include <fom/step/full_order_model.h>

namespace swimtwin
{
  struct StepBalance
  {
    double work_J = 0., missing_J = 0.; ///< of the field; neither dissipated, nor stored, nor carried away
  };

  /// Over the model's next step, powers by the trapezoidal rule.
  inline StepBalance advance_and_balance(FullOrderModel<3> &model, const double dt_s)
  {
    const PowerBalance before = model.balance();
    model.advance();
    const PowerBalance now  = model.balance();
    const double       work = .5 * dt_s * (before.magnetic + now.magnetic);
    return {work,
            work - .5 * dt_s * (before.dissipation + now.dissipation + before.kinetic_outflow + now.kinetic_outflow) -
                (now.elastic_energy + now.kinetic_energy - before.elastic_energy - before.kinetic_energy)};
  }
} // namespace swimtwin
