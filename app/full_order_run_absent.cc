// For the online build and its tests.
#include <app/full_order_run.h>

#include <datasets/error.h>

namespace swimtwin
{
  bool has_full_order_model()
  {
    return false;
  }

  double full_order_displacement_m(const Scene &, const std::filesystem::path &)
  {
    throw InputError("this build has no full-order model.");
  }
} // namespace swimtwin
