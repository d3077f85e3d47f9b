// Options on the inertia that a study on a reduced model carries, and doubts about it.
#pragma once

#include <rom/swimmer/carried_inertia.h>

#include <string>

namespace CLI
{
  class App;
}

namespace swimtwin
{
  /// As typed.
  struct InertiaChoice
  {
    std::string inertia;         ///< "none", "auto", "full"; empty: as the scene has it
    bool        allowed = false; ///< inertia that is left out or carried too far
  };

  /// Option --inertia of a verb.
  void add_inertia_option(CLI::App &verb, std::string &inertia);
  /// And --allow-inertia.
  void add_inertia_options(CLI::App &verb, InertiaChoice &choice);

  /// Throws InputError for "full" and a model that has none.
  void require_inertia(const ReducedModel &model, const std::string &model_name, const std::string &inertia);

  /// One sentence on inertia that is left out, or carried too far, where the error is not small; else empty. Throws
  /// InputError where the model cannot be right, with the remedy ("lower ..."), unless that is allowed.
  std::string inertia_doubt(const Scene &scene, const InertiaTerms &carried, const InertialExtreme &extreme,
                            bool allowed, const std::string &remedy);
} // namespace swimtwin
