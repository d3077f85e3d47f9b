// The tool. It reads the command line and its input and does what needs no finite elements; the rest goes on in the
// program with the full-order model.
#include <app/full_order/full_order_program.h>
#include <app/library_environment.h>
#include <app/standard_streams.h>
#include <app/tool.h>

int main(int argc, char **argv)
{
  using namespace swimtwin;
  settle_standard_streams();
  quiet_library_environment();
  keep_command_line(argv);
  return run_tool(argc, argv, every_verb());
}
