// The tool. It reads the command line and its input and does what needs no finite elements; the rest goes on in the
// program with the full-order model.
#include <app/frame/library_environment.h>
#include <app/frame/standard_streams.h>
#include <app/frame/tool.h>
#include <app/full_order/full_order_program.h>

int main(int argc, char **argv)
{
  using namespace swimtwin;
  settle_standard_streams();
  quiet_library_environment();
  keep_command_line(argv);
  return run_tool(argc, argv, every_verb());
}
