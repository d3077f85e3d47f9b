// The shipped model of the open disc in its own field, as a process with every parameter to be estimated.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/swimmer_parameters.h>
#include <tests/places.h>
#include <twin/estimate/twin_model.h>

#include <string>

namespace swimtwin
{
  inline ReducedModel open_model()
  {
    return read_reduced_model(std::string(places::models) + "/open-2d.h5");
  }

  inline SwimmerParameters open_parameters(const ReducedModel &model)
  {
    return swimmer_parameters(parse_scene(model.scene_text, model.scene_name));
  }

  /// All of them estimated.
  inline TwinParameters every_parameter()
  {
    TwinParameters parameters;
    for (DriftingParameter &p : parameters.list)
      p = {0., 0.1, 0.};
    return parameters;
  }

  inline TwinOptions open_options(const ReducedModel &model, const TwinParameters &parameters, const ModelNoise &noise)
  {
    TwinOptions options;
    options.nominal      = open_parameters(model);
    options.parameters   = parameters;
    options.noise        = noise;
    options.first_sigmas = {1e-5, 0.02};
    return options;
  }

  struct OpenModel
  {
    ReducedModel model = open_model();
  };

  struct OpenSwimmer : OpenModel, TwinModel
  {
    explicit OpenSwimmer(const TwinParameters &parameters = every_parameter(), const ModelNoise &noise = {})
        : TwinModel(OpenModel::model, open_options(OpenModel::model, parameters, noise))
    {
      field.play_sinusoid(0., 4e-3, 4e-3, 0.8);
    }

    /// Bent, turned, away from the origin, with every parameter off its start.
    Eigen::VectorXd some_state() const
    {
      Eigen::VectorXd state = Eigen::VectorXd::Zero(layout.n_states());
      state.head(5) << 1e-3, -2e-3, 0.4, 2e-4, -1e-4;
      const auto set = [&](const TwinParameter p, const double value) {
        if (layout.is_estimated(p))
          state[layout.place(p)] = value;
      };
      set(TwinParameter::stiffness, 0.1);
      set(TwinParameter::magnetization, -0.05);
      set(TwinParameter::background_x, 2e-4);
      set(TwinParameter::background_y, -1e-4);
      set(TwinParameter::flow_x, 2e-5);
      set(TwinParameter::flow_y, -1e-5);
      set(TwinParameter::camera_scale, 0.03);
      set(TwinParameter::camera_rotation, -0.2);
      set(TwinParameter::camera_offset_x, 3e-4);
      set(TwinParameter::camera_offset_y, 1e-4);
      set(TwinParameter::camera_delay, 0.02);
      return state;
    }
    /// What counts as a small change of each entry.
    Eigen::VectorXd small_change() const
    {
      Eigen::VectorXd change = Eigen::VectorXd::Constant(layout.n_states(), 1e-4);
      change.head(swimmer.n_states()).setConstant(1e-8);
      change[2] = 1e-5;
      for (const TwinParameter p :
           {TwinParameter::background_x, TwinParameter::background_y, TwinParameter::flow_x, TwinParameter::flow_y,
            TwinParameter::camera_offset_x, TwinParameter::camera_offset_y})
        if (layout.is_estimated(p))
          change[layout.place(p)] = 1e-7;
      if (layout.is_estimated(TwinParameter::camera_delay))
        change[layout.place(TwinParameter::camera_delay)] = 1e-7;
      return change;
    }
  };
} // namespace swimtwin
