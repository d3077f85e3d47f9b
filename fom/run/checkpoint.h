// checkpoint.h5: everything that a run needs to go on as if it had not stopped.
#pragma once

#include <datasets/run/plane_flow.h>
#include <datasets/system/provenance.h>
#include <fom/run/run_recorder.h>
#include <fom/step/full_order_model.h>

#include <filesystem>

namespace swimtwin
{
  template <int dim>
  struct Checkpoint
  {
    ModelState<dim>                  model;
    std::vector<std::vector<double>> rows, shapes; ///< of RunRecorder, like the works
    std::vector<IntervalWork>        first_works = {};
    std::vector<PlaneFlow>           flows       = {}; ///< noted so far
    double                           wall_time_s = 0., cpu_time_s = 0.;
  };

  /// With a checksum (see require_seal). Written to a temporary name, then renamed. Throws ComputationError.
  template <int dim>
  void write_checkpoint(const std::filesystem::path &file, const Checkpoint<dim> &checkpoint,
                        const Provenance &provenance);

  /// Throws InputError if the file is not a checkpoint, is not what its checksum was made of, or belongs to another
  /// scene (by hash).
  template <int dim>
  Checkpoint<dim> read_checkpoint(const std::filesystem::path &file, const Scene &scene);
} // namespace swimtwin
