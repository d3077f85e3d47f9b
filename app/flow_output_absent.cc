#include <app/flow_output.h>

#include <datasets/error.h>

namespace swimtwin
{
  bool flow_can_be_computed()
  {
    return false;
  }

  void write_flow_of_run(const Scene &, const ReducedModel &, double, const std::vector<ReducedSnapshot> &,
                         const std::filesystem::path &, const std::function<void(int)> &)
  {
    throw InputError("--flow needs the full-order model, which this build is without: use the tool of the release "
                     "build, or leave --flow out");
  }
} // namespace swimtwin
