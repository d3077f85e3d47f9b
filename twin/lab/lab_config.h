// A laboratory written in TOML.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/scene.h>
#include <twin/lab/laboratory_options.h>

#include <filesystem>
#include <string>

namespace swimtwin
{
  enum class LabSwimmer { reduced, full_order };

  struct LabConfig
  {
    LabSwimmer        swimmer = LabSwimmer::reduced;
    LaboratoryOptions options;
    double            bx_T = 0., by_T = 0., frequency_Hz = 0.;
    double            duration_s       = 60.;
    double            real_time        = 0.; ///< seconds of the laboratory in a second; 0: as fast as it goes
    bool              tells_sigmas     = true;
    bool              is_steered       = false;  ///< the coils play what a twin says, nothing before
    double            ticks_per_second = 20.;    ///< of the clock that a steered one sends
    int               steps_per_frame  = 1;      ///< of a full-order swimmer
    std::string       inertia          = "auto"; ///< that a full-order swimmer has: a word of [fluid] inertia
  };

  /// What the file leaves out is the model's scene's. Throws InputError with file, line, key, rule and remedy.
  LabConfig read_lab_config(const std::filesystem::path &file, const ReducedModel &model);
  /// With a full-order swimmer.
  LabConfig read_lab_config(const std::filesystem::path &file, const Scene &scene);

  /// The scene with the laboratory's swimmer in its fluid, and the inertia that it has there.
  Scene scene_in_laboratory(Scene scene, const LabConfig &config);
} // namespace swimtwin
