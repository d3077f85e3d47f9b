// Cubic B-splines on uniform knots over [0, 1], periodic or not.
#pragma once

#include <Eigen/Dense>

#include <array>

namespace swimtwin
{
  class UniformSpline
  {
  public:
    static constexpr int order = 4; ///< coefficients that matter at one place

    /// The coefficients that matter at a place, and how much.
    struct Place
    {
      std::array<Eigen::Index, order> index;
      std::array<double, order>       weight;
    };

    /// Throws InputError for fewer than one interval, or fewer than four of a periodic spline.
    UniformSpline(int n_intervals, bool is_periodic);

    int  n_intervals() const { return n_; }
    bool is_periodic() const { return is_periodic_; }
    /// n_intervals, three more if not periodic.
    Eigen::Index n_coefficients() const { return is_periodic_ ? n_ : n_ + order - 1; }

    /// Weights of the value at s. A periodic spline repeats; another one keeps the value of its nearer end.
    Place value(double s) const;
    /// Weights of the derivative by s; zero beyond the ends.
    Place slope(double s) const;

    /// Sum of weights times coefficients first, first + stride, ...
    static double sum(const Place &place, const Eigen::VectorXd &coefficients, Eigen::Index first = 0,
                      Eigen::Index stride = 1);

    /// Coefficients, one column for each column of `values`, of the spline that is closest (least squares) to values
    /// (m x k) at places (m). With fewer values than coefficients, the smallest such coefficients.
    Eigen::MatrixXd fit(const Eigen::VectorXd &places, const Eigen::MatrixXd &values) const;

  private:
    struct Interval
    {
      int    left  = 0;
      double u     = 0.; ///< in [0, 1]
      bool   clamp = false;
    };
    Interval find(double s) const;
    Place    at(int left) const;

    int  n_           = 0;
    bool is_periodic_ = false;
  };
} // namespace swimtwin
