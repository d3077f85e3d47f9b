#include <app/frame/standard_streams.h>

#include <initializer_list>

#include <csignal>
#include <fcntl.h>
#include <initializer_list>
#include <unistd.h>

namespace swimtwin
{
  void settle_standard_streams()
  {
    for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      if (::fcntl(stream, F_GETFD) == -1)
        ::open("/dev/null", O_RDWR); // takes the lowest free number, which is this one
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow any more (ulimit -f) then fails as on a full disk
  }
} // namespace swimtwin
