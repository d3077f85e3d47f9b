// A model that follows its use: trained again with the shapes of full-order runs of what was made with it.
#pragma once

#include <app/frame/verb.h>
#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/inertia_terms.h>

#include <filesystem>
#include <vector>

namespace swimtwin
{
  /// A model and where it lies.
  struct RefinedModel
  {
    ReducedModel          model;
    std::filesystem::path file;
  };

  /// The model trained again over its range with these snapshots.h5 as well, in `refined-ROUND` of the output folder.
  /// Runs and shapes of earlier refinements beside its file are taken along. With inertia if the model before has it
  /// and its scene asks for it or its use carries it. Collective. Throws InputError and ComputationError.
  RefinedModel refine_model(const RefinedModel &before, const std::vector<std::filesystem::path> &snapshots,
                            const InertiaTerms &carried, const CommonOptions &common, int round);
} // namespace swimtwin
