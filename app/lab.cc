// Verb lab: an imagined laboratory at the other end of the twin's pipe.
#include <app/claimed_folder.h>
#include <app/shipped_files.h>
#include <app/verb.h>
#include <app/written_files.h>
#include <datasets/reduced/reduced_model.h>
#include <datasets/system/clocks.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <datasets/text/csv_writer.h>
#include <fmt/format.h>
#include <twin/lab/lab_config.h>
#include <twin/lab/lab_link.h>

#include <chrono>
#include <memory>
#include <thread>

namespace swimtwin
{
  namespace
  {
    struct LabCommand
    {
      CommonOptions         common;
      std::string           model, config;
      std::optional<int>    port;
      std::filesystem::path commands;
    };

    std::unique_ptr<LabLink> make_link(const LabCommand &command, const LabConfig &config)
    {
      const bool is_linked = command.port || !command.commands.empty();
      if (config.is_steered && !is_linked)
        throw InputError(
            fmt::format("{}: [coils] steered = true needs a twin that says what to play: --connect PORT of "
                        "`swimtwin twin ... --listen PORT`, or --commands PIPE that it writes into.",
                        command.config));
      if (command.port)
        return std::make_unique<LabLink>(*command.port);
      return is_linked ? std::make_unique<LabLink>(command.commands) : nullptr;
    }

    CsvWriter truth_table(const int n_modes)
    {
      std::vector<std::string> names = {"time_s", "x_m", "y_m", "angle_rad"};
      for (int i = 1; i <= n_modes; ++i)
        names.push_back(fmt::format("shape_{}_m", i));
      names.insert(names.end(), twin_parameter_names.begin(), twin_parameter_names.end());
      return CsvWriter(names);
    }

    void run(const LabCommand &command)
    {
      const std::filesystem::path file    = find_model(command.model);
      const ReducedModel          model   = read_reduced_model(file);
      const LabConfig             config  = read_lab_config(command.config, model);
      CsvWriter                   truth   = truth_table(model.n_modes());
      const auto                  link    = make_link(command, config);
      const double                start_s = wall_time_s();
      LabEnds                     ends;
      ends.send = [&](const double arrives_s, const std::string &line) {
        const double ahead_s = config.real_time > 0. ? arrives_s / config.real_time - (wall_time_s() - start_s) : 0.;
        if (ahead_s > 0.)
          std::this_thread::sleep_for(std::chrono::duration<double>(ahead_s));
        if (link)
        {
          if (!config.is_steered) // what the twin says is taken away, or it would wait
            static_cast<void>(link->hear(arrives_s, false));
          return link->send(line);
        }
        say_text(line + '\n');
        return true;
      };
      // As fast as it goes, the laboratory's time stands still until the twin has decided.
      ends.hear      = [&](const double clock_s) { return link->hear(clock_s, config.real_time <= 0.); };
      const auto run = [&] {
        run_laboratory(model, config, ends);
        if (link)
          link->finish();
      };
      if (command.common.output.empty())
        return run();
      ends.truth = [&](const LabTruth &instant) {
        truth.cell(instant.time_s);
        for (const double value : instant.state)
          truth.cell(value);
        truth.end_row();
      };
      work_in_folder(output_request(command.common, written_by::lab(), {file, command.config}), [&](const Begun &) {
        run();
        truth.save(command.common.output / "truth.csv");
      });
    }
  } // namespace

  Work add_lab(CLI::App &tool, const std::string &command_line)
  {
    auto  command = std::make_shared<LabCommand>();
    auto *verb    = tool.add_subcommand("lab", "Imagine a laboratory: frames of a swimmer as lines for the twin");
    verb->add_option("model", command->model, "Reduced model (model.h5), or name of a shipped one")->required();
    verb->add_option("config", command->config, "Swimmer, camera, coils and what goes wrong (TOML)")->required();
    add_output_options(*verb, command->common, OutputFolder::optional);
    auto *port = verb->add_option("--connect", command->port, "Talk to the twin that listens on this port")
                     ->check(CLI::Range(1, 65535));
    verb->add_option("--commands", command->commands, "Read what the coils shall play from this named pipe")
        ->excludes(port);
    command->common.command_line = command_line;
    return [command] {
      if (is_speaker())
        run(*command);
    };
  }
} // namespace swimtwin
