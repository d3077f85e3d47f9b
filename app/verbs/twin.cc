// Verb twin: watch a swimmer while it swims.
#include <app/frame/claimed_folder.h>
#include <app/frame/shipped_files.h>
#include <app/frame/verb.h>
#include <app/frame/written_files.h>
#include <app/trust/model_error.h>
#include <datasets/files/input_file.h>
#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <fmt/format.h>
#include <twin/run/twin_service.h>
#include <twin/stream/recorded_lines.h>

#include <memory>
#include <utility>

namespace swimtwin
{
  namespace
  {
    struct TwinCommand
    {
      CommonOptions         common;
      std::string           model, config;
      std::filesystem::path recording;
      std::optional<int>    port, page_port;
      bool                  in_real_time = false, resumes = false;
    };

    /// Of all files that decide what the twin does.
    std::string fingerprint(const std::filesystem::path &model, const TwinConfig &config)
    {
      std::string all = config.text + read_content(model, "the reduced model");
      for (const auto &file : config.files())
        all += read_content(file, "the twin's input");
      return digest(all);
    }

    void warn_of_neglected_inertia(const Scene &scene, const TwinConfig &config)
    {
      constexpr double noticed = 0.01;
      const double     share   = inertia_shares(scene, 1. / config.period_s, config.options.nominal.viscosity_Pa_s,
                                                config.options.nominal.young_modulus_Pa)
                               .together();
      if (!config.options.densities.any() && share > noticed)
        warn(fmt::format("the twin's swimmer has no inertia, {} at {:.4g} Hz: a swimmer that has is taken for one of "
                         "other stiffness and magnetization",
                         share_of_displacement(share), 1. / config.period_s));
    }

    void watch(const TwinCommand &command)
    {
      const std::filesystem::path file   = find_model(command.model);
      const ReducedModel          model  = read_reduced_model(file);
      TwinConfig                  config = read_twin_config(command.config, model);
      if (command.in_real_time && command.recording.empty())
        throw InputError("--real-time is for a recording (--replay); a stream has its own pace: leave it out.");
      if (config.steering && !command.recording.empty())
        throw InputError("a recording (--replay) cannot be steered; leave --replay or [goal] out.");
      warn_of_model_error(model, command.model);
      const bool  has_recorded_none = !command.recording.empty() && !recorded_with_inertia(command.recording);
      const Scene scene             = parse_scene(model.scene_text, model.scene_name + ".toml");
      if (has_recorded_none && !config.states_inertia)
        config.options.densities = {};
      if (!has_recorded_none)
        warn_of_neglected_inertia(scene, config);
      std::optional<RecordedStream> recorded;
      if (!command.recording.empty())
        recorded = recorded_lines(command.recording);
      OutputRequest request =
          output_request(command.common, written_by::twin(), {file, command.config, command.recording});
      for (const auto &input : config.files())
        request.inputs.push_back(input);
      request.resume = command.resumes;
      work_in_folder(request, [&](const Begun &begun) {
        ServiceOptions options;
        options.folder       = command.common.output;
        options.port         = command.port;
        options.page_port    = command.page_port;
        options.recording    = std::move(recorded);
        options.in_real_time = command.in_real_time;
        options.resumes      = command.resumes;
        options.fingerprint  = fingerprint(file, config);
        options.provenance   = {current_program_version, command.common.command_line, scene.text, scene.hash,
                                utc_time_now()};
        options.on_begun     = begun;
        serve(model, config, options);
      });
    }
  } // namespace

  Work add_twin(CLI::App &tool, const std::string &command_line)
  {
    auto  command = std::make_shared<TwinCommand>();
    auto *verb    = tool.add_subcommand(
           "twin",
           "Watch a swimmer while it swims: lines of JSON in (standard input, a port, a recording), estimates out");
    verb->add_option("model", command->model, "Reduced model (model.h5), or name of a shipped one")->required();
    verb->add_option("config", command->config, "What to estimate, and what the camera is like (TOML)")->required();
    add_output_options(*verb, command->common, OutputFolder::required);
    auto *port = verb->add_option("--listen", command->port, "Listen on this port of this machine (0: any free one)")
                     ->check(CLI::Range(0, 65535));
    verb->add_option("--page", command->page_port, "Show a live page on this port of this machine (0: any free one)")
        ->check(CLI::Range(0, 65535));
    verb->add_option("--replay", command->recording,
                     "Tracks, TrackMate or DeepLabCut tables with their sidecar, a log, or lines (.jsonl)")
        ->excludes(port);
    verb->add_flag("--real-time", command->in_real_time, "Replay at the pace of the recording's stamps");
    verb->add_flag("--resume", command->resumes, "Go on with a twin that was killed");
    command->common.command_line = command_line;
    return [command] {
      if (is_speaker())
        watch(*command);
    };
  }
} // namespace swimtwin
