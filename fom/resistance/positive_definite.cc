#include <fom/resistance/positive_definite.h>

#include <datasets/system/error.h>

#include <Eigen/Dense>
#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// The solver leaves 1e-12 at most; the rest of the way to a wrong matrix is a wrong flow.
    constexpr double largest_plausible_asymmetry = 1e-6;

    [[noreturn]] void refuse(const std::string &what)
    {
      throw ComputationError(fmt::format("the resistance matrix {}, so that the computed flow is wrong and nothing is "
                                         "written: refine [numerics] mesh_size_m",
                                         what));
    }
  } // namespace

  double largest_asymmetry(const FullMatrix<double> &R)
  {
    double largest = 0.;
    for (unsigned int i = 0; i < R.m(); ++i)
      for (unsigned int j = 0; j < i; ++j)
        if (const double a = std::abs(R(i, j) - R(j, i)) / std::sqrt(R(i, i) * R(j, j)); !(a <= largest))
          largest = a;
    return largest;
  }

  void check_resistance(const FullMatrix<double> &R, const double asymmetry)
  {
    const unsigned int n = R.m();
    Eigen::MatrixXd    scaled(n, n); // to a unit diagonal, so that units do not matter
    for (unsigned int i = 0; i < n; ++i)
      if (!(R(i, i) > 0.))
        refuse(fmt::format("has the diagonal entry {} = {:.3g}", i + 1, R(i, i)));
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        scaled(i, j) = .5 * (R(i, j) + R(j, i)) / std::sqrt(R(i, i) * R(j, j));
    if (!scaled.allFinite())
      refuse("has entries that are not finite");
    if (!(asymmetry <= largest_plausible_asymmetry))
      refuse(fmt::format("is asymmetric by {:.2g}", asymmetry));
    const double smallest =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues()[0];
    if (!(smallest > 0.))
      refuse(
          fmt::format("is not positive definite (scaled to a unit diagonal it has the eigenvalue {:.2g})", smallest));
  }
} // namespace swimtwin
