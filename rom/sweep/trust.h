// How far a prediction may be trusted: where the model was trained, and what its own modes say.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/integration/swimmer_run.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// Why a run leaves what the model was trained for; one phrase each, empty if it does not.
  struct TrustNotes
  {
    /// "E/(mu f) = 5e6 above 2e6", then the parameters that are outside by themselves, "young_modulus_Pa = 5e5 above
    /// 3e5"; if those alone are, it says that a trained run has the same ratios.
    std::vector<std::string> outside_range;
    std::vector<std::string> outside_region; ///< "shape 1.2 times the trained region's radius"

    /// "held-out runs nearby are off by 20 %", if that is more than the model may be off at worst.
    std::string held_out;
    /// "the error may be 12 % of the displacement (95 %)", if that is more than a result may rest on.
    std::string bound;

    bool inside() const { return outside_range.empty() && outside_region.empty(); }
    /// All phrases, separated by "; ".
    std::string text() const;
  };

  /// Every prediction outside the range is marked, of the ratios (see notes_outside_range) or of a parameter alone.
  TrustNotes trust_notes(const TrainedRange &range, const RunRequest &request, const SwimmerRun &run);

  /// `error`: relative, of held-out runs nearby; NaN without any.
  void note_held_out_error(const TrainingRecord &record, double error, TrustNotes &notes);

  /// `bound_m`: of the error, with 95 %; NaN if not known.
  void note_error_bound(const TrainingRecord &record, double bound_m, double displacement_m, TrustNotes &notes);

  /// Estimated error of a displacement (m) from that of the model with fewer modes: what the last modes change. The
  /// modes fade, so what all those left out would change is taken to be no more.
  double displacement_error_indicator(double all_modes_m, double fewer_modes_m);
  /// Modes of the comparison: two fewer, but at least one; all of them if there is no more than one.
  int n_modes_of_comparison(int n_modes);
} // namespace swimtwin
