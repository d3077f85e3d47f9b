#include <app/full_order/field_replay.h>

#include <app/frame/progress_bar.h>
#include <control/goal/measured_field.h>
#include <control/stroke/settled_start.h>
#include <datasets/files/output_folder.h>
#include <datasets/scene/field_program_writer.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/scene/scene_field.h>
#include <datasets/system/error.h>
#include <fom/run/simulation.h>
#include <reports/plan/plan_files.h>
#include <rom/training/posed_body.h>

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    Scene replay_scene(const ReducedModel &model, const PlanResult &plan, const std::filesystem::path &program,
                       const double period_s, const std::array<double, 2> &center_m, const double angle_rad,
                       const ReplayOptions &options)
    {
      const std::string file = std::filesystem::absolute(program).string();
      return parse_scene(with_field_program(model.scene_text, file, period_s), model.scene_name + ".toml",
                         {fmt::format("head.angle_rad={:.17g}", angle_rad),
                          fmt::format("head.center_m=[{:.17g}, {:.17g}]", center_m[0], center_m[1]),
                          fmt::format("head.magnetization_A_m={:.17g}", plan.magnetization_A_m),
                          fmt::format("tail.young_modulus_Pa={:.17g}", plan.young_modulus_Pa),
                          fmt::format("fluid.viscosity_Pa_s={:.17g}", plan.viscosity_Pa_s),
                          "output.snapshots_per_period=30", // to refine the model with
                          inertia_override(plan.inertia),   // as the reduced swimmer: the comparison is about the rest
                          fmt::format("time.periods={:.1f}", double(options.periods)),
                          fmt::format("time.steps_per_period={}", options.steps_per_period)});
    }

    RunRequest request_of(const Scene &scene, const Drive &drive, const ReplayOptions &options)
    {
      RunRequest request;
      request.parameters = swimmer_parameters(scene);
      request.drive      = drive;
      request.n_periods  = options.periods;
      return request;
    }

    ReplayedField replay_field(const ReducedModel &model, const PlanResult &plan, const PlannedField &field,
                               const CommonOptions &common, const ReplayOptions &options)
    {
      constexpr int               settled_after = 2; // periods
      const Drive                 drive         = drive_of(field);
      const std::filesystem::path folder        = common.output / replay_folder_name(field.name);
      const std::filesystem::path file          = folder / "field.csv";
      const double samples_per_s = options.steps_per_period * drive.frequency_Hz; // the steps' own instants
      agree([&] {
        std::filesystem::create_directories(folder);
        write_field_program(file, sampled_program(drive, samples_per_s), field.name + ", as it was replayed");
      });
      ReplayedField replayed;
      replayed.name                  = field.name;
      const Scene          trained   = parse_scene(model.scene_text, model.scene_name + ".toml");
      const auto          &at_rest_m = trained.head.center_m;
      Scene                scene     = replay_scene(model, plan, file, 1. / drive.frequency_Hz, at_rest_m, 0., options);
      RunRequest           run       = request_of(scene, drive, options);
      const ReducedSwimmer swimmer(model, inertial_densities(scene, inertia_terms(scene)));
      replayed.start_angle_rad = settled_start_angle_rad(swimmer, run, start_of(field), settled_after);
      const auto center_m      = turned_center_m(trained, replayed.start_angle_rad);
      run.initial_state        = state_at_rest(swimmer, replayed.start_angle_rad);
      run.initial_state.head<2>() << center_m[0] - at_rest_m[0], center_m[1] - at_rest_m[1];
      replayed.reduced_displacement_m =
          displacement_per_period(SwimmerIntegrator(swimmer, {}).run(run), plan.heading_rad);
      replayed.reduced_displacement_m.resize(static_cast<std::size_t>(options.periods), // not known if the run failed
                                             std::numeric_limits<double>::quiet_NaN());

      scene = replay_scene(model, plan, file, 1. / drive.frequency_Hz, center_m, replayed.start_angle_rad, options);
      SimulationOptions simulation;
      simulation.folder       = folder;
      simulation.command_line = common.command_line;
      ProgressBar bar(common.quiet || !is_speaker());
      simulation.on_progress = [&](const SimulationProgress &p) {
        bar.show(p.steps_done, p.steps_total, p.steps_done_here, p.wall_time_s);
      };
      const SimulationResult result = simulate(scene, simulation, MPI_COMM_WORLD);
      const Eigen::Vector2d  head_first(-std::cos(plan.heading_rad), -std::sin(plan.heading_rad));
      const auto             n = static_cast<std::size_t>(options.steps_per_period);
      for (std::size_t k = n; k < result.trajectory.size(); k += n)
      {
        const TrajectoryRow &from = result.trajectory[k - n], &to = result.trajectory[k];
        replayed.displacement_m.push_back(
            head_first.dot(Eigen::Vector2d(to.head_x_m - from.head_x_m, to.head_y_m - from.head_y_m)));
      }
      if (replayed.displacement_m.size() != static_cast<std::size_t>(options.periods))
        throw ComputationError(fmt::format("the full-order model took other steps than it was asked for in {}; the "
                                           "replay cannot be read",
                                           folder.string()));
      replayed.mean_speed_m_s = replayed.displacement_m.back() * drive.frequency_Hz;
      return replayed;
    }
  } // namespace

  PlanReplay replay_on_full_order_model(const ReducedModel &model, const PlanResult &plan, const CommonOptions &common,
                                        const ReplayOptions &options)
  {
    const auto start = std::chrono::steady_clock::now();
    PlanReplay replay;
    replay.steps_per_period = options.steps_per_period;
    for (const char *name : {tuned_field_name, optimal_field_name})
      replay.fields.push_back(replay_field(model, plan, *plan.find(name), common, options));
    replay.wall_time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return replay;
  }
} // namespace swimtwin
