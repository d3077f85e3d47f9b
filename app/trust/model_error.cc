#include <app/trust/model_error.h>

#include <datasets/reduced/held_out_error.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

namespace swimtwin
{
  std::string model_error_warning(const ReducedModel &model, const std::string &name)
  {
    if (model.record.held_out_runs.empty())
      return fmt::format("{}: how far the reduced model is off is not known: it has no held-out runs", name);
    const std::string missed = missed_target(model.record);
    return missed.empty() ? "" : fmt::format("{}: {}", name, missed);
  }

  void warn_of_model_error(const ReducedModel &model, const std::string &name)
  {
    if (const std::string warning = model_error_warning(model, name); !warning.empty())
      warn(warning);
  }

  void require_borne_model_error(const ReducedModel &model, const std::string &name, const bool is_accepted)
  {
    const HeldOutError error = displacement_error(model.record);
    if (error.is_known() && !error.is_within(largest_borne_error) && !is_accepted)
      throw InputError(
          fmt::format("{}: displacements of the reduced model are off by {}, more than the {:g} % (twice as "
                      "much at worst) that a result may rest on; train it on a narrower range, with more "
                      "--modes and --samples, or say {} to go on all the same.",
                      name, error.text(), 100. * largest_borne_error, accept_model_error));
    warn_of_model_error(model, name);
  }
} // namespace swimtwin
