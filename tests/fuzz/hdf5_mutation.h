// Mutants of HDF5 files that HDF5 itself finds in order.
#pragma once

#include <tests/fuzz/text_mutation.h>

#include <filesystem>

namespace swimtwin
{
  /// One to three objects or attributes of the file are taken out, or have another shape, kind or extent, or numbers
  /// that are no indices, not finite, or not of this size.
  void mutate_hdf5(const std::filesystem::path &file, RandomNumbers &random);
} // namespace swimtwin
