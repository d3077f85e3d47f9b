#include <rom/training/aim.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    /// Whether the attempt lowered the least error before it by a tenth.
    bool helped(const std::vector<Attempt> &attempts, const std::size_t k)
    {
      double before = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < k; ++i)
        before = std::min(before, attempts[i].error);
      return attempts[k].error < .9 * before;
    }

    /// Whether the attempt lowered the least error before it at all: modes and runs that did not were taken back.
    bool was_kept(const std::vector<Attempt> &attempts, const std::size_t k)
    {
      return std::all_of(attempts.begin(), attempts.begin() + static_cast<std::ptrdiff_t>(k),
                         [&](const Attempt &before) { return attempts[k].error < before.error; });
    }

    /// Modes and region of shapes are chosen anew.
    bool starts_anew(const Attempt &attempt)
    {
      return attempt.remedy == Remedy::another_mode || attempt.remedy == Remedy::more_runs;
    }

    /// Whose model is the present one.
    std::size_t last_kept(const std::vector<Attempt> &attempts)
    {
      std::size_t k = attempts.size() - 1;
      while (k > 0 && starts_anew(attempts[k]) && !was_kept(attempts, k))
        --k;
      return k;
    }

    /// On the samples of the present modes.
    bool fit_is_finest(const std::vector<Attempt> &attempts)
    {
      bool finest = false;
      for (std::size_t k = 1; k < attempts.size(); ++k)
        if (!starts_anew(attempts[k]))
          finest = true;
        else if (was_kept(attempts, k))
          finest = false;
      return finest;
    }

    /// Whether this was tried in vain since something helped.
    bool has_failed(const Remedy remedy, const std::vector<Attempt> &attempts)
    {
      for (std::size_t k = attempts.size(); k-- > 1 && !helped(attempts, k);)
        if (attempts[k].remedy == remedy)
          return true;
      return false;
    }

    /// Once more it would be made from the same runs and samples, whatever was added to the others since.
    bool last_mode_failed(const std::vector<Attempt> &attempts)
    {
      for (std::size_t k = attempts.size(); k-- > 1;)
        if (attempts[k].remedy == Remedy::another_mode)
          return !helped(attempts, k);
        else if (attempts[k].remedy == Remedy::more_runs && was_kept(attempts, k))
          return false;
      return false;
    }
  } // namespace

  double size_of(const HeldOutError &error)
  {
    return std::max(error.rms, .5 * error.worst);
  }

  double fit_share(const TrainingRecord &record)
  {
    double sum = 0.;
    for (const HeldOutRun &run : record.held_out_runs)
      sum += std::pow(run.fit_change_m / error_scale_m(record, run.displacement_m), 2);
    return std::sqrt(sum / std::max<double>(1., static_cast<double>(record.held_out_runs.size())));
  }

  std::optional<Remedy> next_remedy(const std::vector<Attempt> &attempts, const std::function<bool(Remedy)> &can_be_had)
  {
    // It costs nothing, whatever the error comes from; its failure says little: samples may still be what is missing.
    if (!fit_is_finest(attempts) && can_be_had(Remedy::finer_fit))
      return Remedy::finer_fit;
    const bool     runs    = !has_failed(Remedy::more_runs, attempts) && can_be_had(Remedy::more_runs);
    const bool     samples = !has_failed(Remedy::more_samples, attempts) && can_be_had(Remedy::more_samples);
    const bool     mode    = !last_mode_failed(attempts) && can_be_had(Remedy::another_mode);
    const Attempt &present = attempts[last_kept(attempts)];
    if (present.leaves_shapes && runs)
      return Remedy::more_runs;
    if (present.fit_share >= .5 * present.error && samples)
      return Remedy::more_samples;
    if (mode)
      return Remedy::another_mode;
    if (samples)
      return Remedy::more_samples;
    return runs ? std::optional(Remedy::more_runs) : std::nullopt;
  }

  std::string cause_of(const TrainingRecord &record, const KnownShares &shares)
  {
    const double all = displacement_error(record).rms, fit = fit_share(record);
    const auto   rest = [&]() -> std::string {
      if (fit >= .5 * all)
        return "more --samples or a narrower range would help";
      if (shares.velocities >= .5 * all) // fits to half of the samples may be wrong alike
        return fmt::format(
              "surface velocities at shapes not trained on are off by {:.2g} %, worth up to {:.2g} % of the "
                "displacement: more --samples or a narrower range would help",
              100. * record.velocity_error_rms, 100. * shares.velocities);
      if (shares.place >= .5 * all)
        return fmt::format("the place along the domain, which no variable of the model knows, is worth up to {:.2g} %: "
                               "a longer domain would help",
                             100. * shares.place);
      return "the rest comes from the modes, what loads do to a strongly bent tail beside bending it and monomials "
               "left "
               "out";
    };
    return fmt::format("as far as fits to half of the samples tell, the resistance's fit makes {:.2g} % of {:.2g} % "
                       "(rms); {}",
                       100. * fit, 100. * all, rest());
  }
} // namespace swimtwin
