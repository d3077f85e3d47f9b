// The drag on a sphere that moves along the axis of a long circular tube, exactly: the independent solution that the
// full-order model is compared with.
#pragma once

#include <Eigen/Dense>

#include <cmath>
#include <numbers>
#include <vector>

namespace swimtwin
{
  /// Stokes flow of a sphere of radius `ratio` in a tube of radius 1, at rest far away, as a sum of the derivatives
  /// along the axis of a Stokeslet and of a dipole in the sphere's centre. Each is completed by a regular flow in the
  /// tube, an integral over wave numbers, to vanish on the tube; the sphere's velocity is met in collocation points.
  /// The Stokeslet alone carries a force. In cylindrical coordinates (z, rho), lengths in tube radii.
  class SphereInTube
  {
  public:
    SphereInTube(const double ratio, const int n_derivatives) : ratio_(ratio), n_(n_derivatives)
    {
      for (int i = 0; i < n_waves; ++i) // midpoint rule in the square root: what is left of log k at 0 is smooth
      {
        const double root = (i + .5) * std::sqrt(largest_wave) / n_waves;
        waves_.push_back({root * root, 2. * root * std::sqrt(largest_wave) / n_waves});
      }
    }

    /// Over Stokes' drag.
    double drag() const
    {
      const int       n_points = 4 * n_;
      Eigen::MatrixXd flows(2 * n_points, 2 * n_);
      Eigen::VectorXd motion(2 * n_points);
      for (int p = 0; p < n_points; ++p)
      {
        const double angle = .5 * std::numbers::pi * (p + .5) / n_points;
        const double z = ratio_ * std::cos(angle), rho = ratio_ * std::sin(angle);
        motion.segment<2>(2 * p) << 1., 0.;
        for (int i = 0; i < 2 * n_; ++i)
          flows.block<2, 1>(2 * p, i) = singular(i, z, rho) + regular(i, z, rho);
      }
      const Eigen::VectorXd strengths = flows.colPivHouseholderQr().solve(motion);
      return strengths[0] / (.75 * ratio_);
    }

  private:
    struct Wave
    {
      double number, weight;
    };
    static constexpr int    n_waves      = 400;
    static constexpr double largest_wave = 60.;

    bool   is_stokeslet(const int i) const { return i < n_; }
    int    order(const int i) const { return is_stokeslet(i) ? 2 * i : 2 * (i - n_) + 1; } ///< of the derivative
    double scale(const int i) const { return std::pow(ratio_, order(i) + (is_stokeslet(i) ? 0 : 2)) / factorial(i); }
    double factorial(const int i) const { return std::tgamma(order(i) + (is_stokeslet(i) ? 1. : 2.)); }

    /// Of m-th order along z of r^power: (-1)^m m! r^(power - m) C_m, Gegenbauer's polynomial of -power / 2.
    static double derivative(const int m, const int power, const double z, const double rho)
    {
      const double r = std::hypot(z, rho), x = z / r, alpha = -.5 * power;
      double       before = 0., now = 1.;
      for (int n = 1; n <= m; ++n)
      {
        const double next = (2. * x * (n + alpha - 1.) * now - (n + 2. * alpha - 2.) * before) / n;
        before            = now;
        now               = next;
      }
      return (m % 2 == 0 ? 1. : -1.) * std::tgamma(m + 1.) * std::pow(r, power - m) * now;
    }

    Eigen::Vector2d singular(const int i, const double z, const double rho) const
    {
      const int m = order(i);
      if (is_stokeslet(i)) // 2 e_z / r - grad dr/dz
        return scale(i) * Eigen::Vector2d(2. * derivative(m, -1, z, rho) - derivative(m + 2, 1, z, rho),
                                          -rho * derivative(m + 1, -1, z, rho));
      return scale(i) * Eigen::Vector2d(derivative(m + 1, -1, z, rho), -rho * derivative(m, -3, z, rho)); // grad 1/r
    }

    /// Amplitudes of cos kz and sin kz in the singular flow on the tube, from 1/r = 2/pi int K_0(k rho) cos kz dk.
    Eigen::Vector2d on_tube(const int i, const double k) const
    {
      const int    m = order(i), half = m / 2;
      const double sign = half % 2 == 0 ? 1. : -1., power = std::pow(k, m);
      const double K0 = std::cyl_bessel_k(0., k), K1 = std::cyl_bessel_k(1., k);
      const double common = scale(i) * sign * power * 2. / std::numbers::pi;
      if (is_stokeslet(i))
        return common * Eigen::Vector2d(2. * K0 - k * K1, k * K0);
      return common * Eigen::Vector2d(-k * K0, k * K1);
    }

    Eigen::Vector2d regular(const int i, const double z, const double rho) const
    {
      Eigen::Vector2d flow = Eigen::Vector2d::Zero();
      for (const auto &[k, weight] : waves_)
      {
        const Eigen::Vector2d amplitudes = waves(k, 1.).partialPivLu().solve(-on_tube(i, k));
        flow += weight * (waves(k, rho) * amplitudes).cwiseProduct(Eigen::Vector2d(std::cos(k * z), std::sin(k * z)));
      }
      return flow;
    }

    /// The two Stokes flows of a wave number that are regular in the tube.
    static Eigen::Matrix2d waves(const double k, const double rho)
    {
      const double    I0 = std::cyl_bessel_i(0., k * rho), I1 = std::cyl_bessel_i(1., k * rho);
      Eigen::Matrix2d flows;
      flows << I0, 2. * I0 + k * rho * I1, I1, k * rho * I0;
      return flows;
    }

    double            ratio_;
    int               n_;
    std::vector<Wave> waves_;
  };
} // namespace swimtwin
