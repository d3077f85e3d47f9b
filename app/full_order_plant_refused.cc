// The online build has no full-order model.
#include <app/full_order_plant.h>
#include <datasets/error.h>

namespace swimtwin
{
  std::unique_ptr<Plant> make_full_order_plant(const Scene &, const FullOrderPlantOptions &)
  {
    throw InputError("a full-order plant needs the full-order model, which this build is without; use the release "
                     "build, or set [loop] plant = \"reduced\".");
  }
} // namespace swimtwin
