// The readers of files that others write, each with valid files to start from.
#pragma once

#include <tests/fuzz/text_mutation.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace swimtwin
{
  struct FuzzedReader
  {
    std::string                        name;
    std::string                        file_name; ///< of the mutant
    std::vector<std::string>           seeds;     ///< contents of valid files
    std::map<std::string, std::string> beside;    ///< name and content of the files that it is read with
    bool                               is_hdf5 = false;

    std::function<void(const std::filesystem::path &)> read;
    /// What is done to a mutant at last, if anything: a checksum that is right again.
    std::function<void(const std::filesystem::path &)> finish = {};
  };

  /// Of the online half: scenes, surfaces, fields, curves, tracks, goals, problems, results, models.
  std::vector<FuzzedReader> online_readers();

  /// Those, and in the full build those of the full order: checkpoints.
  std::vector<FuzzedReader> all_readers();

  /// A mutant of one of the reader's seeds. The same numbers make the same mutant.
  void write_mutant(const FuzzedReader &reader, const std::filesystem::path &file, RandomNumbers &random);

  /// From here on this process ends when one reading takes a minute or gigabytes of memory.
  void limit_reading();

  /// What is wrong with how a reader takes a file; empty if it reads it, or refuses it in our words, within some
  /// seconds and some hundreds of MB.
  std::string fault_of(const FuzzedReader &reader, const std::filesystem::path &file);
} // namespace swimtwin
