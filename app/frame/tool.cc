#include <app/frame/tool.h>

#include <app/frame/command_words.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>

#include <fmt/format.h>

#include <filesystem>
#include <new>
#include <sstream>
#include <system_error>

namespace swimtwin
{
  namespace
  {
    constexpr int exit_failed = 1, exit_bad_input = 2;

    struct Result
    {
      int         exit_code = 0;
      std::string failure;
    };

    /// A file or folder that could not be reached, by somebody who did not say more.
    Result result_of(const std::filesystem::filesystem_error &error)
    {
      const std::string reason = error.code().message();
      if (error.path1().empty())
        return {exit_bad_input,
                fmt::format("the working folder is not there any more ({}); change into one that is", reason)};
      return {exit_failed, fmt::format("{} cannot be reached: {}", error.path1().string(), reason)};
    }

    /// Do something, and turn what it throws into an exit code and a sentence: the one place for errors.
    template <typename Task>
    Result result_of(const Task &task)
    {
      try
      {
        task();
        return {};
      }
      catch (const InputError &error)
      {
        return {exit_bad_input, error.what()};
      }
      catch (const ComputationError &error)
      {
        return {exit_failed, error.what()};
      }
      catch (const std::bad_alloc &)
      {
        return {exit_failed,
                "memory ran out; use a coarser mesh, fewer members or threads at a time, or allow more memory"};
      }
      catch (const std::filesystem::filesystem_error &error)
      {
        return result_of(error);
      }
      catch (const std::system_error &error)
      {
        return {exit_failed,
                fmt::format("the machine refused what was asked of it ({}); close other programs, raise the "
                            "limits that ulimit -a shows, or use fewer --threads",
                            error.code().message())};
      }
      catch (const std::exception &error)
      {
        return {exit_failed, std::string("a defect of swimtwin, please report it: ") + error.what()};
      }
    }

    /// Say what went wrong, once, and end together with the other ranks. Returns the exit code.
    int finish(Result result)
    {
      if (const std::string loss = why_output_was_lost(); result.exit_code == 0 && !loss.empty())
        result = {exit_failed,
                  fmt::format("standard output cannot be written: {}; send it elsewhere and run again", loss)};
      const bool failed = result.exit_code != 0, speaks_at_once = failed && is_speaker();
      if (speaks_at_once)
        remark(result.failure);
      const Ending ending = end_together(result.exit_code);
      if (failed && !speaks_at_once && ending.is_to_speak)
        remark(result.failure);
      if (!ending.all_came)
        end_all_ranks(result.exit_code);
      return ending.exit_code;
    }

    std::string command_line_of(const std::vector<std::string> &words)
    {
      std::string command_line = "swimtwin";
      for (const std::string &word : words)
        command_line += " " + word;
      return command_line;
    }

    void explain(const CLI::App &tool, const CLI::ParseError &help_or_version)
    {
      std::ostringstream text;
      tool.exit(help_or_version, text, text);
      if (is_speaker())
        say_text(text.str());
    }

    /// True if there is work to do.
    bool parse(CLI::App &tool, const int argc, char **argv)
    {
      try
      {
        tool.parse(argc, argv);
        return true;
      }
      catch (const CLI::ParseError &error)
      {
        if (error.get_exit_code() != 0)
          throw InputError(fmt::format("{}; see swimtwin {} --help", error.what(), argv[1]));
        explain(tool, error);
        return false;
      }
    }
  } // namespace

  int run_tool(const int argc, char **argv, const std::vector<Verb> &verbs)
  {
    return finish(result_of([&] {
      const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
      const std::string              command_line = command_line_of(words);
      CLI::App                       tool(
                                "Elastic magneto-swimmers in viscous fluids: simulation and prediction of a soft micro-robot with a "
                                                      "magnetic head.",
                                "swimtwin");
      tool.set_version_flag("--version", current_program_version);
      tool.require_subcommand(1);
      std::vector<std::pair<const char *, Work>> works;
      for (const auto &[name, add] : verbs)
        works.emplace_back(name, add(tool, command_line));
      check_command_words(tool, words);
      if (!parse(tool, argc, argv))
        return;
      for (const auto &[name, work] : works)
        if (tool.got_subcommand(name))
          work();
    }));
  }
} // namespace swimtwin
