// CPU time of a training: what it may spend, and what it spent it on.
#pragma once

#include <mpi.h>

#include <string>
#include <utility>
#include <vector>

namespace swimtwin
{
  /// Of all ranks together, since this was made: all ranks see the same numbers, so that they decide alike.
  class CpuBudget
  {
  public:
    /// Collective.
    CpuBudget(double limit_s, MPI_Comm communicator);

    /// What was used since the last booking, or the start, was used for this. Collective.
    void book(const std::string &purpose);

    double limit_s() const { return limit_s_; }
    double spent_s() const { return spent_s_; } ///< up to the last booking
    double left_s() const { return limit_s_ - spent_s_; }
    double spent_on_s(const std::string &purpose) const;
    /// "37 s full-order runs, 240 s resistance samples"
    std::string text() const;

  private:
    double of_all_ranks_s() const;

    MPI_Comm                                    communicator_;
    double                                      limit_s_, start_s_, spent_s_ = 0.;
    std::vector<std::pair<std::string, double>> entries_; ///< in the order of their first booking
  };
} // namespace swimtwin
