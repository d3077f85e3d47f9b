// How long old factors, or another costly preconditioner, serve.
#pragma once

namespace swimtwin
{
  /// They have served their time when a solve costs more than the average since they were made, their making included:
  /// the marginal cost then raises the mean. Efforts are counted in iterations.
  class KeptFactors
  {
  public:
    void make(const int effort)
    {
      n_solves_ = 0;
      effort_   = effort;
      is_worn_  = false;
    }

    void note_solve(const int iterations)
    {
      effort_ += iterations;
      ++n_solves_;
      is_worn_ = iterations * n_solves_ > effort_;
    }

    bool are_worn() const { return is_worn_; }

  private:
    int  n_solves_ = 0, effort_ = 0;
    bool is_worn_ = false;
  };
} // namespace swimtwin
