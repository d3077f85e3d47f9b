// The tool of the online build: the verbs that need neither finite elements nor MPI.
#include <app/library_environment.h>
#include <app/standard_streams.h>
#include <app/tool.h>

int main(int argc, char **argv)
{
  using namespace swimtwin;
  settle_standard_streams();
  quiet_library_environment();
  return run_tool(argc, argv,
                  {{"sweep", add_sweep},
                   {"reconstruct", add_reconstruct},
                   {"calibrate", add_calibrate},
                   {"optimize", add_optimize},
                   {"track", add_track},
                   {"twin", add_twin},
                   {"lab", add_lab},
                   {"report", add_report}});
}
