// The tool of the online build: the verbs that need neither finite elements nor MPI.
#include <app/library_environment.h>
#include <app/standard_streams.h>
#include <app/tool.h>

int main(int argc, char **argv)
{
  using namespace swimtwin;
  settle_standard_streams();
  quiet_library_environment();
  return run_tool(argc, argv, online_verbs());
}
