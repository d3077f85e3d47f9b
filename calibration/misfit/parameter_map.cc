#include <calibration/misfit/parameter_map.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    void set_value(CalibratedSwimmer &s, const FittedQuantity quantity, const double value)
    {
      switch (quantity)
      {
      case FittedQuantity::young_modulus_over_viscosity:
        s.young_modulus_Pa = value * s.viscosity_Pa_s;
        break;
      case FittedQuantity::magnetization_over_viscosity:
        s.magnetization_A_m = value * s.viscosity_Pa_s;
        break;
      case FittedQuantity::young_modulus:
        s.young_modulus_Pa = value;
        break;
      case FittedQuantity::viscosity:
        s.viscosity_Pa_s = value;
        break;
      case FittedQuantity::magnetization:
        s.magnetization_A_m = value;
        break;
      case FittedQuantity::field_scale:
        s.field_scale = value;
        break;
      case FittedQuantity::geometry_scale:
        s.geometry_scale = value;
        break;
      case FittedQuantity::displacement_scale:
        s.displacement_scale = value;
        break;
      case FittedQuantity::displacement_offset:
        s.displacement_offset_m = value;
        break;
      case FittedQuantity::noise_scale:
        s.noise_scale = value;
      }
    }

    /// The viscosity first: ratios refer to it.
    template <typename List, typename Value>
    void set_all(CalibratedSwimmer &s, const List &list, const Value &value_of_entry)
    {
      for (const bool viscosity : {true, false})
        for (std::size_t i = 0; i < list.size(); ++i)
          if ((list[i].quantity == FittedQuantity::viscosity) == viscosity)
            set_value(s, list[i].quantity, value_of_entry(i));
    }

    /// The recording's quantity that a parameter other than a ratio is.
    int row_of(const FittedQuantity quantity)
    {
      switch (quantity)
      {
      case FittedQuantity::young_modulus_over_viscosity:
      case FittedQuantity::young_modulus:
        return by_young_modulus;
      case FittedQuantity::viscosity:
        return by_viscosity;
      case FittedQuantity::magnetization_over_viscosity:
      case FittedQuantity::magnetization:
        return by_magnetization;
      case FittedQuantity::field_scale:
        return by_field_scale;
      case FittedQuantity::geometry_scale:
        return by_geometry_scale;
      case FittedQuantity::displacement_scale:
        return by_displacement_scale;
      default:
        return by_displacement_offset;
      }
    }
  } // namespace

  double value_of(const FittedQuantity quantity, const CalibratedSwimmer &s)
  {
    switch (quantity)
    {
    case FittedQuantity::young_modulus_over_viscosity:
      return s.young_modulus_Pa / s.viscosity_Pa_s;
    case FittedQuantity::magnetization_over_viscosity:
      return s.magnetization_A_m / s.viscosity_Pa_s;
    case FittedQuantity::young_modulus:
      return s.young_modulus_Pa;
    case FittedQuantity::viscosity:
      return s.viscosity_Pa_s;
    case FittedQuantity::magnetization:
      return s.magnetization_A_m;
    case FittedQuantity::field_scale:
      return s.field_scale;
    case FittedQuantity::geometry_scale:
      return s.geometry_scale;
    case FittedQuantity::displacement_scale:
      return s.displacement_scale;
    case FittedQuantity::displacement_offset:
      return s.displacement_offset_m;
    default:
      return s.noise_scale;
    }
  }

  CalibratedSwimmer nominal_swimmer(const CalibrationProblem &problem, const CalibratedSwimmer &scene)
  {
    CalibratedSwimmer s = scene;
    set_all(s, problem.given, [&](const std::size_t i) { return problem.given[i].value; });
    return s;
  }

  ParameterMap::ParameterMap(const CalibrationProblem &problem, const CalibratedSwimmer &nominal,
                             const double displacement_m)
      : nominal_(nominal_swimmer(problem, nominal))
  {
    for (const FreeParameter &free : problem.free)
      if (free.quantity != FittedQuantity::noise_scale)
        free_.push_back(free);
    for (const FreeParameter &free : free_)
      units_.push_back(free.quantity == FittedQuantity::displacement_offset ? displacement_m
                                                                            : value_of(free.quantity, nominal_));
    for (const GivenValue &given : problem.given)
    {
      if (given.quantity == FittedQuantity::young_modulus_over_viscosity)
        young_modulus_over_viscosity_ = given.value;
      if (given.quantity == FittedQuantity::magnetization_over_viscosity)
        magnetization_over_viscosity_ = given.value;
    }
  }

  std::vector<std::string> ParameterMap::names() const
  {
    std::vector<std::string> list;
    for (const FreeParameter &free : free_)
      list.push_back(key_of(free.quantity));
    return list;
  }

  double ParameterMap::value(const int j, const double x) const
  {
    return free_[static_cast<std::size_t>(j)].logarithmic ? std::exp(x) : x * unit(j);
  }

  double ParameterMap::scaled(const int j, const double value) const
  {
    return free_[static_cast<std::size_t>(j)].logarithmic ? std::log(value) : value / unit(j);
  }

  double ParameterMap::value_slope(const int j, const double x) const
  {
    return free_[static_cast<std::size_t>(j)].logarithmic ? std::exp(x) : unit(j);
  }

  Eigen::VectorXd ParameterMap::values(const Eigen::VectorXd &x) const
  {
    return Eigen::VectorXd::NullaryExpr(size(), [&](const Eigen::Index j) { return value(static_cast<int>(j), x[j]); });
  }

  Eigen::VectorXd ParameterMap::lower() const
  {
    return Eigen::VectorXd::NullaryExpr(size(), [&](const Eigen::Index j) {
      return scaled(static_cast<int>(j), free_[static_cast<std::size_t>(j)].lower);
    });
  }

  Eigen::VectorXd ParameterMap::upper() const
  {
    return Eigen::VectorXd::NullaryExpr(size(), [&](const Eigen::Index j) {
      return scaled(static_cast<int>(j), free_[static_cast<std::size_t>(j)].upper);
    });
  }

  Eigen::VectorXd ParameterMap::nominal() const
  {
    return Eigen::VectorXd::NullaryExpr(size(), [&](const Eigen::Index j) {
      const FreeParameter &free = free_[static_cast<std::size_t>(j)];
      return scaled(static_cast<int>(j), std::clamp(value_of(free.quantity, nominal_), free.lower, free.upper));
    });
  }

  CalibratedSwimmer ParameterMap::swimmer(const Eigen::VectorXd &x) const
  {
    CalibratedSwimmer     s      = nominal_;
    const Eigen::VectorXd values = this->values(x);
    set_all(s, free_, [&](const std::size_t j) { return values[static_cast<Eigen::Index>(j)]; });
    if (young_modulus_over_viscosity_)
      s.young_modulus_Pa = *young_modulus_over_viscosity_ * s.viscosity_Pa_s;
    if (magnetization_over_viscosity_)
      s.magnetization_A_m = *magnetization_over_viscosity_ * s.viscosity_Pa_s;
    return s;
  }

  bool ParameterMap::is_free(const FittedQuantity quantity) const
  {
    return std::any_of(free_.begin(), free_.end(), [&](const FreeParameter &f) { return f.quantity == quantity; });
  }

  Eigen::MatrixXd ParameterMap::slopes(const Eigen::VectorXd &x) const
  {
    using enum FittedQuantity;
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n_recording_quantities, size());
    for (int j = 0; j < size(); ++j)
    {
      const FreeParameter &free         = free_[static_cast<std::size_t>(j)];
      const double         by_logarithm = value_slope(j, x[j]) / value(j, x[j]); // 1 for a logarithm
      if (free.quantity == displacement_offset)
        A(by_displacement_offset, j) = unit(j);
      else
        A(row_of(free.quantity), j) = by_logarithm;
      if (free.quantity == viscosity && (young_modulus_over_viscosity_ || is_free(young_modulus_over_viscosity)))
        A(by_young_modulus, j) = by_logarithm;
      if (free.quantity == viscosity && (magnetization_over_viscosity_ || is_free(magnetization_over_viscosity)))
        A(by_magnetization, j) = by_logarithm;
    }
    return A;
  }

  std::array<bool, n_motion_quantities> ParameterMap::needed() const
  {
    const Eigen::MatrixXd                 A = slopes(nominal());
    std::array<bool, n_motion_quantities> needed{};
    for (std::size_t q = 0; q < n_motion_quantities; ++q)
      needed[q] = A.row(static_cast<Eigen::Index>(q)).any();
    return needed;
  }

  GroupBox ParameterMap::group_box(const MotionGroups &groups, const Eigen::VectorXd &lower,
                                   const Eigen::VectorXd &upper) const
  {
    // Every group is monotone in every variable, so that its extremes are at corners.
    const Eigen::MatrixXd by_x  = groups.slopes() * slopes(nominal()).topRows<n_motion_quantities>();
    const Eigen::VectorXd at    = groups.values(swimmer(nominal()));
    const auto            reach = [&](const Eigen::Index g, const bool highest) {
      Eigen::VectorXd corner = nominal();
      for (Eigen::Index j = 0; j < corner.size(); ++j)
        if (by_x(g, j) != 0.)
          corner[j] = (by_x(g, j) > 0.) == highest ? upper[j] : lower[j];
      return groups.values(swimmer(corner))[g];
    };
    GroupBox box{at, at};
    for (Eigen::Index g = 0; g < at.size(); ++g)
      if (by_x.row(g).any())
      {
        box.lower[g] = reach(g, false);
        box.upper[g] = reach(g, true);
      }
    return box;
  }

  double ParameterMap::prior_mean(const int j) const
  {
    return scaled(j, free_[static_cast<std::size_t>(j)].prior->mean);
  }

  double ParameterMap::prior_standard_deviation(const int j) const
  {
    const auto &[quantity, lower, upper, logarithmic, start, prior] = free_[static_cast<std::size_t>(j)];
    if (!prior)
      return std::numeric_limits<double>::infinity();
    return prior->standard_deviation / (logarithmic ? prior->mean : unit(j));
  }
} // namespace swimtwin
