#include <app/full_order/full_order_program.h>

#include <datasets/system/error.h>
#include <datasets/system/memory_limits.h>

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>
#include <unistd.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr const char *program_name = "swimtwin-full-order";

    char **command_line = nullptr;

    fs::path program_beside_this_one()
    {
      std::error_code error;
      const fs::path  tool = fs::read_symlink("/proc/self/exe", error);
      if (error)
        throw ComputationError(fmt::format("the tool cannot find its own folder, and {} in it ({}); mount /proc",
                                           program_name, error.message()));
      return tool.parent_path() / program_name;
    }
  } // namespace

  void keep_command_line(char **argv)
  {
    command_line = argv;
  }

  void continue_in_full_order_program(const RanksAtWork ranks)
  {
    // Measured: address space and data of the process when MPI and PETSc have started and the BLAS has its buffer.
    constexpr MemoryNeed libraries{640., 165., 150.};
    require_memory("starting the libraries of the full-order model", libraries, "close other programs");
    const fs::path program = program_beside_this_one();
    if (const std::string launcher = unknown_launcher(); ranks == RanksAtWork::all && !launcher.empty())
      throw InputError(fmt::format("{} started several tasks, which MPI cannot bring together here; start the tool by "
                                   "mpirun -n N, or as one task.",
                                   launcher));
    settle_mpi_environment(ranks);
    ::execv(program.c_str(), command_line);
    const int reason = errno;
    throw ComputationError(fmt::format("{}, which holds the full-order model, cannot be started ({}); copy it with the "
                                       "tool into one folder, or build both with scripts/build release",
                                       program.string(), std::generic_category().message(reason)));
  }
} // namespace swimtwin
