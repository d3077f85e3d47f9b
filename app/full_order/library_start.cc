#include <app/full_order/library_start.h>

#include <app/frame/library_environment.h>
#include <datasets/system/console.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <sstream>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace swimtwin
{
  namespace
  {
    /// Standard error as it was and what stands in for it, while libraries start; -1 else.
    int real_error = -1, held_back = -1;

    void give_standard_error_back()
    {
      if (real_error >= 0)
        ::dup2(real_error, STDERR_FILENO);
    }

    std::string words_held_back()
    {
      std::string text;
      if (held_back < 0)
        return text;
      ::lseek(held_back, 0, SEEK_SET);
      char block[4096];
      for (ssize_t n = ::read(held_back, block, sizeof block); n > 0; n = ::read(held_back, block, sizeof block))
        text.append(block, static_cast<std::size_t>(n));
      return text;
    }

    /// The first of the libraries' own words, on one line and without rules of dashes.
    std::string beginning_of(const std::string &text)
    {
      constexpr std::size_t most = 240;
      std::istringstream    words(text);
      std::string           line;
      for (std::string word; line.size() < most && words >> word;)
        if (word.find_first_not_of('-') != std::string::npos)
          line += (line.empty() ? "" : " ") + word;
      return line;
    }

    [[noreturn]] void end_process(const int exit_code)
    {
      for (;;)
        ::syscall(SYS_exit_group, exit_code);
    }

    [[noreturn]] void end_with_sentence()
    {
      const std::string words = beginning_of(words_held_back());
      give_standard_error_back();
      if (launched_rank() != 0)
        ::sleep(1); // rank 0 fails for the same reason, and mpirun ends all when it has spoken
      remark("MPI and PETSc, which the full-order model needs, cannot be started here" +
             (words.empty() ? std::string() : " (" + words + ")") +
             "; check the settings of MPI on this machine, or start the tool without mpirun");
      end_process(1);
    }

    void end_of_process()
    {
      if (real_error >= 0)
        end_with_sentence();
    }

    void on_abort(int /*signal*/)
    {
      if (real_error >= 0)
        end_with_sentence();
      constexpr char sentence[] =
          "swimtwin: a library of the full-order model gave up, for lack of memory or over a shape that it cannot "
          "mesh; use a coarser mesh or allow more memory, or blunt what is thinner than [numerics] "
          "mesh_size_corner_m\n";
      [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, sentence, sizeof sentence - 1);
      end_process(1);
    }

    void watch_the_end()
    {
      static const bool watched = std::atexit(end_of_process) == 0 && std::signal(SIGABRT, on_abort) != SIG_ERR;
      static_cast<void>(watched);
      std::set_terminate([] { std::abort(); }); // without the lines of the C++ library before our sentence
    }

    /// A folder to go back to, if the present one has no name any more: libraries insist on one.
    int leave_deleted_folder()
    {
      char path[4096];
      if (::getcwd(path, sizeof path) != nullptr)
        return -1;
      const int folder = ::open(".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
      return ::chdir("/") == 0 ? folder : -1;
    }
  } // namespace

  LibraryStart::LibraryStart() : working_folder_(leave_deleted_folder())
  {
    watch_the_end();
    real_error = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    held_back  = ::memfd_create("words of libraries", MFD_CLOEXEC);
    if (held_back >= 0)
      ::dup2(held_back, STDERR_FILENO);
  }

  void LibraryStart::give_up()
  {
    end_with_sentence();
  }

  LibraryStart::~LibraryStart()
  {
    const std::string words = words_held_back();
    give_standard_error_back();
    ::close(real_error);
    ::close(held_back);
    real_error = held_back = -1;
    if (working_folder_ >= 0) [[maybe_unused]]
      const int back = ::fchdir(working_folder_);
    ::close(working_folder_);
    mutter(words);
  }
} // namespace swimtwin

/// In the place of the C library's, for Open MPI, which ends a process in this way when it cannot start: held back
/// words would be lost.
extern "C" void _exit(const int exit_code)
{
  swimtwin::end_of_process();
  swimtwin::end_process(exit_code);
}
