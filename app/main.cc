// The whole tool, on any number of ranks.
#include <app/tool.h>

#include <deal.II/base/mpi.h>
#include <petscsys.h>

int main(int argc, char **argv)
{
  using namespace swimtwin;
  // PETSc must not read our options or print stack traces of its own: its errors come back as codes.
  int                                            petsc_argc = 1;
  char                                         **petsc_argv = argv;
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(petsc_argc, petsc_argv, 1);
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  return run_tool(argc, argv,
                  {{"plan", add_plan},
                   {"simulate", add_simulate},
                   {"resistance", add_resistance},
                   {"train", add_train},
                   {"sweep", add_sweep},
                   {"reconstruct", add_reconstruct},
                   {"calibrate", add_calibrate},
                   {"optimize", add_optimize},
                   {"track", add_track},
                   {"report", add_report},
                   {"demo", add_demo}});
}
