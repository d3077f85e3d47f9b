// An estimate and its way to the minimum nearby.
#pragma once

#include <calibration/fit/fit.h>

namespace swimtwin
{
  /// Of the integration: 1e-4 of a displacement or so.
  inline constexpr double estimate_tolerance = 1e-7;

  class LocalFit
  {
  public:
    /// Moves `estimate` from its unknowns; both must live as long.
    LocalFit(const FitInput &input, Estimate &estimate);

    /// Towards the minimum nearby where residuals are larger than what a table of all bounds is off by: a trust region,
    /// with a table of it as the model, whose steps count only if runs find the misfit lower. Only misfit, unknowns and
    /// table of the estimate are set.
    void approach();
    /// Search on a table around the estimate, polish there, and look with exact displacements and sensitivities whether
    /// that is the minimum; if not, again from where those lead. The misfit does not grow.
    void converge();
    /// The same on the table that the estimate has, once and without exact displacements.
    void converge_on_table();

    /// Predictions and information at the estimate with exact displacements and sensitivities.
    void describe();

    CalibratedSwimmer swimmer() const;

  private:
    GroupBox box_around(const Eigen::VectorXd &half) const;
    GroupBox local_box() const;
    void     make_local_table();
    void     look(DisplacementSource &source);
    bool     move_if_lower(void (LocalFit::*move)());
    void     move_on_table();
    void     move_by_sensitivities();
    void     polish();
    void     search_on_table();
    void     settle();
    bool     stay_on_table(const Eigen::VectorXd &from);
    void     clip();
    void     describe(const Displacements &displacements);
    void     set_kkt_residual();
    void     judge();
    bool     approach_within(double &radius, DisplacementSource &exact);

    std::shared_ptr<DisplacementTable> rough_table(double radius);

    Eigen::VectorXd remaining_step() const;
    bool            is_held(Eigen::Index j, double slope) const;

    const FitInput &input_;
    Estimate       &estimate_;
    MotionGroups    groups_;
    Eigen::VectorXd lower_, upper_;
    MisfitRows      rows_; ///< at the estimate
  };
} // namespace swimtwin
