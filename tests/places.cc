#include <tests/places.h>

namespace swimtwin::places
{
  const char *const source = SWIMTWIN_SOURCE;
  const char *const scenes = SWIMTWIN_SOURCE "/datasets/scenes";
  const char *const models = SWIMTWIN_SOURCE "/datasets/models";
  const char *const checks = SWIMTWIN_SOURCE "/tests/pipeline";
  const char *const tool   = SWIMTWIN_TOOL;
  const char *const python = SWIMTWIN_PYTHON;
} // namespace swimtwin::places
