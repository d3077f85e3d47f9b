#include <datasets/system/error.h>
#include <optimization/sobol_points.h>

#include <boost/random/sobol.hpp>

#include <cmath>
#include <random>

namespace swimtwin
{
  namespace
  {
    /// A random shift in [0, 1) per dimension, the same on every machine: the standard fixes the engine but not its
    /// distributions.
    Eigen::VectorXd random_shift(const Eigen::Index n, const unsigned long seed)
    {
      Eigen::VectorXd shift = Eigen::VectorXd::Zero(n);
      std::mt19937_64 random(seed);
      if (seed != 0)
        for (double &part : shift)
          part = std::ldexp(static_cast<double>(random() >> 11), -53);
      return shift;
    }
  } // namespace

  Eigen::MatrixXd sobol_points(const Eigen::VectorXd &lower, const Eigen::VectorXd &upper, const int n_points,
                               const unsigned long seed)
  {
    if (!lower.allFinite() || !upper.allFinite())
      throw InputError("Starts are spread between bounds, so every variable needs a lower and an upper bound.");
    const Eigen::VectorXd shift = random_shift(lower.size(), seed);
    boost::random::sobol  sequence(static_cast<std::size_t>(lower.size()));
    Eigen::MatrixXd       points(lower.size(), n_points);
    for (int i = 0; i < n_points; ++i)
      for (Eigen::Index j = 0; j < lower.size(); ++j)
      {
        double whole = 0.;
        points(j, i) = lower[j] + (upper[j] - lower[j]) *
                                      std::modf(std::ldexp(static_cast<double>(sequence()), -64) + shift[j], &whole);
      }
    return points;
  }
} // namespace swimtwin
