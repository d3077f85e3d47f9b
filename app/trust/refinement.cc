#include <app/trust/refinement.h>

#include <app/frame/value_list.h>
#include <datasets/reduced/held_out_error.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

namespace swimtwin
{
  void add_refine_options(CLI::App &verb, RefineOptions &options)
  {
    verb.add_option("--refine", options.n_rounds,
                    "Run the result on the full-order model, train on its shapes too, and start again: at most so "
                    "many times, until both models agree")
        ->check(CLI::Range(0, 20));
    verb.add_option("--refine-target", options.target, "Relative difference at which they do, such as 0.5% or 0.005")
        ->capture_default_str();
  }

  Refinement::Refinement(const RefineOptions &options)
      : target_(parse_share("--refine-target", options.target)), n_rounds_(options.n_rounds)
  {
  }

  bool Refinement::goes_on(const std::filesystem::path &model_file, const double difference)
  {
    rounds_.push_back({model_file.string(), difference});
    return !(difference <= target_) && n_done() < n_rounds_;
  }

  std::string Refinement::last_round() const
  {
    return fmt::format("  {}: {:.2g} % off the full-order model at its own result\n", rounds_.back().model_file,
                       100. * rounds_.back().difference);
  }

  std::string Refinement::shortfall() const
  {
    if (rounds_.empty() || rounds_.back().difference <= target_)
      return "";
    return fmt::format("after {} of {} refinements the models differ by {:.2g} % at the result, more than "
                       "--refine-target {:.3g} %; --refine from {} goes on",
                       n_done(), n_rounds_, 100. * rounds_.back().difference, 100. * target_,
                       rounds_.back().model_file);
  }

  RefinementReport refine_in_use(Refinement refinement, RefinedModel &by, const CommonOptions &common,
                                 const ModelUse &use)
  {
    std::vector<std::string> warnings;
    for (std::optional<double> difference; (difference = use.difference());)
    {
      const bool goes_on = refinement.goes_on(by.file, of_speaker(*difference));
      if (is_speaker() && !common.quiet)
        say_text(refinement.last_round());
      if (!goes_on)
        break;
      const int round = refinement.n_done() + 1;
      try
      {
        RefinedModel refined = refine_model(by, use.snapshots(), use.inertia, common, round);
        if (use.inertia.any() && !refined.model.inertia.is_given())
          throw ComputationError("its inertia was not borne out by its held-out runs");
        use.again(refined);
        by = std::move(refined);
      }
      catch (const ComputationError &error)
      {
        warnings.push_back(fmt::format("refinement {} failed, and the result is that of {}: {}", round,
                                       by.file.string(), error.what()));
        return {refinement.rounds(), warnings};
      }
      if (const std::string missed = missed_target(by.model.record); !missed.empty())
        warnings.push_back(fmt::format("{}: {}", by.file.string(), missed));
    }
    if (refinement.rounds().empty())
      warnings.push_back("nothing was refined: the result has no full-order run to compare it with");
    else if (const std::string shortfall = refinement.shortfall(); !shortfall.empty())
      warnings.push_back(shortfall);
    return {refinement.rounds(), warnings};
  }
} // namespace swimtwin
