// Displacements of one swimmer under the conditions of all observations, computed or interpolated.
#pragma once

#include <datasets/observation/calibration_result.h>

#include <Eigen/Dense>

#include <string>

namespace swimtwin
{
  /// What the motion depends on, as columns of derivatives.
  enum MotionQuantity { by_young_modulus, by_viscosity, by_magnetization, by_field_scale, n_motion_quantities };

  struct Displacements
  {
    Eigen::VectorXd value_m;      ///< of the head per period, positive head first; one per condition
    Eigen::MatrixXd by_logarithm; ///< by the logarithms of MotionQuantity (m), n x 4; zero columns: not asked for
    std::string     failure;      ///< one sentence; then the numbers do not count

    bool failed() const { return !failure.empty(); }
  };

  /// Geometry, displacement scale and offset of the swimmer do not enter: its lengths are the scene's. Belongs to one
  /// caller at a time.
  class DisplacementSource
  {
  public:
    virtual ~DisplacementSource() = default;

    virtual int                  n_conditions() const                                         = 0;
    virtual const Displacements &evaluate(const CalibratedSwimmer &swimmer, bool derivatives) = 0;
  };

  /// What was computed before, for whatever swimmer is asked for.
  class KnownDisplacements : public DisplacementSource
  {
  public:
    /// `displacements` must live as long.
    explicit KnownDisplacements(const Displacements &displacements) : displacements_(displacements) {}
    int                  n_conditions() const override { return static_cast<int>(displacements_.value_m.size()); }
    const Displacements &evaluate(const CalibratedSwimmer &, bool) override { return displacements_; }

  private:
    const Displacements &displacements_;
  };
} // namespace swimtwin
