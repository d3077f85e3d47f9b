#include <rom/swimmer/resistance_surrogate.h>

#include <cmath>

namespace swimtwin
{
  Eigen::VectorXi parity_of_variables(const ReducedResistance &resistance, const Eigen::VectorXi &mode_parity)
  {
    Eigen::VectorXi parity(mode_parity.size() + resistance.n_pose_coordinates());
    parity << mode_parity, Eigen::VectorXi::Constant(resistance.n_pose_coordinates(), -1);
    return parity;
  }

  Eigen::VectorXi parity_of_velocities(const Eigen::VectorXi &mode_parity)
  {
    Eigen::VectorXi parity(mode_parity.size() + 3);
    parity << 1, -1, -1, mode_parity;
    return parity;
  }

  ResistanceSurrogate::ResistanceSurrogate(const ReducedResistance &resistance, const Eigen::VectorXi &parity)
      : factor_at_rest_(resistance.factor_at_rest), coordinate_scale_m_(resistance.coordinate_scale_m),
        depends_on_angle_(resistance.depends_on_angle), angle_scale_rad_(resistance.angle_scale_rad),
        depends_on_height_(resistance.depends_on_height), height_scale_m_(resistance.height_scale_m),
        usual_by_sine_m_(resistance.usual_by_sine_m),
        usual_by_coordinate_(resistance.depends_on_height ? ShapeVector(resistance.usual_by_coordinate)
                                                          : ShapeVector(ShapeVector::Zero(parity.size()))),
        monomials_(resistance.exponents, parity_of_variables(resistance, parity)),
        polynomials_(monomials_, resistance.coefficients)
  {
  }

  ResistanceFactor ResistanceSurrogate::make_factor() const
  {
    const int        n = n_velocities(), m = n_coordinates();
    ResistanceFactor result;
    result.factor             = VelocityMatrix::Zero(n, n);
    result.factor_derivatives = std::vector<VelocityMatrix>(static_cast<std::size_t>(m), VelocityMatrix::Zero(n, n));
    result.coordinate_slopes  = Eigen::MatrixXd::Zero(m, n - 3 + 2);
    result.coordinates        = Eigen::VectorXd::Zero(m);
    result.monomials          = Eigen::VectorXd::Zero(monomials_.size());
    result.polynomials        = Eigen::VectorXd::Zero(polynomials_.n_results());
    return result;
  }

  void ResistanceSurrogate::evaluate(const ShapeVector &q, const double angle_rad, const double height_m,
                                     ResistanceFactor &result) const
  {
    set_coordinates(q, angle_rad, height_m, result);
    monomials_.evaluate(result.coordinates, result.monomials);
    polynomials_.evaluate(result.monomials, result.polynomials);
    set_factor(result);
  }

  void ResistanceSurrogate::differentiate(const ShapeVector &q, const double angle_rad, const double height_m,
                                          ResistanceFactor &result) const
  {
    set_coordinates(q, angle_rad, height_m, result);
    set_coordinate_slopes(q, angle_rad, height_m, result);
    monomials_.evaluate(result.coordinates, result.monomials);
    polynomials_.differentiate(result.monomials, result.polynomials);
    set_factor(result);
    set_factor_derivatives(result);
  }

  double ResistanceSurrogate::shape_radius(const ShapeVector &q) const
  {
    return q.cwiseQuotient(coordinate_scale_m_).norm();
  }

  double ResistanceSurrogate::angle_radius(const double angle_rad) const
  {
    return depends_on_angle_ ? std::abs(angle_rad) / angle_scale_rad_ : 0.;
  }

  double ResistanceSurrogate::usual_height_m(const ShapeVector &q, const double angle_rad) const
  {
    return usual_by_sine_m_ * std::sin(angle_rad) + usual_by_coordinate_.dot(q);
  }

  double ResistanceSurrogate::height_radius(const ShapeVector &q, const double angle_rad, const double height_m) const
  {
    return depends_on_height_ ? std::abs(height_m - usual_height_m(q, angle_rad)) / height_scale_m_ : 0.;
  }

  void ResistanceSurrogate::set_coordinates(const ShapeVector &q, const double angle_rad, const double height_m,
                                            ResistanceFactor &result) const
  {
    const double radius = shape_radius(q), shrink = radius > 1. ? saturated(radius) / radius : 1.;
    result.coordinates.head(q.size()) = shrink * q.cwiseQuotient(coordinate_scale_m_);
    if (depends_on_angle_)
      result.coordinates[q.size()] = std::copysign(saturated(angle_radius(angle_rad)), angle_rad);
    if (depends_on_height_)
      result.coordinates[n_coordinates() - 1] =
          std::copysign(saturated(height_radius(q, angle_rad, height_m)), height_m - usual_height_m(q, angle_rad));
  }

  void ResistanceSurrogate::set_coordinate_slopes(const ShapeVector &q, const double angle_rad, const double height_m,
                                                  ResistanceFactor &result) const
  {
    const Eigen::Index r      = q.size();
    const ShapeVector  z      = q.cwiseQuotient(coordinate_scale_m_);
    const double       radius = z.norm(), shrink = radius > 1. ? saturated(radius) / radius : 1.;
    auto               slopes = result.coordinate_slopes.topLeftCorner(r, r);
    slopes                    = shrink * ShapeMatrix::Identity(r, r);
    if (radius > 1.)
      slopes += (saturated_slope(radius) - shrink) / (radius * radius) * z * z.transpose();
    slopes = (slopes * coordinate_scale_m_.cwiseInverse().asDiagonal()).eval();
    if (depends_on_angle_)
      result.coordinate_slopes(r, r) = saturated_slope(angle_radius(angle_rad)) / angle_scale_rad_;
    if (!depends_on_height_)
      return;
    const double slope = saturated_slope(height_radius(q, angle_rad, height_m)) / height_scale_m_;
    auto         row   = result.coordinate_slopes.row(n_coordinates() - 1);
    row.head(r)        = -slope * usual_by_coordinate_.transpose();
    row[r]             = -slope * usual_by_sine_m_ * std::cos(angle_rad);
    row[r + 1]         = slope;
  }

  Eigen::MatrixXd ResistanceSurrogate::variable_rate_slopes(const ShapeVector &q, const double angle_rad,
                                                            const double height_m, const ShapeVector &q_rate,
                                                            const double angle_rate, const double height_rate) const
  {
    const Eigen::Index r        = q.size();
    Eigen::MatrixXd    result   = Eigen::MatrixXd::Zero(n_coordinates(), r + 2);
    const ShapeVector  by_scale = coordinate_scale_m_.cwiseInverse();
    const ShapeVector  z = q.cwiseProduct(by_scale), v = q_rate.cwiseProduct(by_scale);
    if (const double rho = z.norm(); rho > 1.)
    {
      // dz/dt = a v + b z (z . v) with a = s / rho, b = (s' - a) / rho^2.
      const double b       = (saturated_slope(rho) - saturated(rho) / rho) / (rho * rho);
      const double b_slope = saturated_curvature(rho) / (rho * rho) - 3. * b / rho;
      ShapeMatrix  by_z    = b * (v * z.transpose() + z * v.transpose());
      by_z += z.dot(v) * (b * ShapeMatrix::Identity(r, r) + b_slope / rho * z * z.transpose());
      result.topLeftCorner(r, r) = by_z * by_scale.asDiagonal();
    }
    if (depends_on_angle_)
      result(r, r) = std::copysign(1., angle_rad) * saturated_curvature(angle_radius(angle_rad)) * angle_rate /
                     (angle_scale_rad_ * angle_scale_rad_);
    if (!depends_on_height_)
      return result;
    const double above = height_m - usual_height_m(q, angle_rad), radius = height_radius(q, angle_rad, height_m);
    const double usual_by_angle = usual_by_sine_m_ * std::cos(angle_rad);
    const double rate           = height_rate - usual_by_angle * angle_rate - usual_by_coordinate_.dot(q_rate);
    const double curvature =
        std::copysign(1., above) * saturated_curvature(radius) * rate / (height_scale_m_ * height_scale_m_);
    auto row    = result.row(n_coordinates() - 1);
    row.head(r) = -curvature * usual_by_coordinate_.transpose();
    row[r]      = -curvature * usual_by_angle +
             saturated_slope(radius) * usual_by_sine_m_ * std::sin(angle_rad) * angle_rate / height_scale_m_;
    row[r + 1] = curvature;
    return result;
  }

  void ResistanceSurrogate::set_factor(ResistanceFactor &result) const
  {
    Eigen::Index entry = 0;
    for (int i = 0; i < n_velocities(); ++i)
      for (int j = 0; j <= i; ++j, ++entry)
      {
        const double value  = result.polynomials[polynomials_.value_place(entry)];
        result.factor(i, j) = i == j ? std::exp(value) : value;
      }
  }

  void ResistanceSurrogate::set_factor_derivatives(ResistanceFactor &result) const
  {
    for (int k = 0; k < n_coordinates(); ++k)
    {
      VelocityMatrix &derivative = result.factor_derivatives[static_cast<std::size_t>(k)];
      Eigen::Index    entry      = 0;
      for (int i = 0; i < n_velocities(); ++i)
        for (int j = 0; j <= i; ++j, ++entry)
        {
          const double slope = result.polynomials[polynomials_.slope_place(entry, k)];
          derivative(i, j)   = i == j ? result.factor(i, i) * slope : slope;
        }
    }
  }

  VelocityMatrix ResistanceSurrogate::resistance(const ShapeVector &q, const double angle_rad,
                                                 const double height_m) const
  {
    ResistanceFactor at = make_factor();
    evaluate(q, angle_rad, height_m, at);
    const VelocityMatrix L = factor_at_rest_ * at.factor;
    return L * L.transpose();
  }

  Eigen::VectorXd ResistanceSurrogate::variables(const ShapeVector &q, const double angle_rad,
                                                 const double height_m) const
  {
    ResistanceFactor at = make_factor();
    set_coordinates(q, angle_rad, height_m, at);
    return at.coordinates;
  }

  Eigen::VectorXd ResistanceSurrogate::variables(const ShapeVector &q, const double angle_rad) const
  {
    return variables(q, angle_rad, usual_height_m(q, angle_rad));
  }

  VelocityMatrix ResistanceSurrogate::resistance(const ShapeVector &q, const double angle_rad) const
  {
    return resistance(q, angle_rad, usual_height_m(q, angle_rad));
  }
} // namespace swimtwin
