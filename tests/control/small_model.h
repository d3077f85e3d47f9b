// The shipped model of the open disc with two coordinates and without inertia, as its scene then says: a real swimmer,
// fast enough for searches.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/sweep/sweep.h>
#include <tests/places.h>

#include <string>

namespace swimtwin
{
  inline ReducedModel small_model()
  {
    ReducedModel model = truncated(read_reduced_model(std::string(places::models) + "/open-2d.h5"), 2);
    model.inertia      = {};
    model.scene_text   = parse_scene(model.scene_text, model.scene_name, {"fluid.inertia=none"}).text;
    return model;
  }

  /// The scene's own run.
  inline RunRequest small_request(const ReducedModel &model)
  {
    return sweep_options(parse_scene(model.scene_text, model.scene_name), model).base;
  }
} // namespace swimtwin
