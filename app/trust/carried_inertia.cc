#include <app/trust/carried_inertia.h>

#include <datasets/scene/dimensionless_groups.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <reports/page/number_text.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    /// Largest unsteady group that is computed without being asked for, and share that is not warned of.
    constexpr double largest_unsteady_group = 2., noticed_share = 0.01;

    std::string place_of(const Scene &scene, const InertialExtreme &extreme)
    {
      return fmt::format("at {:.4g} Hz, {:.4g} Pa s and {:.4g} Pa the unsteady group 2 pi rho f L^2 / mu is {:.3g}",
                         extreme.frequency_Hz, extreme.viscosity_Pa_s, extreme.young_modulus_Pa, extreme.group(scene));
    }

    /// Whether someone chose what is carried; else it is what is needed, as far as the model has it.
    bool was_told(const Scene &scene)
    {
      return scene.fluid->inertia != Inertia::automatic;
    }

    /// Of what is left out.
    double missed_share(InertiaShares shares, const InertiaTerms &carried)
    {
      if (carried.of_fluid())
        shares.fluid = 0.;
      if (carried.tail)
        shares.tail = 0.;
      if (carried.head)
        shares.head = 0.;
      return shares.together();
    }
  } // namespace

  void add_inertia_option(CLI::App &verb, std::string &inertia)
  {
    verb.add_option("--inertia", inertia, "none, auto or full, in the place of the scene's [fluid] inertia")
        ->check(CLI::IsMember({"none", "auto", "full"}))
        ->take_last();
  }

  void add_inertia_options(CLI::App &verb, InertiaChoice &choice)
  {
    add_inertia_option(verb, choice.inertia);
    verb.add_flag("--allow-inertia", choice.allowed,
                  "Compute where the neglected inertia is not small, too, or where the fluid's is carried too far");
  }

  void require_inertia(const ReducedModel &model, const std::string &model_name, const std::string &inertia)
  {
    if (!model.inertia.is_given() && inertia == "full")
      throw InputError(
          fmt::format("--inertia full: {} was trained without inertia; train it again with [fluid] inertia "
                      "= \"auto\" or \"full\", or leave --inertia out.",
                      model_name));
  }

  std::string InertiaDoubt::warning() const
  {
    return finding.empty() ? "" : finding + ": do not trust more than the digits that this leaves";
  }

  std::string InertiaDoubt::refusal(const std::string &remedy) const
  {
    return fmt::format("{}; {}, or say --allow-inertia to compute all the same.", finding, remedy);
  }

  InertiaDoubt doubt_inertia(const Scene &scene, const InertiaTerms &carried, const InertialExtreme &extreme)
  {
    const InertiaShares shares = extreme.shares(scene);
    const std::string   place  = place_of(scene, extreme);
    if (const double error = extreme.error_if_carried(scene); carried.of_fluid() && error > noticed_share)
      return {fmt::format("{}, inertia is {}, and the reduced swimmer knows it to some {:.2g} % of the displacement",
                          place, share_of_displacement(shares.together()), 100. * error),
              error > largest_inertial_error};
    const double missed = missed_share(shares, carried);
    if (missed <= noticed_share)
      return {};
    const bool        is_large = extreme.group(scene) > largest_unsteady_group;
    const std::string limit =
        is_large ? fmt::format(", more than the {} up to which inertia may be left out", largest_unsteady_group) : "";
    return {fmt::format("{}{}, and the reduced swimmer neglects {}, {}", place, limit,
                        carried.any() ? "part of the inertia" : "inertia", share_of_displacement(missed)),
            is_large || (!was_told(scene) && missed > largest_inertial_error), missed};
  }

  double error_of_inertia(const Scene &scene, const InertiaTerms &carried, const InertialExtreme &member)
  {
    if (carried.of_fluid())
      return member.error_if_carried(scene);
    return was_told(scene) ? 0. : missed_share(member.shares(scene), carried);
  }

  void warn_of(const std::vector<std::string> &warnings, const InertiaDoubt &doubt, const bool allowed)
  {
    for (const std::string &warning : warnings)
      if (!doubt.refuses(allowed) || warning != doubt.warning())
        warn(warning);
  }

  std::string accept_doubt(const InertiaDoubt &doubt, const bool allowed, const std::string &remedy)
  {
    if (doubt.refuses(allowed))
      throw InputError(doubt.refusal(remedy));
    return doubt.warning();
  }
} // namespace swimtwin
