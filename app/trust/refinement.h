// Verbs whose model follows its use: their options, and how their rounds end.
#pragma once

#include <app/full_order/model_refinement.h>
#include <datasets/run/refinement.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  struct RefineOptions
  {
    int         n_rounds = 0;      ///< at most
    std::string target   = "0.5%"; ///< as typed

    bool is_asked_for() const { return n_rounds > 0; }
  };

  void add_refine_options(CLI::App &verb, RefineOptions &options);

  /// Rounds so far: the first is that of the model as it came.
  class Refinement
  {
  public:
    /// Throws InputError for a target that is no share.
    explicit Refinement(const RefineOptions &options);

    /// Note how far both models differ at the result of this one. Returns whether to refine it once more.
    bool goes_on(const std::filesystem::path &model_file, double difference);

    int                                 n_done() const { return std::max(0, static_cast<int>(rounds_.size()) - 1); }
    const std::vector<RefinementRound> &rounds() const { return rounds_; }
    std::string                         last_round() const; ///< a line for the terminal
    /// A warning; empty if the models agree.
    std::string shortfall() const;

  private:
    double                       target_;
    int                          n_rounds_;
    std::vector<RefinementRound> rounds_;
  };

  /// What a verb does with its model.
  struct ModelUse
  {
    std::function<std::optional<double>()>              difference; ///< of both models at the result; empty without one
    std::function<std::vector<std::filesystem::path>()> snapshots;  ///< of the full-order runs of the result
    /// Another result with this model takes the result's place. Throws ComputationError, and the result stays, where
    /// the other one cannot be had or compared.
    std::function<void(const RefinedModel &)> again;
    InertiaTerms                              inertia; ///< that is carried, and that a refined model must have too
  };

  struct RefinementReport
  {
    std::vector<RefinementRound> rounds;
    std::vector<std::string>     warnings; ///< what went wrong, a difference that is left

    /// To a result of any verb.
    template <typename Result>
    void add_to(Result &result) const
    {
      result.refinement = rounds;
      result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
    }
  };

  /// Refine the model until both models agree or the rounds are over. Collective.
  RefinementReport refine_in_use(Refinement refinement, RefinedModel &by, const CommonOptions &common,
                                 const ModelUse &use);
} // namespace swimtwin
