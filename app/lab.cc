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
#include <twin/lab/lab_config.h>

#include <chrono>
#include <memory>
#include <thread>

namespace swimtwin
{
  namespace
  {
    struct LabCommand
    {
      CommonOptions common;
      std::string   model, config;
    };

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
      const double                start_s = wall_time_s();
      const auto                  send    = [&](const double arrives_s, const std::string &line) {
        const double ahead_s = config.real_time > 0. ? arrives_s / config.real_time - (wall_time_s() - start_s) : 0.;
        if (ahead_s > 0.)
          std::this_thread::sleep_for(std::chrono::duration<double>(ahead_s));
        say_text(line + '\n');
        return true;
      };
      const auto note = [&](const LabTruth &instant) {
        truth.cell(instant.time_s);
        for (const double value : instant.state)
          truth.cell(value);
        truth.end_row();
      };
      if (command.common.output.empty())
        return run_laboratory(model, config, send, [](const LabTruth &) {});
      work_in_folder(output_request(command.common, written_by::lab(), {file, command.config}), [&](const Begun &) {
        run_laboratory(model, config, send, note);
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
    command->common.command_line = command_line;
    return [command] {
      if (is_speaker())
        run(*command);
    };
  }
} // namespace swimtwin
