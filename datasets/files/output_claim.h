// A folder that a run has to itself, without what an earlier run left there.
#pragma once

#include <datasets/files/earlier_results.h>
#include <datasets/files/folder_lock.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// What a run wants of its folder.
  struct OutputRequest
  {
    std::filesystem::path              folder;
    WrittenFiles                       files;
    std::vector<std::filesystem::path> inputs; ///< files that the run reads, never to be replaced by it
    std::string                        command_line;
    bool                               force  = false; ///< replace earlier results
    bool                               resume = false; ///< go on with them
  };

  /// Made when all input has been found right, and before the run writes anything.
  class OutputClaim
  {
  public:
    /// Makes the folder, locks it, clears away what killed runs left half-written, and refuses earlier results, sets
    /// them aside (`force`) or leaves them (`resume`). `all` are the files of every verb. Throws InputError if the
    /// folder cannot be made or written to, another run is in it, results are in the way, or an input would be
    /// replaced.
    OutputClaim(const OutputRequest &request, const std::vector<WrittenFiles> &all);
    OutputClaim(const OutputClaim &)            = delete;
    OutputClaim &operator=(const OutputClaim &) = delete;
    ~OutputClaim();

    /// The run is on its way: earlier results go for good.
    void begin();
    /// After a failure: put earlier results back if nothing of the new run is there. Says what became of them.
    std::string settle();
    /// Why a second run would not be noticed; empty when all is well.
    const std::string &doubt() const { return lock_.doubt(); }

  private:
    std::filesystem::path folder_;
    FolderLock            lock_;
    EarlierResults        earlier_;
  };
} // namespace swimtwin
