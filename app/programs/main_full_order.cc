// The program that the tool becomes for what solves on the full order: MPI and PETSc start before its work and end
// after.
#include <app/frame/library_environment.h>
#include <app/frame/standard_streams.h>
#include <app/frame/tool.h>
#include <app/full_order/mpi_session.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>

#include <malloc.h>
#include <optional>

int main(int argc, char **argv)
{
  using namespace swimtwin;
  settle_standard_streams();
  ::mallopt(M_ARENA_MAX, 1); // a thread of MPI would reserve 64 MB of address space for a heap of its own
  std::optional<MpiSession> session;
  try
  {
    session.emplace();
  }
  catch (const ComputationError &error)
  {
    if (launched_rank() == 0)
      remark(error.what());
    return 1;
  }
  return run_tool(argc, argv, every_verb());
}
