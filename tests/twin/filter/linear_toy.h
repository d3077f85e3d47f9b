// A point that moves with a drifting speed, seen with noise: linear, so that the textbook's answer is exact.
#pragma once

#include <twin/filter/window_filter.h>

#include <random>

namespace swimtwin
{
  /// (position, speed): the speed is a random walk; two numbers are seen, or the position alone (place = 1).
  class LinearProcess : public Process
  {
  public:
    Eigen::Index n_states() const override { return 2; }
    Eigen::Index n_noises() const override { return 2; }
    double       largest_step_s() const override { return 0.07; }
    bool         advance(const double from_s, const double to_s, Eigen::VectorXd &mean, Eigen::MatrixXd &transition,
                         Eigen::MatrixXd &noise) override
    {
      const double h = to_s - from_s;
      transition << 1., h, 0., 1.;
      // Of Q = q [h^3/3, h^2/2; h^2/2, h]: exact, so that steps may be divided.
      const double q = 0.3;
      noise << std::sqrt(q * h * h * h / 12.), std::sqrt(q * h) * h / 2., 0., std::sqrt(q * h);
      mean = transition * mean;
      return true;
    }
  };

  class LinearSensor : public Sensor
  {
  public:
    Eigen::Index n_rows(const Sighting &o) const override { return o.place == 1. ? 1 : 2; }
    double       first_sigma(int) const override { return 0.2; }
    void         look(const Sighting &o, double, const Eigen::VectorXd &state, Eigen::Ref<Eigen::VectorXd> residual,
                      Eigen::Ref<Eigen::MatrixXd> slopes) override
    {
      Eigen::Matrix2d H;
      H << 1., 0., 0.5, -1.;
      slopes   = H.topRows(n_rows(o));
      residual = o.value.head(n_rows(o)) - slopes * state;
    }
  };

  inline Belief toy_prior()
  {
    Belief prior{Eigen::Vector2d(0.3, -1.), Eigen::MatrixXd(2, 2)};
    prior.root << 0.8, 0., 0.3, 0.6;
    return prior;
  }

  inline FilterOptions plain_options(const double window_s = 100.)
  {
    return {.window_s = window_s, .robustness = {1e9, 1e9}, .learns_jumps = false};
  }

  /// Observed at irregular instants, sometimes one number, sometimes two.
  inline std::vector<Frame> toy_frames(const int n, const unsigned int seed)
  {
    std::mt19937                     engine(seed);
    std::normal_distribution<double> normal;
    std::vector<Frame>               frames;
    double                           time_s = 0., x = 0.5, v = -0.7;
    for (int i = 0; i < n; ++i)
    {
      const double h = 0.02 + 0.1 * (static_cast<double>(engine()) / static_cast<double>(engine.max()));
      time_s += h;
      x += h * v;
      v += 0.5 * std::sqrt(h) * normal(engine);
      const double place = i % 3 == 0 ? 1. : 0.;
      frames.push_back({time_s, {{0, {x + 0.2 * normal(engine), 0.5 * x - v + 0.2 * normal(engine)}, 0.2, place}}});
    }
    return frames;
  }
} // namespace swimtwin
