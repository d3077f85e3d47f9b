// A line on the terminal that says how far a run is and how long it will still take.
#pragma once

#include <string>

namespace swimtwin
{
  /// Silent when standard error is not a terminal or when asked to be.
  class ProgressBar
  {
  public:
    explicit ProgressBar(bool quiet);
    ~ProgressBar();
    ProgressBar(const ProgressBar &)            = delete;
    ProgressBar &operator=(const ProgressBar &) = delete;

    /// `rate_steps` steps took `elapsed_s`; they are not all that is done when a run was resumed.
    void show(int done, int total, int rate_steps, double elapsed_s);

  private:
    bool   visible_;
    double last_shown_s_ = -1.;
  };
} // namespace swimtwin
