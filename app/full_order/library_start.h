// Libraries that end the program, or talk at length, when they cannot be started.
#pragma once

namespace swimtwin
{
  /// For the time of its life: standard error is held back, the working folder exists, and a library that calls exit()
  /// or abort() ends the program with one sentence of ours and exit code 1. What was held back is passed on at the end
  /// of a start that succeeds. From the first one on, abort() is answered by a sentence and exit code 1.
  class LibraryStart
  {
  public:
    LibraryStart();
    ~LibraryStart();
    LibraryStart(const LibraryStart &)            = delete;
    LibraryStart &operator=(const LibraryStart &) = delete;

    /// End the program with the sentence, for a library that throws.
    [[noreturn]] static void give_up();

  private:
    int working_folder_ = -1; ///< if it was deleted: what leads back to it
  };
} // namespace swimtwin
