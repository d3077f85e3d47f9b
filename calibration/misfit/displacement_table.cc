#include <calibration/misfit/displacement_table.h>
#include <datasets/system/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Displacements are smooth in the groups' logarithms, with poles about this far from the real axis: a peak of the
    /// form x / (1 + x^2) has them at pi / 2; with the coarser features of a start from rest it is nearer.
    constexpr double distance_of_poles = 1.;

    /// Polynomials of an interval of half this width converge as the ellipse through the poles says.
    int n_nodes_for(const double half_width, const TableOptions &options)
    {
      if (half_width <= 0.)
        return 1;
      const double x    = distance_of_poles / half_width;
      const double rate = std::log(x + std::sqrt(1. + x * x));
      const int    n    = 1 + static_cast<int>(std::ceil(-std::log(options.interpolation_error) / rate));
      return std::clamp(n, 3, options.largest_n_nodes);
    }

    NodeGrid grid_of(const GroupBox &box, const TableOptions &options)
    {
      std::vector<int> n_nodes;
      for (Eigen::Index g = 0; g < box.lower.size(); ++g)
        n_nodes.push_back(n_nodes_for(0.5 * (box.upper[g] - box.lower[g]), options));
      return {box, n_nodes};
    }

    struct NodeValues
    {
      Eigen::MatrixXd          displacement_m; ///< conditions x nodes
      std::vector<std::size_t> failed;         ///< nodes
      std::string              failure;
    };

    NodeValues values_at(const NodeGrid &grid, const CalibrationModel &model,
                         const std::vector<SwimmingCondition> &conditions, const TableOptions &options)
    {
      const MotionGroups groups(model);
      NodeValues         values;
      values.displacement_m.resize(static_cast<Eigen::Index>(conditions.size()),
                                   static_cast<Eigen::Index>(grid.size()));
      std::mutex  reporting;
      std::size_t n_done = 0;
      parallel_for(grid.size(), options.n_threads, [&] {
        auto exact = std::make_shared<ExactDisplacements>(
            model, conditions, ExactOptions{.relative_tolerance = options.relative_tolerance, .by = {}});
        return [&, exact](const std::size_t i) {
          const Displacements  &at = exact->evaluate(groups.swimmer(grid.node(i)), false);
          const std::lock_guard lock(reporting);
          values.displacement_m.col(static_cast<Eigen::Index>(i)) = at.value_m;
          if (at.failed())
          {
            values.failed.push_back(i);
            values.failure = at.failure;
          }
          if (options.on_progress)
            options.on_progress(static_cast<double>(++n_done) / static_cast<double>(grid.size()));
        };
      });
      return values;
    }

    /// T_0 .. T_{n-1}, or their derivatives.
    Eigen::VectorXd chebyshev(const double x, const int n, const bool derivative)
    {
      Eigen::VectorXd T(n), D(n);
      for (int k = 0; k < n; ++k)
      {
        T[k] = k == 0 ? 1. : k == 1 ? x : 2. * x * T[k - 1] - T[k - 2];
        D[k] = k == 0 ? 0. : k == 1 ? 1. : 2. * T[k - 1] + 2. * x * D[k - 1] - D[k - 2];
      }
      return derivative ? D : T;
    }

    /// From values at the nodes to coefficients.
    Eigen::MatrixXd transform(const int n)
    {
      Eigen::MatrixXd values(n, n);
      for (int k = 0; k < n; ++k)
        values.row(k) = chebyshev(chebyshev_node(k, n), n, false);
      return values.inverse();
    }
  } // namespace

  DisplacementTable::DisplacementTable(const CalibrationModel &model, const NodeGrid &grid,
                                       const Eigen::MatrixXd &values)
      : groups_(model), box_(grid.box()), n_nodes_(grid.n_nodes())
  {
    set_coefficients(values);
  }

  std::unique_ptr<DisplacementTable> DisplacementTable::make(const CalibrationModel               &model,
                                                             const std::vector<SwimmingCondition> &conditions,
                                                             const GroupBox &box, const TableOptions &options,
                                                             std::string &failure)
  {
    std::optional<GroupBox> left   = box;
    long                    n_runs = 0;
    while (left)
    {
      const NodeGrid   grid   = grid_of(*left, options);
      const NodeValues values = values_at(grid, model, conditions, options);
      n_runs += static_cast<long>(grid.size() * conditions.size());
      failure = values.failure;
      if (values.failed.empty())
      {
        auto table     = std::unique_ptr<DisplacementTable>(new DisplacementTable(model, grid, values.displacement_m));
        table->n_runs_ = n_runs;
        return table;
      }
      left = options.narrow_around ? grid.without(values.failed, *options.narrow_around) : std::nullopt;
    }
    return nullptr;
  }

  void DisplacementTable::set_coefficients(const Eigen::MatrixXd &values)
  {
    Eigen::MatrixXd C      = values;
    Eigen::Index    stride = 1;
    for (const int n : n_nodes_)
    {
      const Eigen::MatrixXd A = transform(n), before = C;
      C.setZero();
      for (Eigen::Index column = 0; column < C.cols(); ++column)
      {
        const Eigen::Index k = (column / stride) % n, first = column - k * stride;
        for (Eigen::Index j = 0; j < n; ++j)
          C.col(column) += A(k, j) * before.col(first + j * stride);
      }
      stride *= n;
    }
    coefficients_ = std::make_shared<const Eigen::MatrixXd>(std::move(C));
    result_.value_m.resize(values.rows());
    result_.by_logarithm.resize(values.rows(), n_motion_quantities);
    for (int g = 0; g < groups_.size(); ++g)
      interpolation_error_ = std::max(interpolation_error_, tail(g) / values.cwiseAbs().maxCoeff());
  }

  /// Largest sum, over the conditions, of the coefficients of a group's highest polynomial.
  double DisplacementTable::tail(const int group) const
  {
    const int n = n_nodes_[static_cast<std::size_t>(group)];
    if (n == 1)
      return 0.;
    Eigen::Index stride = 1;
    for (int g = 0; g < group; ++g)
      stride *= n_nodes_[static_cast<std::size_t>(g)];
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(coefficients_->rows());
    for (Eigen::Index column = 0; column < coefficients_->cols(); ++column)
      if ((column / stride) % n == n - 1)
        sum += coefficients_->col(column).cwiseAbs();
    return sum.maxCoeff();
  }

  Eigen::VectorXd DisplacementTable::basis(const Eigen::VectorXd &place, const int derivative_of) const
  {
    Eigen::VectorXd products = Eigen::VectorXd::Ones(1);
    for (int g = 0; g < groups_.size(); ++g)
    {
      const Eigen::VectorXd T     = chebyshev(place[g], n_nodes_[static_cast<std::size_t>(g)], g == derivative_of);
      const Eigen::MatrixXd outer = products * T.transpose();
      products                    = outer.reshaped();
    }
    return products;
  }

  bool DisplacementTable::covers(const CalibratedSwimmer &swimmer) const
  {
    const Eigen::VectorXd g = groups_.values(swimmer);
    return (g.array() >= box_.lower.array() - 1e-9).all() && (g.array() <= box_.upper.array() + 1e-9).all();
  }

  const Displacements &DisplacementTable::evaluate(const CalibratedSwimmer &swimmer, const bool derivatives)
  {
    const Eigen::VectorXd half   = 0.5 * (box_.upper - box_.lower);
    const Eigen::VectorXd offset = groups_.values(swimmer) - 0.5 * (box_.upper + box_.lower);
    const Eigen::VectorXd wanted = (half.array() > 0.).select(offset.array() / half.array(), 0.);
    const Eigen::VectorXd place  = wanted.cwiseMax(-1.).cwiseMin(1.);
    result_.value_m              = *coefficients_ * basis(place, -1);
    if (derivatives)
      result_.by_logarithm.setZero();
    for (int g = 0; g < groups_.size(); ++g)
    {
      const double beyond = wanted[g] - place[g];
      if (half[g] <= 0. || (!derivatives && beyond == 0.))
        continue;
      const Eigen::VectorXd slope = *coefficients_ * basis(place, g);
      result_.value_m += beyond * slope;
      if (derivatives)
        result_.by_logarithm += slope / half[g] * groups_.slopes().row(g);
    }
    return result_;
  }
} // namespace swimtwin
