// The live twin against imagined laboratories: consistency over many seeds, and the bars of docs/benchmarks.md.
//
//     bench_twin MODEL STUDY [number of seeds] [first seed]
#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/scene.h>
#include <datasets/system/clocks.h>
#include <twin/estimate/swimmer_twin.h>
#include <twin/lab/laboratory.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr double frequency_Hz = 0.8, bx_T = 4e-3, by_T = 4e-3;

    struct Case
    {
      LaboratoryOptions lab;
      TwinOptions       twin;
      double            periods = 20.;
    };

    struct Outcome
    {
      double n                   = 0.;                                                  ///< states
      double state_error_squared = 0., n_parameters = 0., parameter_error_squared = 0.; ///< chi-squared at the end
      double innovations = 0., n_innovations = 0.; ///< sum of chi-squared, degrees of freedom
      double stiffness_error = 0., magnet_error = 0., delay_error_s = 0.;
      double stiffness_sd = 0., magnet_sd = 0., delay_sd_s = 0.;
      std::vector<std::pair<double, std::string>> alarms;
      double                                      mean_frame_s = 0., largest_frame_s = 0.;
      double worst_viscosity_error = 0.; ///< of its logarithm, after a quarter of the time
    };

    struct Model
    {
      ReducedModel      model;
      ReducedSwimmer    swimmer{model};
      TailAxis          axis{model.tail};
      SwimmerParameters nominal = swimmer_parameters(parse_scene(model.scene_text, model.scene_name));
      explicit Model(const char *file) : model(read_reduced_model(file)) {}
    };

    Case standard_case(const Model &m, const unsigned int seed)
    {
      Case c;
      c.twin = default_twin_options(m.model, m.nominal, frequency_Hz);
      // The reduced model is the truth: what the twin believes of its errors is what the laboratory does.
      c.twin.noise  = {2.5e-8, 1e-4, 1e-4 * m.model.resistance.coordinate_scale_m.head(m.model.n_modes())};
      c.lab.nominal = m.nominal;
      c.lab.noise   = c.twin.noise;
      c.lab.seed    = seed;
      c.lab.camera.position_sigma_m                   = 0.003 * m.swimmer.length_m();
      c.lab.camera.angle_sigma_rad                    = std::numbers::pi / 180.;
      c.twin.parameters[TwinParameter::stiffness]     = {0., 0.1, 1e-4};
      c.twin.parameters[TwinParameter::magnetization] = {0., 0.1, 1e-4};
      c.lab.truth                                     = c.twin.parameters;
      std::mt19937_64                  random(1000 + seed);
      std::normal_distribution<double> normal;
      for (DriftingParameter &p : c.lab.truth.list)
        p.value += p.standard_deviation * normal(random);
      c.lab.first_state = Eigen::VectorXd::Zero(m.swimmer.n_states());
      for (int i = 3; i < m.swimmer.n_states(); ++i)
        c.lab.first_state[i] = c.twin.start.shape_sd_m[i - 3] * normal(random);
      c.lab.largest_step_s = c.twin.largest_step_s;
      return c;
    }

    Outcome run(const Model &m, const Case &c)
    {
      ReducedLaboratory imagined(m.swimmer, m.axis, c.lab);
      Laboratory       &lab = imagined.lab;
      SwimmerTwin       twin(m.model, c.twin);
      lab.command().play_sinusoid(0., bx_T, by_T, frequency_Hz);
      twin.field().play_sinusoid(0., bx_T, by_T, frequency_Hz);
      Outcome   o;
      const int n_frames = static_cast<int>(c.periods / frequency_Hz * c.lab.camera.frames_per_second);
      for (int i = 0; i < n_frames; ++i)
      {
        const CapturedFrame frame = lab.next_frame();
        if (frame.observations.empty())
          continue;
        const double start = wall_time_s();
        twin.see(frame.stamp_s, frame.observations);
        const double took = wall_time_s() - start;
        o.mean_frame_s += took / n_frames;
        o.largest_frame_s = std::max(o.largest_frame_s, took);
        if (twin.alarm())
          o.alarms.emplace_back(twin.now_s(), fmt::format("{} {:+.2f} since {:.2f} s, ratio {:.0f}", twin.alarm()->name,
                                                          twin.alarm()->finding.size, twin.alarm()->finding.since_s,
                                                          twin.alarm()->finding.ratio));
        if (i * 4 > n_frames && twin.layout().is_estimated(TwinParameter::stiffness))
        {
          const Eigen::VectorXd wrong = twin.belief().mean - imagined.swimmer.truth_in(twin.layout());
          o.worst_viscosity_error =
              std::max(o.worst_viscosity_error, std::abs(wrong[twin.layout().place(TwinParameter::magnetization)]));
        }
        if (i * 4 > n_frames) // the start's belief is wide on purpose
          for (const Innovation &innovation : twin.filter().latest().innovations)
            if (innovation.weight > 0.)
            {
              o.innovations += innovation.distance_squared;
              o.n_innovations += innovation.n_rows;
            }
      }
      // The twin's instant is the stamp less what it takes for the delay.
      Eigen::VectorXd truth  = imagined.swimmer.truth_in(twin.layout());
      Belief          belief = twin.belief();
      if (lab.now_s() > twin.now_s() + 0.5 / c.lab.camera.frames_per_second) // the last frame was missing
        twin.filter().predict(twin.now_s(), lab.now_s(), belief);
      else
        belief.mean.head(m.swimmer.n_states()) +=
            (lab.now_s() - twin.now_s()) * twin.process().rate(twin.now_s(), belief.mean);
      const int n = twin.layout().n_swimmer(), k = twin.layout().n_states() - n;
      truth[2] +=
          2. * std::numbers::pi * std::round((belief.mean[2] - truth[2]) / (2. * std::numbers::pi)); // whole turns
      o.n                   = static_cast<double>(belief.size());
      o.state_error_squared = belief.distance_squared(truth);
      o.n_parameters        = k;
      if (k > 0)
      {
        const Eigen::MatrixXd rows  = belief.root.bottomRows(k);
        const Eigen::VectorXd error = (truth - belief.mean).tail(k);
        o.parameter_error_squared   = error.dot((rows * rows.transpose()).ldlt().solve(error));
      }
      const auto error = [&](const TwinParameter p) {
        return twin.layout().is_estimated(p) ? belief.mean[twin.layout().place(p)] - truth[twin.layout().place(p)] : 0.;
      };
      const auto sd = [&](const TwinParameter p) {
        return twin.layout().is_estimated(p) ? belief.standard_deviation(twin.layout().place(p)) : 0.;
      };
      o.stiffness_error = error(TwinParameter::stiffness);
      o.magnet_error    = error(TwinParameter::magnetization);
      o.delay_error_s   = error(TwinParameter::camera_delay);
      o.stiffness_sd    = sd(TwinParameter::stiffness);
      o.magnet_sd       = sd(TwinParameter::magnetization);
      o.delay_sd_s      = sd(TwinParameter::camera_delay);
      return o;
    }

    struct Statistics
    {
      std::vector<Outcome> outcomes;

      double share(const std::function<bool(const Outcome &)> &rule) const
      {
        return static_cast<double>(std::count_if(outcomes.begin(), outcomes.end(), rule)) /
               static_cast<double>(outcomes.size());
      }
      double rms(double Outcome::*member) const
      {
        double sum = 0.;
        for (const Outcome &o : outcomes)
          sum += std::pow(o.*member, 2) / static_cast<double>(outcomes.size());
        return std::sqrt(sum);
      }
      double largest(double Outcome::*member) const
      {
        double most = 0.;
        for (const Outcome &o : outcomes)
          most = std::max(most, std::abs(o.*member));
        return most;
      }
      double mean(double Outcome::*member) const
      {
        double sum = 0.;
        for (const Outcome &o : outcomes)
          sum += o.*member / static_cast<double>(outcomes.size());
        return sum;
      }
    };

    /// Wilson and Hilferty: chi-squared with n degrees of freedom as a standard normal number.
    double as_normal(const double chi_squared, const double n)
    {
      return (std::cbrt(chi_squared / n) - 1. + 2. / (9. * n)) / std::sqrt(2. / (9. * n));
    }

    void print(const char *title, const Statistics &s)
    {
      fmt::print("{}: {} runs\n", title, s.outcomes.size());
      fmt::print("  state inside its 95 % region      {:.1f} %  (chi-squared {:.2f} of {:.0f})\n",
                 100. * s.share([](const Outcome &o) { return as_normal(o.state_error_squared, o.n) < 1.645; }),
                 s.mean(&Outcome::state_error_squared), s.outcomes.front().n);
      fmt::print("  parameters inside theirs          {:.1f} %  (chi-squared {:.2f} of {:.0f})\n",
                 100. * s.share([](const Outcome &o) {
                   return o.n_parameters == 0. || as_normal(o.parameter_error_squared, o.n_parameters) < 1.645;
                 }),
                 s.mean(&Outcome::parameter_error_squared), s.outcomes.front().n_parameters);
      fmt::print(
          "  innovations, both sides           {:.1f} %  (chi-squared per degree {:.4f})\n",
          100. * s.share([](const Outcome &o) { return std::abs(as_normal(o.innovations, o.n_innovations)) < 1.96; }),
          s.mean(&Outcome::innovations) / s.mean(&Outcome::n_innovations));
      fmt::print("  E/mu  error rms {:.2f} %, worst {:.2f} %, stated {:.2f} %\n",
                 100. * s.rms(&Outcome::stiffness_error), 100. * s.largest(&Outcome::stiffness_error),
                 100. * s.rms(&Outcome::stiffness_sd));
      fmt::print("  M/mu  error rms {:.2f} %, worst {:.2f} %, stated {:.2f} %\n", 100. * s.rms(&Outcome::magnet_error),
                 100. * s.largest(&Outcome::magnet_error), 100. * s.rms(&Outcome::magnet_sd));
      if (s.rms(&Outcome::delay_sd_s) > 0.)
        fmt::print("  delay error rms {:.2f} ms, worst {:.2f} ms, stated {:.2f} ms\n",
                   1e3 * s.rms(&Outcome::delay_error_s), 1e3 * s.largest(&Outcome::delay_error_s),
                   1e3 * s.rms(&Outcome::delay_sd_s));
      fmt::print("  largest error of M/mu on the way  {:.2f} %\n", 100. * s.largest(&Outcome::worst_viscosity_error));
      fmt::print("  time of a frame {:.3f} ms on average, {:.2f} ms at most\n", 1e3 * s.mean(&Outcome::mean_frame_s),
                 1e3 * s.largest(&Outcome::largest_frame_s));
      std::map<std::string, int> alarms;
      for (const Outcome &o : s.outcomes)
        for (const auto &[time, name] : o.alarms)
          ++alarms[fmt::format("at {:.1f} s: {}", time, name)];
      fmt::print("  alarms in all runs together: {}\n", alarms.size());
      int n_shown = 0;
      for (const auto &[name, n] : alarms)
        if (++n_shown <= 60)
          fmt::print("    {}\n", name);
    }

    Case make_case(const std::string &study, const Model &m, const unsigned int seed)
    {
      Case c = standard_case(m, seed);
      if (study == "delay")
      {
        std::mt19937_64 random(5000 + seed);
        c.twin.parameters[TwinParameter::camera_delay] = {0.125, 0.0722, 1e-5};
        c.lab.truth[TwinParameter::camera_delay] = {0.25 * std::uniform_real_distribution<double>()(random), 1., 1e-5};
      }
      if (study == "jump")
      {
        c.lab.changes = {{15.3, TwinParameter::stiffness, std::log(0.5)}};
        c.periods     = 24.;
      }
      if (study == "jump-late")
      {
        c.lab.changes = {{15.7, TwinParameter::stiffness, std::log(0.5)}};
        c.periods     = 24.;
      }
      if (study == "quiet")
        c.periods = 500.;
      if (study == "ramp") // 2 degrees in 60 s
      {
        c.lab.ramp                        = {20., 80., 2. / 60.};
        c.twin.parameters.viscosity_drift = 5e-3;
        c.periods                         = 90. * frequency_Hz;
      }
      if (study.starts_with("rough"))
      {
        c.lab.camera.missing_share = 0.2;
        c.lab.camera.outlier_share = 0.05;
        c.lab.camera.outlier_m     = 0.5 * m.swimmer.length_m();
        c.lab.camera.dark          = {{12., 13.}};
        if (study == "rough-naive")
          c.twin.filter.robustness = {1e9, 1e9};
      }
      if (study == "model-error") // what is believed of a real model's error, on one that has none
        c.twin.noise = default_twin_options(m.model, m.nominal, frequency_Hz).noise;
      return c;
    }
  } // namespace
} // namespace swimtwin

int main(const int argc, char **argv)
{
  using namespace swimtwin;
  if (argc < 3)
  {
    fmt::print("bench_twin MODEL consistency|delay|jump|jump-late|quiet|ramp|rough|rough-naive|model-error [seeds] "
               "[first seed]\n");
    return 2;
  }
  const Model        model(argv[1]);
  const std::string  study = argv[2];
  const int          n     = argc > 3 ? std::atoi(argv[3]) : 20;
  const unsigned int first = argc > 4 ? static_cast<unsigned int>(std::atoi(argv[4])) : 1U;
  Statistics         statistics;
  for (int i = 0; i < n; ++i)
    statistics.outcomes.push_back(run(model, make_case(study, model, first + static_cast<unsigned int>(i))));
  print(study.c_str(), statistics);
  return 0;
}
