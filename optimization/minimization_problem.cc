#include <optimization/minimization_problem.h>

namespace swimtwin
{
  std::string to_string(const MinimumStatus status)
  {
    switch (status)
    {
    case MinimumStatus::not_run:
      return "not run";
    case MinimumStatus::converged:
      return "converged";
    case MinimumStatus::budget_exhausted:
      return "budget exhausted";
    case MinimumStatus::stalled:
      return "stalled";
    case MinimumStatus::infeasible:
      return "infeasible";
    case MinimumStatus::failed:
      break;
    }
    return "failed";
  }
} // namespace swimtwin
