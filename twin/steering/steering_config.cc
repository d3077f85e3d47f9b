#include <datasets/text/toml_table.h>
#include <twin/steering/coil_limiter.h>
#include <twin/steering/steering_config.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    void require_external(const TomlDocument &document, const SteeringConfig &config)
    {
      const TrackingGoal &goal = config.goal;
      if (goal.kind != TrackingKind::closed_loop || goal.plant != PlantKind::external)
        document.refuse("goal", "file",
                        "is no goal for a laboratory; write kind = \"closed-loop\" and [loop] plant = \"external\" "
                        "into it.");
      if (goal.options.point)
        document.refuse("goal", "file",
                        "leads a point behind the head (point_behind), which is measured by `track` alone; leave it "
                        "out.");
    }

    void require_playable(const TomlDocument &document, const SteeringConfig &config)
    {
      if (const double use = CoilLimiter(config.goal.limits).use_of(config.safe_T); use > 1. + 1e-9)
        document.refuse(
            "goal", "safe_T",
            fmt::format("is {:.4g} times what the goal's [limits] and largest_field_T allow; weaken it.", use));
      const double interval_s = 1. / config.goal.options.decisions_per_second;
      if (config.valid_s < interval_s)
        document.refuse(
            "goal", "valid_s",
            fmt::format("is shorter than the {:.4g} s from one decision to the next; raise it.", interval_s));
      constexpr double most_samples = 1000.; // in a line, which is at most 64 kB long
      if (const double n = config.valid_s * config.sample_rate_Hz; n > most_samples)
        document.refuse("goal", "sample_rate_Hz",
                        fmt::format("makes {:.0f} samples a line with valid_s = {:.4g}, above {}; lower one of them.",
                                    n, config.valid_s, most_samples));
      if (config.sample_rate_Hz < 20. * config.goal.carrier.frequency_Hz)
        document.refuse("goal", "sample_rate_Hz",
                        fmt::format("gives less than 20 samples in a period of the carrier ({:.4g} Hz); raise it.",
                                    config.goal.carrier.frequency_Hz));
    }
  } // namespace

  SteeringConfig read_steering(const TomlDocument &document, const std::filesystem::path &folder,
                               const ReducedModel &model)
  {
    constexpr Range       few_seconds{0., 60., true, false, "be above 0 and at most 60 s"};
    constexpr Range       sample_rate{0., 1e4, true, false, "be above 0 and at most 10000 Hz"};
    SteeringConfig        config;
    std::string           file;
    std::array<double, 2> safe_T{};
    TomlTable             table(document, "goal");
    table.text("file", file, Need::required);
    table.pair("safe_T", {"T", any_number}, safe_T);
    table.number("latency_s", {"s", not_negative}, config.latency_s);
    table.number("valid_s", {"s", few_seconds}, config.valid_s);
    table.number("sample_rate_Hz", {"Hz", sample_rate}, config.sample_rate_Hz);
    table.flag("weighs_doubt", config.weighs_doubt);
    table.finish();
    config.safe_T = {safe_T[0], safe_T[1]};
    config.file   = folder / file;
    config.goal   = read_tracking_goal(config.file, model);
    require_external(document, config);
    require_playable(document, config);
    return config;
  }
} // namespace swimtwin
