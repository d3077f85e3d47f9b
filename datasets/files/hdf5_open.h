// Opening HDF5 files to read, and the checksum of those whose content must not be trusted without one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace swimtwin
{
  void silence_hdf5();

  /// HDF5's number of the open file. Throws InputError that tells apart what read_first_bytes does, and: locked by
  /// another program, cut short, not HDF5, damaged.
  std::int64_t open_hdf5_file(const std::string &name);

  /// Bytes to stand behind the content of a file, which HDF5 does not look at: its SHA-256.
  std::string seal_of(const std::string &content);

  /// Throws InputError with the remedy if a file does not end with the seal of what is before it.
  void require_seal(const std::filesystem::path &file, const std::string &remedy);
} // namespace swimtwin
