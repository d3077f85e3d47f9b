// The command-line tool with a list of verbs.
#pragma once

#include <app/frame/verb.h>

#include <vector>

namespace swimtwin
{
  struct Verb
  {
    const char *name;
    Work (*add)(CLI::App &tool, const std::string &command_line);
  };

  /// Those of the online build: they need neither finite elements nor MPI.
  std::vector<Verb> online_verbs();
  /// Those of the full build.
  std::vector<Verb> every_verb();

  /// Read the command line, do the verb's work, say what went wrong: the one place for errors. Returns the exit code.
  int run_tool(int argc, char **argv, const std::vector<Verb> &verbs);
} // namespace swimtwin
