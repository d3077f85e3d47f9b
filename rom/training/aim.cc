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

    /// Whether the attempt lowered the least error before it at all: a mode that did not was taken back.
    bool was_kept(const std::vector<Attempt> &attempts, const std::size_t k)
    {
      return std::all_of(attempts.begin(), attempts.begin() + static_cast<std::ptrdiff_t>(k),
                         [&](const Attempt &before) { return attempts[k].error < before.error; });
    }

    /// On the samples of the present modes.
    bool fit_is_finest(const std::vector<Attempt> &attempts)
    {
      bool finest = false;
      for (std::size_t k = 1; k < attempts.size(); ++k)
        if (attempts[k].remedy != Remedy::another_mode)
          finest = true;
        else if (was_kept(attempts, k))
          finest = false;
      return finest;
    }

    /// Whether samples were added in vain since something helped.
    bool samples_have_failed(const std::vector<Attempt> &attempts)
    {
      for (std::size_t k = attempts.size(); k-- > 1 && !helped(attempts, k);)
        if (attempts[k].remedy == Remedy::more_samples)
          return true;
      return false;
    }

    /// Once more it would be made from the same samples, whatever was added to the others since.
    bool last_mode_failed(const std::vector<Attempt> &attempts)
    {
      for (std::size_t k = attempts.size(); k-- > 1;)
        if (attempts[k].remedy == Remedy::another_mode)
          return !helped(attempts, k);
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

  std::optional<Remedy> next_remedy(const std::vector<Attempt> &attempts)
  {
    const bool samples_failed = samples_have_failed(attempts);
    const bool mode_failed    = last_mode_failed(attempts);
    if (samples_failed && mode_failed)
      return {};
    // It costs nothing, whatever the error comes from; its failure says little: samples may still be what is missing.
    if (!fit_is_finest(attempts))
      return Remedy::finer_fit;
    const bool is_of_fit = attempts.back().fit_share >= .5 * attempts.back().error;
    return (is_of_fit || mode_failed) && !samples_failed ? Remedy::more_samples : Remedy::another_mode;
  }

  std::string cause_of(const TrainingRecord &record)
  {
    const double all = displacement_error(record).rms, fit = fit_share(record);
    return fmt::format("as far as fits to half of the samples tell, the resistance's fit makes {:.2g} % of {:.2g} % "
                       "(rms); {}",
                       100. * fit, 100. * all,
                       fit >= .5 * all ? "more --samples or a narrower range would help"
                                       : "the rest comes from the modes, the place along the walls, what loads do "
                                         "to a strongly bent tail beside bending it and monomials left out");
  }
} // namespace swimtwin
