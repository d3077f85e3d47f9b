// The scene of a calibrated swimmer, ready for `simulate`.
#pragma once

#include <datasets/observation/calibration_result.h>
#include <datasets/observation/observation_set.h>
#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/scene.h>

#include <vector>

namespace swimtwin
{
  inline constexpr const char *fitted_scene_name = "fitted-scene.toml", *fitted_field_name = "fitted-field.csv",
                              *fitted_field_period_name = "fitted-field.json";

  /// The model's scene with the swimmer's stiffness, viscosity, magnetization and lengths, in the field of the data set
  /// at the swimmer's place, at the scene's own frequency, with the inertia that the fit carried.
  /// Displacement scale and offset belong to the recording and do not enter. Made to stand in `folder` as
  /// fitted_scene_name; if the data's field is a program, the scaled program is written to fitted_field_name there,
  /// else such a file is removed.
  Scene fitted_scene(const ReducedModel &model, const CalibratedSwimmer &swimmer, const InertiaTerms &carried,
                     const ObservationSet &set, const std::filesystem::path &folder);

  /// Throws InputError, with the file, for data that full-order runs of one observation cannot repeat: in another field
  /// than a sinusoid, or of the periodic state.
  void require_repeatable(const std::vector<ObservationSet> &sets);

  /// The same lengths as the model's scene, one observation's frequency and period, the inertia that the fit carried:
  /// what the full-order model is to check. Of repeatable data alone.
  Scene scene_of_observation(const ReducedModel &model, const CalibratedSwimmer &swimmer, const InertiaTerms &carried,
                             const FieldProgram &field, std::optional<int> period);
} // namespace swimtwin
