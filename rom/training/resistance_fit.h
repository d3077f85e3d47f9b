// Fit of the resistance surrogate to samples: log-Cholesky polynomials with the mirror's parity, where there is one,
// built in.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/training/economy.h>
#include <rom/training/factor_entries.h>
#include <rom/training/sample_table.h>
#include <rom/training/sampled_region.h>

#include <functional>
#include <vector>

namespace swimtwin
{
  /// How much worse than the best a fit with fewer monomials may be.
  struct FitEconomy
  {
    double nearly = nearly_as_good; ///< times the best one's error
    /// If given, third_ways with a resistance: fits up to `no_rival` times worse will do with which they are alike.
    std::function<Eigen::Matrix2Xd(const ReducedResistance &)> ways   = {};
    double                                                     target = 0.; ///< of the model
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

    /// Fit again, with the same monomials, to these samples too, each of which counts for many: as many as leave
    /// the fit sound beyond the region.
    void favour(const std::vector<ResistanceSample> &used);

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
    void        fit_chosen_features(const std::vector<Eigen::MatrixXi> &sets, const FitEconomy &economy);
    SampleTable table_of(const std::vector<ResistanceSample> &samples) const;
    void        fit_halves();
    void        find_covariance();
    double      condition_beyond(const Eigen::MatrixXd &coefficients) const;

    SampledRegion                region_;
    SampleTable                  table_;
    ReducedResistance            resistance_;
    FitQuality                   quality_;
    FitRestraint                 restraint_;
    SampleTable                  guide_;
    Eigen::MatrixXd              beyond_;     ///< the region: variables, a row each, where fits must be sound
    double                       bound_ = 0.; ///< largest condition of a sound one
    std::vector<FittedTogether>  parts_;
    std::vector<Eigen::MatrixXd> covariance_; ///< (A^T A)^-1 of their design matrices
  };
} // namespace swimtwin
