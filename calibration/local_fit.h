// An estimate and its way to the minimum nearby.
#pragma once

#include <calibration/fit.h>

namespace swimtwin
{
  /// Of the integration: 1e-4 of a displacement or so.
  inline constexpr double estimate_tolerance = 1e-7;

  class LocalFit
  {
  public:
    /// Moves `estimate` from its unknowns; both must live as long.
    LocalFit(const FitInput &input, Estimate &estimate);

    /// Search on a table around the estimate, polish there, and look with exact displacements and sensitivities whether
    /// that is the minimum; if not, again from where those lead.
    void converge();
    /// The same on the table that the estimate has, once and without exact displacements.
    void converge_on_table();

    /// Predictions and information at the estimate with exact displacements and sensitivities.
    void describe();

    CalibratedSwimmer swimmer() const;

  private:
    GroupBox local_box() const;
    void     make_local_table();
    void     polish(const Eigen::VectorXd &start);
    void     settle(DisplacementSource &source);
    void     converge_by_runs();
    void     describe(const Displacements &displacements);
    void     set_kkt_residual();
    void     judge(const Eigen::VectorXd &step, double share);
    void     clip();
    double   size_of_residuals() const;

    Eigen::VectorXd remaining_step() const;
    bool            is_held(Eigen::Index j, double slope) const;

    const FitInput &input_;
    Estimate       &estimate_;
    MotionGroups    groups_;
    Eigen::VectorXd lower_, upper_;
    MisfitRows      rows_; ///< at the estimate
  };
} // namespace swimtwin
