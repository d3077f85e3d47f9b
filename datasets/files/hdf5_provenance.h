// Provenance in an HDF5 file: attributes of its root.
#pragma once

#include <datasets/system/provenance.h>

#include <map>

namespace swimtwin
{
  class Hdf5Writer;

  /// All but the time that it took, which a file that grows does not know.
  std::map<std::string, std::string> provenance_texts(const Provenance &provenance);

  void write_provenance(Hdf5Writer &writer, const Provenance &provenance);
} // namespace swimtwin
