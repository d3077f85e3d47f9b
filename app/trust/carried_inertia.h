// Options on the inertia that a study on a reduced model carries, and doubts about it.
#pragma once

#include <rom/swimmer/carried_inertia.h>

#include <string>
#include <vector>

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

  struct InertiaDoubt
  {
    std::string finding;          ///< one clause on inertia that is left out, or carried too far; empty if it is little
    bool        is_wrong = false; ///< displacements are, and the scene asks for none that are
    double      missed   = 0.;    ///< share of the displacement that is left out

    bool refuses(const bool allowed) const { return is_wrong && !allowed; }
    /// The finding, and what follows for a result that is given all the same.
    std::string warning() const;
    /// Why there is none, with the remedy ("lower ..."); of a doubt that `is_wrong`.
    std::string refusal(const std::string &remedy) const;
  };

  InertiaDoubt doubt_inertia(const Scene &scene, const InertiaTerms &carried, const InertialExtreme &extreme);

  /// What a member's displacement is off, relative, by inertia that is carried to first order only, or left out
  /// although the scene says "auto".
  double error_of_inertia(const Scene &scene, const InertiaTerms &carried, const InertialExtreme &member);

  /// Say them, but for the doubt's own where the refusal says it.
  void warn_of(const std::vector<std::string> &warnings, const InertiaDoubt &doubt, bool allowed);

  /// The warning. Throws InputError where displacements are wrong, unless that is allowed.
  std::string accept_doubt(const InertiaDoubt &doubt, bool allowed, const std::string &remedy);
} // namespace swimtwin
