#include <datasets/system/provenance.h>

namespace swimtwin
{
  const char *const current_program_version = SWIMTWIN_VERSION;
} // namespace swimtwin
