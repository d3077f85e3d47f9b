// The results that --force replaces: out of the way before the new run writes, and back if it never gets that far.
#pragma once

#include <datasets/files/file_patterns.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// What a verb writes, by name: declared once for refusal, replacement and documentation.
  struct WrittenFiles
  {
    std::string  verb;
    FilePatterns patterns;
    std::string  only_when_interrupted; ///< a file that is gone when the run is complete; empty: there is none
    std::string  only_when_complete;    ///< a file that comes last; empty: none that tells an interrupted run
    std::string  shared  = {};          ///< the one of the patterns that files of other verbs need as well
    FilePatterns sharers = {};          ///< any of these in the folder, if they are not among the patterns
  };

  /// What is there of a verb's files, but for the one that others still need.
  std::vector<std::filesystem::path> files_of_verb(const std::filesystem::path &folder, const WrittenFiles &files);

  /// Earlier results of a verb, set aside in a hidden folder of their folder.
  class EarlierResults
  {
  public:
    /// Move what is there. Throws ComputationError, with all of it back in place, if that cannot be done.
    EarlierResults(std::filesystem::path folder, WrittenFiles files);

    bool are_aside() const { return !aside_.empty(); }

    /// Remove them for good.
    void drop();
    /// Put them back unless something of the new run is there: then remove them. Returns whether they are back.
    bool restore_or_drop();

  private:
    std::filesystem::path folder_, aside_;
    WrittenFiles          files_;
  };

  /// What a killed run left aside: the same as restore_or_drop.
  void settle_earlier_results(const std::filesystem::path &folder, const std::vector<WrittenFiles> &all);
} // namespace swimtwin
