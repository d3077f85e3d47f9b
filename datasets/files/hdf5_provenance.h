// Provenance in an HDF5 file: attributes of its root.
#pragma once

#include <datasets/system/provenance.h>

namespace swimtwin
{
  class Hdf5Writer;

  void write_provenance(Hdf5Writer &writer, const Provenance &provenance);
} // namespace swimtwin
