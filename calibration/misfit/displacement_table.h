// Displacements interpolated over the groups that they depend on: a fit asks for thousands of them.
#pragma once

#include <calibration/misfit/exact_displacements.h>
#include <calibration/misfit/node_grid.h>

#include <functional>
#include <memory>
#include <optional>

namespace swimtwin
{
  struct TableOptions
  {
    double                           relative_tolerance  = 1e-6; ///< of the integration
    double                           interpolation_error = 2e-3; ///< aimed at, relative to the largest displacement
    int                              n_threads           = 1;
    int                              largest_n_nodes     = 17; ///< per group
    std::optional<Eigen::VectorXd>   narrow_around = {}; ///< groups: shrinks the box to where nodes can be computed
    std::function<void(double done)> on_progress   = {}; ///< share of the work, by any thread, one at a time
  };

  /// Chebyshev polynomials in each group, through integrations at the nodes. Outside the box: the tangent at its edge.
  class DisplacementTable : public DisplacementSource
  {
  public:
    /// Empty if a node could not be computed, and with `narrow_around` one next to that place; `failure` says why.
    static std::unique_ptr<DisplacementTable> make(const CalibrationModel               &model,
                                                   const std::vector<SwimmingCondition> &conditions,
                                                   const GroupBox &box, const TableOptions &options,
                                                   std::string &failure);

    /// Shares what was computed.
    std::unique_ptr<DisplacementTable> copy() const { return std::make_unique<DisplacementTable>(*this); }

    int                  n_conditions() const override { return static_cast<int>(result_.value_m.size()); }
    const Displacements &evaluate(const CalibratedSwimmer &swimmer, bool derivatives) override;

    /// What the highest polynomials contribute, relative to the largest displacement: larger than the error.
    double interpolation_error() const { return interpolation_error_; }
    long   n_runs() const { return n_runs_; }
    bool   covers(const CalibratedSwimmer &swimmer) const;

  private:
    DisplacementTable(const CalibrationModel &model, const NodeGrid &grid, const Eigen::MatrixXd &values);

    void   set_coefficients(const Eigen::MatrixXd &values);
    double tail(int group) const;
    /// Products of one polynomial per group; `derivative_of`: its derivative by that group instead.
    Eigen::VectorXd basis(const Eigen::VectorXd &place, int derivative_of) const;

    MotionGroups                           groups_;
    GroupBox                               box_;
    std::vector<int>                       n_nodes_;      ///< per group
    std::shared_ptr<const Eigen::MatrixXd> coefficients_; ///< conditions x products, the first group fastest
    Displacements                          result_;
    double                                 interpolation_error_ = 0.;
    long                                   n_runs_              = 0;
  };
} // namespace swimtwin
