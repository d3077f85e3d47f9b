// What a filter is about: something that moves, and something that sees it.
#pragma once

#include <Eigen/Dense>

#include <limits>
#include <vector>

namespace swimtwin
{
  /// Kinds of observations, each with a noise of its own.
  inline constexpr int max_observation_kinds = 4;

  /// One or two numbers seen at one instant.
  struct Sighting
  {
    int             kind  = 0; ///< below max_observation_kinds
    Eigen::Vector2d value = Eigen::Vector2d::Zero();
    double          sigma = 0.; ///< standard deviation of each number; 0: learned from the innovations
    double          place = 0.; ///< where it was seen; its meaning is the sensor's

    bool operator==(const Sighting &) const = default;
  };

  /// Everything seen at one instant.
  struct Frame
  {
    double                time_s = 0.; ///< when it was captured
    std::vector<Sighting> observations;
  };

  class Process
  {
  public:
    virtual ~Process() = default;

    virtual Eigen::Index n_states() const       = 0;
    virtual Eigen::Index n_noises() const       = 0;
    virtual double       largest_step_s() const = 0;
    /// The mean goes from one instant to the next; `transition` becomes its derivative by where it was (n x n), `noise`
    /// a root of the covariance that the step adds (n x n_noises). False if there is no way on.
    virtual bool advance(double from_s, double to_s, Eigen::VectorXd &mean, Eigen::MatrixXd &transition,
                         Eigen::MatrixXd &noise) = 0;
  };

  class Sensor
  {
  public:
    virtual ~Sensor() = default;

    virtual Eigen::Index n_rows(const Sighting &observation) const = 0;
    /// Where there is no sigma: what the learning starts from.
    virtual double first_sigma(int kind) const = 0;
    /// How far off an observation may be while little is known of the parameters (norm of its residual).
    virtual double largest_residual(int /*kind*/) const { return std::numeric_limits<double>::infinity(); }
    /// Observed minus expected of a state at this instant (n_rows), and the derivative of what is expected by the state
    /// (n_rows x n).
    virtual void look(const Sighting &observation, double time_s, const Eigen::VectorXd &state,
                      Eigen::Ref<Eigen::VectorXd> residual, Eigen::Ref<Eigen::MatrixXd> slopes) = 0;
  };
} // namespace swimtwin
