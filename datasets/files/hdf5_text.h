// Text as HDF5 files of this project hold it: UTF-8 of fixed length.
#pragma once

#include <datasets/files/hdf5_file.h>

#include <cstdint>
#include <string>

namespace swimtwin
{
  Hdf5Handle make_text_type(std::size_t size);

  /// HDF5 has no texts of length 0: an empty one is stored as a single zero byte.
  std::string padded(const std::string &text);

  /// Of an open object. False if HDF5 cannot write it.
  bool write_text_attribute(std::int64_t object, const std::string &name, const std::string &text);
} // namespace swimtwin
