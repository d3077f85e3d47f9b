// A made-up reduced swimmer whose laws are those of a trained one: a bar with bending and stretching modes.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/integration/swimmer_run.h>

#include <random>

namespace swimtwin
{
  struct ExampleOptions
  {
    int  n_modes           = 4;
    int  n_followers       = 0;
    bool depends_on_angle  = true;
    bool keeps_area        = false;
    bool magnetic_tail     = true;
    bool depends_on_height = false;
    bool has_inertia       = false;
    bool has_mirror        = true;  ///< of resistance and inertia; false: as off a channel's axis
    bool is_bent           = false; ///< shapes and energy are polynomials of bending coordinates; no followers
  };

  ReducedModel example_model(const ExampleOptions &options = {});

  /// Of the inertia that such a swimmer carries in glycerol, with a heavy head; none without has_inertia.
  InertialDensities example_densities(const ExampleOptions &options);

  /// Numbers in [-1, 1], the same in every run.
  class RandomNumbers
  {
  public:
    explicit RandomNumbers(const unsigned int seed) : engine_(seed) {}
    double operator()() { return 2. * static_cast<double>(engine_()) / static_cast<double>(engine_.max()) - 1.; }
    Eigen::VectorXd vector(Eigen::Index n)
    {
      return Eigen::VectorXd::NullaryExpr(n, [this] { return (*this)(); });
    }

  private:
    std::mt19937 engine_;
  };

  /// A shape whose radius |z_q| is uniform in [0, largest_radius].
  Eigen::VectorXd random_shape(const ReducedModel &model, RandomNumbers &random, double largest_radius);

  /// The scene's own run: three periods of the reference sinusoid from rest.
  RunRequest example_request(const ReducedModel &model);
} // namespace swimtwin
