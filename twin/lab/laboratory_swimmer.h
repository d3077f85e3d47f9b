// What lives in an imagined laboratory and is filmed there.
#pragma once

#include <twin/motion/twin_parameters.h>

#include <Eigen/Dense>

#include <random>
#include <string>
#include <vector>

namespace swimtwin
{
  /// The one stream of random numbers of a laboratory.
  struct Chance
  {
    std::mt19937_64                  engine;
    std::normal_distribution<double> distribution;

    double normal() { return distribution(engine); }
  };

  class LaboratorySwimmer
  {
  public:
    virtual ~LaboratorySwimmer() = default;

    /// To an instant, in what the coils play until then. Throws ComputationError if its motion is lost.
    virtual void advance(double to_s, Chance &chance) = 0;

    virtual Eigen::Vector2d head_m() const    = 0; ///< centre, in the laboratory
    virtual double          angle_rad() const = 0;
    /// Of the tail's axis, at a share of it from its root; in the laboratory.
    virtual Eigen::Vector2d tail_point_m(double share) const = 0;
    /// What the camera is like now: its scale's logarithm, its rotation, offset, delay.
    virtual double camera(TwinParameter parameter) const = 0;

    /// All that is true of it, for a table.
    virtual std::vector<std::string> truth_names() const = 0;
    virtual Eigen::VectorXd          truth() const       = 0;
  };
} // namespace swimtwin
