// Where on this machine the tests find things.
#pragma once

namespace swimtwin::places
{
  extern const char *const source; ///< the project's top folder
  extern const char *const scenes; ///< datasets/scenes
  extern const char *const models; ///< datasets/models
  extern const char *const checks; ///< tests/pipeline, with its Python scripts
  extern const char *const tool;   ///< the built tool
  extern const char *const python; ///< the system's Python, which packages such as python3-h5py are for
} // namespace swimtwin::places
