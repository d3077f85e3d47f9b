#include <rom/integration/integration_failure.h>

#include <fmt/format.h>

#include <cvodes/cvodes.h>

namespace swimtwin
{
  std::string integration_failure(const int flag, const long max_steps)
  {
    switch (flag)
    {
    case CV_TOO_MUCH_WORK:
      return fmt::format("more than {} steps are needed", max_steps);
    case CV_ERR_FAILURE:
      return "the error per step stays above the tolerance for the smallest step";
    case CV_CONV_FAILURE:
      return "Newton's method does not converge for the smallest step";
    case CV_TOO_MUCH_ACC:
      return "the tolerance is below what double precision allows";
    case CV_RHSFUNC_FAIL:
    case CV_FIRST_RHSFUNC_ERR:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_LSETUP_FAIL:
      return "a rate is not finite: the motion leaves what the model can describe";
    default:
      return "CVODES gives up";
    }
  }
} // namespace swimtwin
