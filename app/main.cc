// The command-line tool: one verb per file, one place for errors.
#include <app/verb.h>

#include <datasets/error.h>

#include <deal.II/base/mpi.h>
#include <petscsys.h>

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <thread>

namespace
{
  constexpr int exit_failed = 1, exit_bad_input = 2;

  /// Say what went wrong, once. Other ranks may wait for this one for ever, so they are ended with it.
  int fail(const std::string &message, const int code)
  {
    int n_ranks = 1, rank = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank > 0) // most errors are noticed by all: let rank 0 speak for them and end them
      std::this_thread::sleep_for(std::chrono::seconds(2));
    fmt::print(stderr, "swimtwin: {}\n", message);
    std::fflush(stderr);
    if (n_ranks > 1)
      MPI_Abort(MPI_COMM_WORLD, code);
    return code;
  }

  int run(int argc, char **argv)
  {
    using namespace swimtwin;
    std::string command_line = "swimtwin";
    for (int i = 1; i < argc; ++i)
      command_line += std::string(" ") + argv[i];

    CLI::App tool(
        "Elastic magneto-swimmers in viscous fluids: full-order simulation of a soft micro-robot with a magnetic head.",
        "swimtwin");
    tool.set_version_flag("--version", SWIMTWIN_VERSION);
    tool.require_subcommand(1);
    const std::pair<const char *, Work> verbs[] = {{"plan", add_plan(tool, command_line)},
                                                   {"simulate", add_simulate(tool, command_line)},
                                                   {"resistance", add_resistance(tool, command_line)},
                                                   {"report", add_report(tool, command_line)},
                                                   {"demo", add_demo(tool, command_line)}};
    try
    {
      tool.parse(argc, argv);
    }
    catch (const CLI::ParseError &error)
    {
      if (error.get_exit_code() == 0) // --help, --version
        return is_speaker() ? tool.exit(error) : 0;
      return fail(error.what() + std::string("; see swimtwin --help"), exit_bad_input);
    }
    try
    {
      for (const auto &[name, work] : verbs)
        if (tool.got_subcommand(name))
          work();
      return 0;
    }
    catch (const InputError &error)
    {
      return fail(error.what(), exit_bad_input);
    }
    catch (const ComputationError &error)
    {
      return fail(error.what(), exit_failed);
    }
    catch (const std::exception &error)
    {
      return fail(std::string("a defect of swimtwin, please report it: ") + error.what(), exit_failed);
    }
  }
} // namespace

int main(int argc, char **argv)
{
  // PETSc must not read our options or print stack traces of its own: its errors come back as codes.
  int                                            petsc_argc = 1;
  char                                         **petsc_argv = argv;
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(petsc_argc, petsc_argv, 1);
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  return run(argc, argv);
}
