#include <tests/pipeline/simulation.h>

#include <tests/places.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace swimtwin
{
  ShrunkScene ShrunkScene::with(const std::vector<std::string> &more) const
  {
    ShrunkScene scene = *this;
    scene.settings.insert(scene.settings.end(), more.begin(), more.end());
    return scene;
  }

  std::vector<std::string> ShrunkScene::arguments() const
  {
    const bool               is_shipped = std::filesystem::path(name).extension() != ".toml";
    std::vector<std::string> arguments{is_shipped ? std::string(places::scenes) + "/" + name + ".toml" : name};
    for (const auto &setting : settings)
      arguments.insert(arguments.end(), {"--set", setting});
    return arguments;
  }

  ShrunkScene coarse_swimmer(const int steps_per_period, const double periods)
  {
    return {"reference-2d-casefile",
            {"fluid.inertia=none", "numerics.mesh_growth=0.6",
             "time.steps_per_period=" + std::to_string(steps_per_period), "time.periods=" + std::to_string(periods)}};
  }

  ShrunkScene coarse_swimmer_in_space(const double periods)
  {
    return {"reference-3d-paper",
            {"fluid.inertia=none", "domain.size_m=[20e-3,10e-3,10e-3]", "numerics.mesh_size_m=1.2e-3",
             "numerics.mesh_size_corner_m=5e-4", "numerics.mesh_size_far_m=8e-3", "numerics.mesh_growth=1",
             "time.periods=" + std::to_string(periods)}};
  }

  std::string brief_goal()
  {
    return R"(
[objective]
mean_speed = 1
[field]
harmonics = 2
family = "symmetric"
frequency_low_Hz = 0.5
frequency_high_Hz = 1.5
sample_rate_Hz = 200
[limits]
magnitude_T = 7e-3
[search]
starts = 0
max_evaluations = 20
gradient_free_budget = 0
)";
  }

  std::vector<std::string> simulate_arguments(const ShrunkScene &scene, const std::filesystem::path &folder,
                                              const std::vector<std::string> &options)
  {
    std::vector<std::string> arguments{"simulate"};
    for (const auto &more : {scene.arguments(), {"--output", folder.string()}, options})
      arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  Outcome simulate(const ShrunkScene &scene, const std::filesystem::path &folder,
                   const std::vector<std::string> &options)
  {
    const Outcome outcome = run_tool(simulate_arguments(scene, folder, options));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome;
  }

  Motion read_motion(const std::filesystem::path &folder)
  {
    return {read_run_summary_json(folder / "summary.json").summary, read_trajectory_csv(folder / "trajectory.csv")};
  }

  Motion simulate(const ShrunkScene &scene)
  {
    const TemporaryFolder folder;
    if (simulate(scene, folder.path).exit_code != 0)
      throw std::runtime_error("the simulation failed");
    return read_motion(folder.path);
  }

  double distance(const Trajectory &a, const Trajectory &b, const std::size_t stride)
  {
    if ((a.size() - 1) * stride + 1 != b.size())
      return std::numeric_limits<double>::infinity();
    double largest = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      const TrajectoryRow &p = a[i], &q = b[i * stride];
      EXPECT_NEAR(p.time_s, q.time_s, 1e-12);
      largest = std::max({largest, std::hypot(p.head_x_m - q.head_x_m, p.head_y_m - q.head_y_m),
                          std::hypot(p.tail_tip_x_m - q.tail_tip_x_m, p.tail_tip_y_m - q.tail_tip_y_m)});
    }
    return largest / body_length_m;
  }

  Trajectory mirrored(Trajectory trajectory)
  {
    for (TrajectoryRow &row : trajectory)
      for (double *value : {&row.head_y_m, &row.head_angle_rad, &row.tail_tip_y_m, &row.tail_angle_rad})
        *value = -*value;
    return trajectory;
  }

  double largest_angle_difference(const Trajectory &a, const Trajectory &b)
  {
    double largest = 0.;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      largest = std::max({largest, std::abs(a[i].head_angle_rad - b[i].head_angle_rad),
                          std::abs(a[i].tail_angle_rad - b[i].tail_angle_rad)});
    return largest;
  }
} // namespace swimtwin
