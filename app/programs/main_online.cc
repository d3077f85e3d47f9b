// The tool of the online build: the verbs that need neither finite elements nor MPI.
#include <app/frame/library_environment.h>
#include <app/frame/standard_streams.h>
#include <app/frame/tool.h>

int main(int argc, char **argv)
{
  using namespace swimtwin;
  settle_standard_streams();
  quiet_library_environment();
  return run_tool(argc, argv, online_verbs());
}
