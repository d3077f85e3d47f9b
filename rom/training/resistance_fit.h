// Fit of the resistance surrogate to samples: log-Cholesky polynomials with the mirror's parity, where there is one,
// built in.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/training/shape_sampler.h>

#include <functional>
#include <vector>

namespace swimtwin
{
  /// The region of shapes and poses that is sampled: |q / scale| <= 1, |angle| <= angle_scale, and height above the
  /// usual one |drift_y| <= height_scale.
  struct SampledRegion
  {
    Eigen::VectorXd coordinate_scale_m;
    bool            depends_on_angle  = false;
    double          angle_scale_rad   = 1.;
    bool            depends_on_height = false;
    double          height_scale_m    = 1.;
    bool            has_mirror        = true; ///< whether a mirrored swimmer feels the mirrored resistance

    int n_variables() const
    {
      return static_cast<int>(coordinate_scale_m.size()) + depends_on_angle + depends_on_height;
    }
    Eigen::VectorXd variables(const ShapePoint &point) const; ///< z, then scaled angle and height if they matter
  };

  /// How much worse than the best a fit with fewer monomials may be; each of them is paid for at each step in time.
  struct FitEconomy
  {
    double nearly = 1.15; ///< times the best one's error
    /// If given, so far apart (relative_difference) the swimmer's ways may be all the same.
    std::function<Eigen::Matrix2Xd(const ReducedResistance &)> ways;
    double                                                     apart = 0.;
  };

  struct FitQuality
  {
    /// Relative error of the resistance, |C^-1 R C^-T - 1|, of held-back samples: weighted root mean square of those
    /// that are least off and hold nine tenths of the (squared) weight, and the largest.
    double rms = 0., largest = 0.;
    int    n_features = 0;
  };

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

  /// Which monomials matter is told by `effects`: how much each variable at the region's edge changes the scaled
  /// factor. Their products, raised to the powers of a monomial, must exceed a bound; the bound, and a restraint of the
  /// coefficients, are chosen by cross-validation: the smallest set that economy allows, of those that are not wild
  /// beyond the region. Polynomials that are fine enough within it are wild beyond, where no sample is, unless rows
  /// there hold them to the best coarse fit that is not. The first sample is that at rest; others count less the
  /// farther their C is from its. All bending coordinates are odd. The halves of the samples are fitted by themselves
  /// as well, every other one.
  class ResistanceFit
  {
  public:
    ResistanceFit(const std::vector<ResistanceSample> &samples, const SampledRegion &region,
                  const Eigen::VectorXd &effects, const UsualPlace &usual = {}, const FitEconomy &economy = {});

    const ReducedResistance &resistance() const { return resistance_; }
    /// By five-fold cross-validation.
    const FitQuality &quality() const { return quality_; }
    /// Those n of the candidates that the samples support worst: each has the largest variance of its prediction per
    /// variance of the data (leverage) once those before it are samples too.
    std::vector<ShapePoint> worst_supported(const std::vector<ShapePoint> &candidates, int n) const;
    /// That variance at one point.
    double leverage(const ShapePoint &point) const;
    /// The reduced swimmer moves with this velocity (R^T dx/dt, omega, dq/dt) at the sample's shape: its difference to
    /// that with the sample's resistance under the same forces, relative in the norm of the resistance.
    double velocity_error_at(const ResistanceSample &sample, const Eigen::VectorXd &velocity) const;

  private:
    void fit_chosen_features(const std::vector<Eigen::MatrixXi> &sets, const SampleTable &table,
                             const FitEconomy &economy);
    void fit_halves(const SampleTable &table);

    SampledRegion                region_;
    ReducedResistance            resistance_;
    FitQuality                   quality_;
    FitRestraint                 restraint_;
    SampleTable                  guide_;
    std::vector<FittedTogether>  parts_;
    std::vector<Eigen::MatrixXd> covariance_; ///< (A^T A)^-1 of their design matrices
  };

  /// Effects of the variables from samples at the region's edge on each axis: largest entry of C - 1 there, at least
  /// 1e-4. `rest` and `axis` hold the resistance at rest and at z = e_i.
  Eigen::VectorXd variable_effects(const Eigen::MatrixXd &rest, const std::vector<Eigen::MatrixXd> &axis,
                                   bool has_mirror = true);

  /// L_0 of a resistance at rest, with what the mirror forbids taken out: s_i s_j = -1 entries are zero.
  Eigen::MatrixXd factor_at_rest(const Eigen::MatrixXd &rest, bool has_mirror = true);

  /// Entries of C (row by row, j <= i, diagonal as logarithm) of a resistance: L_0 C C^T L_0^T.
  Eigen::VectorXd factor_entries(const Eigen::MatrixXd &factor_at_rest, const Eigen::MatrixXd &resistance);

  /// L^-1 A L^-T: the symmetric A in the coordinates where L L^T is the identity.
  Eigen::MatrixXd seen_from(const Eigen::MatrixXd &L, const Eigen::MatrixXd &A);

  /// Parity under the mirror of generalised velocity i: +1 along the axis, -1 across, turning and bending.
  constexpr int velocity_parity(const int i)
  {
    return i == 0 ? 1 : -1;
  }
} // namespace swimtwin
