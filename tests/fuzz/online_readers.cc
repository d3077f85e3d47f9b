#include <tests/fuzz/fuzzed_readers.h>

namespace swimtwin
{
  // This build has no others.
  std::vector<FuzzedReader> all_readers()
  {
    return online_readers();
  }
} // namespace swimtwin
