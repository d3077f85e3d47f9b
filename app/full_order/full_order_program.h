// The program with the full-order model, which the tool turns into when a verb needs it.
#pragma once

#include <app/frame/library_environment.h>

namespace swimtwin
{
  /// Words that the program will be started with. First thing in main().
  void keep_command_line(char **argv);

  /// Replace this process: same number, same streams, same words. Throws ComputationError if the program is not there,
  /// or if the memory that this process may have is less than its libraries take, InputError if a launcher that MPI
  /// does not know started several ranks.
  [[noreturn]] void continue_in_full_order_program(RanksAtWork ranks);
} // namespace swimtwin
