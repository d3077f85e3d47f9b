#include <app/tool.h>

#include <datasets/error.h>
#include <datasets/provenance.h>

#include <fmt/format.h>

#include <cstdio>

namespace swimtwin
{
  namespace
  {
    constexpr int exit_failed = 1, exit_bad_input = 2;

    /// Say what went wrong, once.
    int fail(const std::string &message, const int code)
    {
      let_speaker_go_first();
      fmt::print(stderr, "swimtwin: {}\n", message);
      std::fflush(stderr);
      end_all_ranks(code);
      return code;
    }

    std::string command_line_of(const int argc, char **argv)
    {
      std::string command_line = "swimtwin";
      for (int i = 1; i < argc; ++i)
        command_line += std::string(" ") + argv[i];
      return command_line;
    }

    int work_of_chosen(const CLI::App &tool, const std::vector<std::pair<const char *, Work>> &works)
    {
      try
      {
        for (const auto &[name, work] : works)
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

  int run_tool(const int argc, char **argv, const std::vector<Verb> &verbs)
  {
    const std::string command_line = command_line_of(argc, argv);
    CLI::App tool("Elastic magneto-swimmers in viscous fluids: simulation and prediction of a soft micro-robot with a "
                  "magnetic head.",
                  "swimtwin");
    tool.set_version_flag("--version", current_program_version);
    tool.require_subcommand(1);
    std::vector<std::pair<const char *, Work>> works;
    for (const auto &[name, add] : verbs)
      works.emplace_back(name, add(tool, command_line));
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
    return work_of_chosen(tool, works);
  }
} // namespace swimtwin
