// A laboratory and the twin that steers it, joined without a pipe.
#pragma once

#include <tests/twin/run/imagined_stream.h>

namespace swimtwin
{
  /// The swimmer of the open disc, 10 % off in stiffness and magnetization, seen with little noise 100 ms late.
  inline constexpr const char *steered_lab = "duration_s = 14\n[swimmer]\nyoung_modulus_Pa = 7.2e4\n"
                                             "magnetization_A_m = 1.8e5\n"
                                             "[coils]\nsteered = true\nfrequency_Hz = 0.9\n[camera]\nlatency_s = 0.1\n";
  inline constexpr const char *steered_goal =
      "kind = \"closed-loop\"\n[path]\nshape = \"circle\"\nsize_m = 7.75e-3\n"
      "[loop]\nplant = \"external\"\ndeadline_s = 0\ndecisions_per_second = 10\n";

  struct SteeredLab
  {
    const TemporaryFolder       folder;
    TwinConfig                  config;
    LabConfig                   lab;
    std::vector<nlohmann::json> answers;
    std::vector<PlayRecord>     decisions;
    std::vector<LabTruth>       truth;

    SteeredLab(const ReducedModel &model, const std::string &goal, const std::string &twin,
               const std::string &laboratory)
    {
      written(folder, "goal.toml", goal);
      config = read_twin_config(
          written(folder, "twin.toml", "[goal]\nfile = \"goal.toml\"\n" + twin + "[output]\nforecast_periods = 0\n"),
          model);
      lab = read_lab_config(written(folder, "lab.toml", laboratory), model);
    }

    void run(const ReducedModel &model)
    {
      std::vector<PlayMessage> said;
      TwinSession              session(model, config,
                                       {[&](const std::string &line) {
                             answers.push_back(nlohmann::json::parse(line));
                             if (line.starts_with(play_line_start))
                               said.push_back(std::get<PlayMessage>(parse_message(line, {})));
                           },
                                        [](const EstimateRecord &) {},
                                        [&](const PlayRecord &record) { decisions.push_back(record); }});
      run_laboratory(model, lab,
                     {[&](double, const std::string &line) {
                        session.take(line);
                        return true;
                      },
                      [&](const LabTruth &instant) { truth.push_back(instant); },
                      [&](double) { return std::exchange(said, {}); }});
    }

    std::vector<nlohmann::json> of_type(const std::string &type) const { return lines_of_type(answers, type); }

    /// Distance of the head's true mean position over the last period from the laid path, at each instant on it (m).
    std::vector<double> distances_m() const
    {
      std::vector<Eigen::Vector2d> points;
      const nlohmann::json         laid = of_type("path").front();
      for (const auto &p : laid["points_m"])
        points.emplace_back(p[0].get<double>(), p[1].get<double>());
      const Path          path     = Path::through(points);
      const double        period_s = config.period_s;
      MeanPosition        mean;
      std::vector<double> distances;
      double              arc = 0.;
      for (const LabTruth &t : truth)
      {
        mean.add(t.time_s / period_s, t.state.head<2>());
        if (t.time_s < laid["time_s"].get<double>())
          continue;
        const PathPlace place =
            path.nearest(mean.mean_at(t.time_s / period_s), arc, std::min(arc + 4e-3, path.length_m()));
        arc = std::max(arc, place.arc_m);
        distances.push_back((place.point_m - mean.mean_at(t.time_s / period_s)).norm());
      }
      return distances;
    }
  };
} // namespace swimtwin
