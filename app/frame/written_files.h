// What each verb writes, declared once: refused without --force, replaced with it, and listed in docs/file-formats.md.
#pragma once

#include <datasets/files/earlier_results.h>

#include <vector>

namespace swimtwin
{
  namespace written_by
  {
    // Verbs that write files of the same names share a declaration: one replaces the other as a whole.
    const WrittenFiles &simulate(); ///< and reconstruct
    const WrittenFiles &optimize(); ///< and track
    const WrittenFiles &resistance();
    const WrittenFiles &train();
    const WrittenFiles &sweep();
    const WrittenFiles &calibrate();
    const WrittenFiles &report();
    const WrittenFiles &plan();
    const WrittenFiles &demo();
    const WrittenFiles &twin();
    const WrittenFiles &lab();
  } // namespace written_by

  std::vector<WrittenFiles> all_written_files();
} // namespace swimtwin
