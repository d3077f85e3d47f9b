// The inertia of a trained swimmer: where to sample it, and polynomials through the samples.
#pragma once

#include <rom/training/inertia_samples.h>

namespace swimtwin
{
  struct TrainedInertia
  {
    ReducedInertia inertia;
    int            n_samples  = 0;
    double         mass_error = 0., quadratic_error = 0.; ///< root mean square, relative, by five-fold cross-validation
    double         power_defect = 0.;                     ///< largest of the fluid's samples
  };

  /// Of a model that is complete but for its inertia. A third of the samples lies where its runs go, a third nearer to
  /// rest on the same ways, and a third fills the region of shapes and poses. Collective.
  TrainedInertia train_inertia(const ReducedModel &model, const Scene &scene, int n_samples, MPI_Comm communicator,
                               const std::function<void(int, int)> &on_progress = {});

  /// Where the scene asks for inertia somewhere in the model's range, to its model. Collective.
  void add_inertia(ReducedModel &model, const Scene &scene, MPI_Comm communicator,
                   const std::function<void(int, int)> &on_progress = {});

  /// One sentence on what of the inertia the model leaves out.
  std::string neglected_inertia(const ReducedModel &model, const Scene &scene);
} // namespace swimtwin
