// What a twin imagines: a reduced swimmer in a field, and a camera that looks at it.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <twin/estimate/twin_options.h>
#include <twin/measurement/camera_sensor.h>
#include <twin/measurement/tail_axis.h>
#include <twin/motion/field_signal.h>
#include <twin/motion/twin_process.h>

namespace swimtwin
{
  /// Stays where it is made: its parts know each other.
  struct TwinModel
  {
    /// `model` must live as long.
    TwinModel(const ReducedModel &model, const TwinOptions &options)
        : swimmer(model, options.densities), axis(model.tail), layout(options.parameters, swimmer.n_states()),
          process(swimmer, options.nominal, layout, field, options.noise, options.largest_step_s),
          camera(process, axis, options.first_sigmas)
    {
    }
    TwinModel(const TwinModel &)            = delete;
    TwinModel &operator=(const TwinModel &) = delete;

    ReducedSwimmer swimmer;
    TailAxis       axis;
    FieldSignal    field; ///< that plays
    TwinLayout     layout;
    TwinProcess    process;
    CameraSensor   camera;
  };
} // namespace swimtwin
