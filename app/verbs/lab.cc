// Verb lab: an imagined laboratory at the other end of the twin's pipe.
#include <app/frame/claimed_folder.h>
#include <app/frame/shipped_files.h>
#include <app/frame/verb.h>
#include <app/frame/written_files.h>
#include <app/full_order/full_order_laboratory.h>
#include <app/trust/model_error.h>
#include <datasets/reduced/reduced_model.h>
#include <datasets/system/clocks.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <datasets/text/csv_writer.h>
#include <fmt/format.h>
#include <twin/lab/lab_link.h>
#include <twin/lab/lab_run.h>

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

    /// The laboratory's swimmer, and what was read for it.
    struct Imagined
    {
      std::filesystem::path       file;
      std::optional<ReducedModel> model; ///< none: the scene's own swimmer
      Scene                       scene;
      LabConfig                   config;
    };

    Imagined imagine(const LabCommand &command)
    {
      Imagined imagined;
      if (is_model(command.model))
      {
        imagined.file   = find_model(command.model);
        imagined.model  = read_reduced_model(imagined.file);
        imagined.scene  = parse_scene(imagined.model->scene_text, imagined.model->scene_name + ".toml");
        imagined.config = read_lab_config(command.config, *imagined.model);
        warn_of_model_error(*imagined.model, command.model);
      }
      else
      {
        imagined.file   = find_scene(command.model);
        imagined.scene  = read_scene(imagined.file);
        imagined.config = read_lab_config(command.config, imagined.scene);
      }
      return imagined;
    }

    CsvWriter truth_table(const LaboratorySwimmer &swimmer)
    {
      std::vector<std::string> names = swimmer.truth_names();
      names.insert(names.begin(), "time_s");
      return CsvWriter(names);
    }

    LabEnds ends_of(const LabConfig &config, LabLink *link)
    {
      const double start_s = wall_time_s();
      LabEnds      ends;
      ends.send = [&config, link, start_s](const double arrives_s, const std::string &line) {
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
      ends.hear = [&config, link](const double clock_s) { return link->hear(clock_s, config.real_time <= 0.); };
      return ends;
    }

    void film(const LabCommand &command, const Imagined &imagined, CoilDriver &coils, LaboratorySwimmer &swimmer)
    {
      const LabConfig &config = imagined.config;
      Laboratory       lab(coils, swimmer, config.options.camera, config.options.seed);
      const auto       link = make_link(command, config);
      LabEnds          ends = ends_of(config, link.get());
      const auto       run  = [&] {
        run_laboratory(lab, config, ends);
        if (link)
          link->finish();
      };
      if (command.common.output.empty())
        return run();
      CsvWriter truth = truth_table(swimmer);
      ends.truth      = [&](const LabTruth &instant) {
        truth.cell(instant.time_s);
        for (const double value : instant.state)
          truth.cell(value);
        truth.end_row();
      };
      work_in_folder(output_request(command.common, written_by::lab(), {imagined.file, command.config}),
                     [&](const Begun &) {
                       run();
                       truth.save(command.common.output / "truth.csv");
                     });
    }

    void run(const LabCommand &command)
    {
      const Imagined           imagined = imagine(command);
      const LaboratoryOptions &options  = imagined.config.options;
      CoilDriver               coils(options.coils);
      if (imagined.config.swimmer == LabSwimmer::full_order)
      {
        const auto swimmer = make_full_order_laboratory_swimmer(imagined.scene, imagined.config, coils.played());
        return film(command, imagined, coils, *swimmer);
      }
      const ReducedSwimmer     reduced(*imagined.model, options.densities);
      const TailAxis           axis(imagined.model->tail);
      ReducedLaboratorySwimmer swimmer(reduced, axis, coils.played(), options);
      film(command, imagined, coils, swimmer);
    }
  } // namespace

  Work add_lab(CLI::App &tool, const std::string &command_line)
  {
    auto  command = std::make_shared<LabCommand>();
    auto *verb    = tool.add_subcommand("lab", "Imagine a laboratory: frames of a swimmer as lines for the twin");
    verb->add_option("model", command->model,
                     "Reduced model (model.h5), or a scene for its full-order swimmer; or a shipped name")
        ->required();
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
