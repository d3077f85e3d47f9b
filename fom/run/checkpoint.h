// checkpoint.h5: everything that a run needs to go on as if it had not stopped.
#pragma once

#include <datasets/system/provenance.h>
#include <fom/run/run_recorder.h>
#include <fom/step/full_order_model.h>

#include <filesystem>

namespace swimtwin
{
  struct Checkpoint
  {
    ModelState<2>                    model;
    std::vector<std::vector<double>> rows, shapes; ///< of RunRecorder, like the works
    std::vector<IntervalWork>        first_works = {};
    double                           wall_time_s = 0., cpu_time_s = 0.;
  };

  /// With a checksum (see require_seal). Written to a temporary name, then renamed. Throws ComputationError.
  void write_checkpoint(const std::filesystem::path &file, const Checkpoint &checkpoint, const Provenance &provenance);

  /// Throws InputError if the file is not a checkpoint, is not what its checksum was made of, or belongs to another
  /// scene (by hash).
  Checkpoint read_checkpoint(const std::filesystem::path &file, const Scene &scene);
} // namespace swimtwin
