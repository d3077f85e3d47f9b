// A laboratory's end of a pipe or port to a twin that steers it.
#pragma once

#include <twin/stream/line_reader.h>
#include <twin/stream/message.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  class LabLink
  {
  public:
    /// To a port of this machine. Throws InputError if nobody listens there.
    explicit LabLink(int port);
    /// What the twin says comes through this file, a named pipe; what the laboratory says goes to standard output.
    explicit LabLink(const std::filesystem::path &commands);
    ~LabLink();
    LabLink(const LabLink &)            = delete;
    LabLink &operator=(const LabLink &) = delete;

    /// False if the twin is gone.
    bool send(const std::string &line);
    /// What the twin has the coils play. With `waits` until it has answered the clock's line of this instant, else what
    /// has come already. Throws ComputationError if it does not answer.
    std::vector<PlayMessage> hear(double clock_s, bool waits);
    /// Nothing comes any more: waits until the twin has said all, so that nothing is lost on the way.
    void finish();

  private:
    int        in_ = -1, out_ = -1;
    LineReader reader_;
    bool       has_ended_ = false;
  };
} // namespace swimtwin
