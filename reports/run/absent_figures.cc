#include <reports/run/absent_figures.h>

#include <reports/page/number_text.h>
#include <reports/page/shown_units.h>
#include <reports/run/run_folder.h>

namespace swimtwin
{
  bool has_full_period(const RunSummary &summary)
  {
    return !summary.displacement_per_period_m.empty();
  }

  std::string why_no_imbalance(const RunSummary &summary)
  {
    if (!has_full_period(summary))
      return "no full period was computed";
    return has_completed(summary) ? "no magnetic work and no dissipation to compare with" : "not finite";
  }

  std::string imbalance_text(const std::optional<double> &imbalance, const RunSummary &summary, const int n_digits)
  {
    return imbalance ? signed_number(percent * *imbalance, n_digits) : why_no_imbalance(summary);
  }
} // namespace swimtwin
