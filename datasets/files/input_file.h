// Files that a user names, and what is in the way of reading them: one sentence for each cause, with its remedy.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace swimtwin
{
  /// The first bytes of every HDF5 file.
  inline constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

  /// The whole content, whatever it is; `what` says what the file is to be ("the scene"). Throws InputError that tells
  /// apart: missing (with the nearest name in that folder, if one is close), a folder, no permission, locked, empty,
  /// and zero bytes alone.
  std::string read_content(const std::filesystem::path &file, const std::string &what);

  /// The same of a text: refused is also what stands in the place of data (see foreign_content).
  std::string read_text_file(const std::filesystem::path &file, const std::string &what);

  /// The first bytes of a regular file, for a library that opens it by itself. Throws InputError as read_text_file
  /// does.
  std::string read_first_bytes(const std::filesystem::path &file, const std::string &what, std::size_t n_bytes);

  /// What a content is instead of data, with the remedy: a pointer of Git LFS or git-annex, a web page, XML, an archive
  /// or a workbook. Nothing if it is none of these.
  std::optional<std::string> foreign_content(std::string_view content);

  /// Whether there is such a file or folder, as far as one may look: what is in the way is said when it is read.
  bool is_there(const std::filesystem::path &path);
  bool is_folder(const std::filesystem::path &path);

  inline constexpr const char *locked_by_another_program =
      "it is locked by another program, which has it open to write; wait until that has ended, or close the file there";

  /// Whether another process holds a lock on the whole file.
  bool is_locked(const std::filesystem::path &file);

  /// Throws InputError that says why a folder cannot be looked into: missing, a file, no permission.
  void require_folder(const std::filesystem::path &folder, const std::string &remedy);

  /// The InputError "cannot read <what> <file>: <cause>."
  [[noreturn]] void refuse_file(const std::filesystem::path &file, const std::string &what, const std::string &cause);
} // namespace swimtwin
