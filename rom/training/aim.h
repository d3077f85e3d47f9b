// What a training that misses its target does next: where the held-out error comes from decides.
#pragma once

#include <datasets/reduced/held_out_error.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  enum class Remedy {
    finer_fit,    ///< more monomials on the same samples
    more_samples, ///< of the resistance, where the reduced swimmer goes and the fit is least sure
    another_mode, ///< with shapes of least energy and samples of its own
    more_runs     ///< of the full-order model, near the held-out ones that are furthest off
  };

  /// A model that was made, and what its held-out runs say.
  struct Attempt
  {
    std::optional<Remedy> remedy;         ///< that led to it; nothing led to the first
    double                error     = 0.; ///< of held-out displacements (size_of), relative
    double                fit_share = 0.; ///< root mean square of what fits to half of the samples change in them
    bool leaves_shapes = false; ///< whether a held-out run that is further off than the target goes where no shape was
  };

  /// What is compared with the target: the root mean square, or half of the worst if that is more.
  double size_of(const HeldOutError &error);

  /// Root mean square over the held-out runs, relative.
  double fit_share(const TrainingRecord &record);

  /// After these attempts, of which the last missed the target, one that can be had: a finer fit on the same samples,
  /// which costs nothing; then runs if held-out ones leave the region of shapes, samples if the fit makes at least half
  /// of the error, else a mode; what did not lower the error by a tenth, or cannot be had, gives way to the others.
  /// Nothing if none is left.
  std::optional<Remedy> next_remedy(
      const std::vector<Attempt>        &attempts,
      const std::function<bool(Remedy)> &can_be_had = [](Remedy) { return true; });

  /// What is known by itself, and is worth at most this share of the displacement of a head that goes to and fro.
  struct KnownShares
  {
    double place      = 0.; ///< along the domain, which no variable of the model knows
    double velocities = 0.; ///< errors of the resistance at held-out shapes
  };

  /// "as far as fits to half of the samples tell, the resistance's fit makes 0.4 % of 2 % (rms); ...", with what would
  /// help.
  std::string cause_of(const TrainingRecord &record, const KnownShares &shares);
} // namespace swimtwin
