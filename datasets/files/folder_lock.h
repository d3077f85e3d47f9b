// One run at a time in a folder.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace swimtwin
{
  class HeldLock;

  /// Held as long as the object lives, by a lock of the kernel on a hidden file of the folder: it ends with the
  /// process, however that ends. Within a process a folder may be locked again: verbs that use others, and runs within
  /// runs.
  class FolderLock
  {
  public:
    /// Throws InputError that says who works in the folder, if another process does. A file system without locks is in
    /// nobody's way: then `doubt` says so.
    FolderLock(const std::filesystem::path &folder, const std::string &command_line);

    bool               is_outermost() const { return outermost_; } ///< of this process in this folder
    const std::string &doubt() const;

  private:
    std::shared_ptr<HeldLock> held_;
    bool                      outermost_ = false;
  };

  /// Who works in the folder ("process 12 on host since ...: command"), if another process does. Nothing is written.
  std::optional<std::string> run_in(const std::filesystem::path &folder);
} // namespace swimtwin
