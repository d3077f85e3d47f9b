// What a training that misses its target does next: where the held-out error comes from decides.
#pragma once

#include <datasets/reduced/held_out_error.h>

#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  enum class Remedy {
    finer_fit,    ///< more monomials on the same samples
    more_samples, ///< of the resistance, where the reduced swimmer goes and the fit is least sure
    another_mode  ///< with shapes of least energy and samples of its own
  };

  /// A model that was made, and what its held-out runs say.
  struct Attempt
  {
    std::optional<Remedy> remedy;         ///< that led to it; nothing led to the first
    double                error     = 0.; ///< of held-out displacements (size_of), relative
    double                fit_share = 0.; ///< root mean square of what fits to half of the samples change in them
  };

  /// What is compared with the target: the root mean square, or half of the worst if that is more.
  double size_of(const HeldOutError &error);

  /// Root mean square over the held-out runs, relative.
  double fit_share(const TrainingRecord &record);

  /// After these attempts, of which the last missed the target: a finer fit on the same samples, which costs nothing;
  /// then samples are added if the fit makes at least half of the error, else a mode; what did not lower the error by a
  /// tenth gives way to the other. Nothing if neither did.
  std::optional<Remedy> next_remedy(const std::vector<Attempt> &attempts);

  /// "the fit of the resistance makes 0.4 % of it, the rest is the modes' and the place's"
  std::string cause_of(const TrainingRecord &record);
} // namespace swimtwin
