// A line on the terminal for each stage of a long work, and a bar that moves.
#pragma once

#include <app/frame/progress_bar.h>

#include <chrono>
#include <memory>
#include <string>

namespace swimtwin
{
  class StageBar
  {
  public:
    explicit StageBar(const bool quiet) : quiet_(quiet) {}

    void show(const std::string &stage, int done, int total);

  private:
    bool                                  quiet_;
    std::string                           stage_;
    int                                   first_ = 0;
    std::chrono::steady_clock::time_point start_;
    std::unique_ptr<ProgressBar>          bar_;
  };
} // namespace swimtwin
