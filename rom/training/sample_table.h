// Samples of a resistance as a table, polynomials through it, and what these are worth.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace swimtwin
{
  /// Samples as a table, one row each: variables, entries of C.
  struct SampleTable
  {
    Eigen::MatrixXd z, entries;
    Eigen::VectorXd weight;
    Eigen::Index    n          = 0; ///< size of the resistance
    bool            has_mirror = true;

    SampleTable rows(const std::vector<int> &which) const
    {
      return {z(which, Eigen::all), entries(which, Eigen::all), weight(which), n, has_mirror};
    }
  };

  /// Monomials, and entries of C that are polynomials of these alone: those of one parity; all where there is no
  /// mirror.
  struct FittedTogether
  {
    std::vector<int> features, entries;
  };

  /// How a fit is kept small where samples do not tell it: by a weight on its coefficients, and by one on rows beyond
  /// the samples that hold it to a coarser fit there.
  struct FitRestraint
  {
    double ridge = 0., guidance = 0.;
  };

  struct FitQuality
  {
    /// Relative error of the resistance, |C^-1 R C^-T - 1|, of held-back samples: weighted root mean square of those
    /// that are least off and hold nine tenths of the (squared) weight, and the largest.
    double rms = 0., largest = 0.;
    int    n_features = 0;
  };

  std::vector<FittedTogether> fitted_together(const Eigen::MatrixXi &exponents, const SampleTable &table);

  /// The table with the guide's rows below it.
  SampleTable guided(SampleTable table, const SampleTable &guide, const FitRestraint &restraint);

  /// Coefficients, a row per monomial and a column per entry of C.
  Eigen::MatrixXd fit_restrained(const Eigen::MatrixXi &exponents, const SampleTable &table, const SampleTable &guide,
                                 const FitRestraint &restraint);

  /// By cross-validation over five_folds.
  FitQuality cross_validate(const Eigen::MatrixXi &exponents, const SampleTable &table, const SampleTable &guide,
                            const FitRestraint &restraint);
} // namespace swimtwin
