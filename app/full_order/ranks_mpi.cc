#include <app/frame/ranks.h>

#include <app/full_order/mpi_session.h>
#include <datasets/system/error.h>

#include <mpi.h>

#include <array>
#include <chrono>
#include <exception>
#include <limits>
#include <string>
#include <thread>

namespace swimtwin
{
  namespace
  {
    int rank()
    {
      int rank = 0;
      MPI_Comm_rank(MPI_COMM_WORLD, &rank);
      return rank;
    }

    struct Failure
    {
      enum Kind : int { none, of_input, of_computation };

      int         kind = none;
      std::string message;
    };

    Failure failure_of(const std::exception_ptr &thrown)
    {
      if (!thrown)
        return {};
      try
      {
        std::rethrow_exception(thrown);
      }
      catch (const InputError &error)
      {
        return {Failure::of_input, error.what()};
      }
      catch (const std::exception &error)
      {
        return {Failure::of_computation, error.what()};
      }
    }

    void share_with_all(Failure &failure)
    {
      std::array<int, 2> head{failure.kind, static_cast<int>(failure.message.size())};
      MPI_Bcast(head.data(), 2, MPI_INT, 0, MPI_COMM_WORLD);
      failure.kind = head[0];
      failure.message.resize(static_cast<std::size_t>(head[1]));
      MPI_Bcast(failure.message.data(), head[1], MPI_CHAR, 0, MPI_COMM_WORLD);
    }
  } // namespace

  bool is_speaker()
  {
    return rank() == 0;
  }

  void agree(const std::function<void()> &on_speaker)
  {
    std::exception_ptr thrown;
    try
    {
      if (is_speaker())
        on_speaker();
    }
    catch (...) // not to steer: thrown again below, when the others know of it
    {
      thrown = std::current_exception();
    }
    Failure failure = failure_of(thrown);
    share_with_all(failure);
    if (thrown)
      std::rethrow_exception(thrown);
    if (failure.kind == Failure::of_input)
      throw InputError(failure.message);
    if (failure.kind == Failure::of_computation)
      throw ComputationError(failure.message);
  }

  double of_speaker(double value)
  {
    MPI_Bcast(&value, 1, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    return value;
  }

  Ending end_together(const int own_exit_code)
  {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds patience(2000), pause(1);
    constexpr int                       nobody = std::numeric_limits<int>::min();
    // The largest exit code, and minus the smallest rank that failed.
    std::array<int, 2> own{own_exit_code, own_exit_code != 0 ? -rank() : nobody}, all = own;
    MPI_Request        request;
    MPI_Iallreduce(own.data(), all.data(), 2, MPI_INT, MPI_MAX, ending_communicator(), &request);
    int have_come = 0;
    for (const auto start = Clock::now(); own_exit_code == 0 || Clock::now() - start < patience;)
    {
      MPI_Test(&request, &have_come, MPI_STATUS_IGNORE);
      if (have_come != 0)
        return {all[0], true, own_exit_code != 0 && all[1] == -rank()};
      std::this_thread::sleep_for(pause);
    }
    return {own_exit_code, false, true};
  }

  void end_all_ranks(const int exit_code)
  {
    int n_ranks = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
    if (n_ranks > 1)
      MPI_Abort(MPI_COMM_WORLD, exit_code);
  }
} // namespace swimtwin
