#include <app/refinement.h>

#include <app/value_list.h>
#include <datasets/system/console.h>

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
    return difference > target_ && n_done() < n_rounds_;
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
                       "--refine-target {:.3g} %; a larger --refine goes on",
                       n_done(), n_rounds_, 100. * rounds_.back().difference, 100. * target_);
  }

  std::vector<RefinementRound> refine_in_use(Refinement refinement, RefinedModel &by, const CommonOptions &common,
                                             const ModelUse &use, std::vector<std::string> &warnings)
  {
    for (std::optional<double> difference; (difference = use.difference());)
    {
      const bool goes_on = refinement.goes_on(by.file, *difference);
      if (is_speaker() && !common.quiet)
        say_text(refinement.last_round());
      if (!goes_on)
        break;
      by = refine_model(by, use.snapshots(), common, refinement.n_done() + 1);
      use.again();
    }
    if (const std::string shortfall = refinement.shortfall(); !shortfall.empty())
      warnings.push_back(shortfall);
    return refinement.rounds();
  }
} // namespace swimtwin
