#include <datasets/reduced/reduced_model_rules.h>

#include <fmt/format.h>

#include <array>
#include <utility>

namespace swimtwin
{
  namespace
  {
    /// Collects the first problem: later rules may rely on earlier ones only if they ask `ok()`.
    class Rules
    {
    public:
      bool ok() const { return problem_.path.empty(); }

      void require(const char *path, const bool condition, const std::string &sentence)
      {
        if (ok() && !condition)
          problem_ = {path, sentence};
      }

      template <typename Matrix>
      void require_size(const char *path, const Matrix &values, const Eigen::Index rows, const Eigen::Index columns)
      {
        require(path, values.rows() == rows && values.cols() == columns,
                fmt::format("has {} x {} values; {} x {} are needed.", values.rows(), values.cols(), rows, columns));
        if constexpr (std::is_floating_point_v<typename Matrix::Scalar>)
          require(path, values.allFinite(), "holds a value that is not finite; train the model again.");
      }

      void require_finite(const char *path, const double value, const char *name)
      {
        require(path, std::isfinite(value),
                fmt::format("has {} = {}, which is not finite; train the model again.", name, value));
      }

      ModelProblem problem() const { return problem_; }

    private:
      ModelProblem problem_;
    };

    bool are_indices(const Eigen::MatrixXi &indices, const Eigen::Index end)
    {
      return indices.size() == 0 || (indices.minCoeff() >= 0 && indices.maxCoeff() < end);
    }

    void check(Rules &rules, const ShapePolynomials &polynomials, const std::string &path, const Eigen::Index r,
               const Eigen::Index n_values)
    {
      const std::string exponents = path + "_exponents", scale = path + "_scale_m",
                        coefficients = path + "_coefficients";
      rules.require_size(scale.c_str(), polynomials.scale_m, r, 1);
      rules.require(scale.c_str(), (polynomials.scale_m.array() > 0.).all(), "holds a number that is not positive.");
      rules.require_size(exponents.c_str(), polynomials.exponents, polynomials.exponents.rows(), r);
      rules.require(exponents.c_str(), (polynomials.exponents.array() >= 0).all(), "holds a negative exponent.");
      rules.require_size(coefficients.c_str(), polynomials.coefficients, polynomials.exponents.rows(), n_values);
    }

    void check(Rules &rules, const ReducedTail &tail)
    {
      const Eigen::Index n = tail.nodes_m.rows(), R = tail.modes.cols(), s = tail.followers.rows(), r = R - s;
      if (tail.amplitudes.are_given())
      {
        check(rules, tail.amplitudes, "/tail/amplitude", tail.n_coordinates(), R);
        rules.require("/tail/followers", s == 0, "is there beside polynomials of the amplitudes.");
      }
      const int dim = tail.dimension();
      rules.require("/tail/nodes_m", n > 0, "is empty.");
      rules.require_size("/tail/nodes_m", tail.nodes_m, n, dim == 3 ? 3 : 2);
      rules.require_size("/tail/cells", tail.cells, tail.cells.rows(), dim == 3 ? 10 : 6);
      rules.require("/tail/cells", are_indices(tail.cells, n),
                    fmt::format("names a node that is not in 0 to {}.", n - 1));
      rules.require_size("/tail/modes", tail.modes, dim * n, R);
      rules.require("/tail/followers", r >= 0, fmt::format("has {} followers among {} modes.", s, R));
      rules.require_size("/tail/followers", tail.followers, s, s > 0 ? r * (r + 1) / 2 : tail.followers.cols());
      rules.require_size("/tail/parity", tail.parity, R, 1);
      rules.require("/tail/parity", (tail.parity.array() == 1 || tail.parity.array() == -1).all(),
                    "holds a number that is neither 1 nor -1.");
      rules.require("/tail/tip_nodes",
                    tail.tip_node >= 0 && tail.tip_node < n && tail.before_tip_node >= 0 && tail.before_tip_node < n,
                    fmt::format("names a node that is not in 0 to {}.", n - 1));
    }

    void check(Rules &rules, const ReducedElasticity &elasticity, const int r, const int n_coordinates)
    {
      const int n = strain_monomial(r, r, 0);
      if (elasticity.energy.are_given())
        return check(rules, elasticity.energy, "/elasticity/energy", n_coordinates, 1);
      for (const auto &[path, gram] :
           {std::pair<const char *, const Eigen::MatrixXd &>{"/elasticity/gram_lambda", elasticity.gram_lambda},
            {"/elasticity/gram_mu", elasticity.gram_mu}})
      {
        rules.require_size(path, gram, n, n);
        if (rules.ok())
          rules.require(path, gram.isApprox(gram.transpose(), 1e-10), "is not symmetric.");
      }
      rules.require("/elasticity", elasticity.poisson_ratio > -1. && elasticity.poisson_ratio < 0.5,
                    fmt::format("has poisson_ratio = {}; it must lie between -1 and 0.5.", elasticity.poisson_ratio));
    }

    void check(Rules &rules, const ReducedMagnet &magnet, const int r)
    {
      rules.require_finite("/magnet", magnet.head_area_m2, "head_area_m2");
      rules.require_size("/magnet/tail_area_m2", magnet.tail_area_m2, 2, 1);
      rules.require_size("/magnet/tail_area_of_mode_m", magnet.tail_area_of_mode_m, 2, r);
    }

    void check(Rules &rules, const ReducedArea &area, const int r)
    {
      rules.require_size("/area/linear_m", area.linear_m, r, 1);
      rules.require_size("/area/quadratic", area.quadratic, r, r);
      if (rules.ok())
        rules.require("/area/linear_m", !area.is_kept || area.linear_m.norm() > 0.,
                      "is zero although the area is kept: no mode changes the area.");
    }

    void check(Rules &rules, const ReducedResistance &resistance, const int r)
    {
      const int n = r + 3, n_coordinates = r + resistance.n_pose_coordinates();
      rules.require_size("/resistance/factor_at_rest", resistance.factor_at_rest, n, n);
      if (rules.ok())
        rules.require("/resistance/factor_at_rest",
                      resistance.factor_at_rest.isLowerTriangular(0.) &&
                          (resistance.factor_at_rest.diagonal().array() > 0.).all(),
                      "is not lower triangular with a positive diagonal.");
      rules.require_size("/resistance/coordinate_scale_m", resistance.coordinate_scale_m, r, 1);
      rules.require("/resistance/coordinate_scale_m", (resistance.coordinate_scale_m.array() > 0.).all(),
                    "holds a number that is not positive.");
      rules.require("/resistance", std::isfinite(resistance.angle_scale_rad) && resistance.angle_scale_rad > 0.,
                    fmt::format("has angle_scale_rad = {}; it must be positive.", resistance.angle_scale_rad));
      rules.require("/resistance", std::isfinite(resistance.height_scale_m) && resistance.height_scale_m > 0.,
                    fmt::format("has height_scale_m = {}; it must be positive.", resistance.height_scale_m));
      rules.require_finite("/resistance", resistance.usual_by_sine_m, "usual_by_sine_m");
      if (resistance.depends_on_height)
        rules.require_size("/resistance/usual_by_coordinate", resistance.usual_by_coordinate, r, 1);
      rules.require_size("/resistance/exponents", resistance.exponents, resistance.exponents.rows(), n_coordinates);
      rules.require("/resistance/exponents", (resistance.exponents.array() >= 0).all(), "holds a negative exponent.");
      rules.require_size("/resistance/coefficients", resistance.coefficients, resistance.exponents.rows(),
                         n * (n + 1) / 2);
      const auto &halves = resistance.half_fits;
      rules.require("/resistance", halves.empty() || halves.size() == 2,
                    "holds one fit to half of the samples; two are needed, or none.");
      for (const Eigen::MatrixXd &half : halves)
        rules.require_size("/resistance/half_fit", half, resistance.exponents.rows(), n * (n + 1) / 2);
    }

    void check(Rules &rules, const ReducedInertia &inertia, const ReducedResistance &resistance, const int r)
    {
      if (!inertia.is_given())
        return;
      const int n = r + 3, n_pairs = n * (n + 1) / 2, n_features = static_cast<int>(inertia.exponents.rows());
      rules.require_size("/inertia/exponents", inertia.exponents, n_features, r + resistance.n_pose_coordinates());
      rules.require("/inertia/exponents", (inertia.exponents.array() >= 0).all(), "holds a negative exponent.");
      for (const auto &[name, material] :
           {std::pair<std::string, const InertiaPolynomials &>{"/inertia/fluid", inertia.fluid},
            {"/inertia/tail", inertia.tail}})
      {
        const std::string factor = name + "_factor_at_rest", mass = name + "_mass", quadratic = name + "_quadratic";
        rules.require_size(factor.c_str(), material.factor_at_rest, n, n);
        if (rules.ok())
          rules.require(factor.c_str(),
                        material.factor_at_rest.isLowerTriangular(0.) &&
                            (material.factor_at_rest.diagonal().array() > 0.).all(),
                        "is not lower triangular with a positive diagonal.");
        rules.require_size(mass.c_str(), material.mass, n_features, n_pairs);
        rules.require_size(quadratic.c_str(), material.quadratic, n_features, n * n_pairs);
      }
      for (const auto &[name, value] : {std::pair{"head_area_m2", inertia.head_area_m2},
                                        std::pair{"head_second_moment_m4", inertia.head_second_moment_m4}})
        rules.require("/inertia", std::isfinite(value) && value >= 0.,
                      fmt::format("has {} = {}; it must not be negative.", name, value));
    }

    void check(Rules &rules, const TrainedRange &range)
    {
      for (const auto &[path, interval] : {std::pair{"/range/young_modulus_Pa", range.young_modulus_Pa},
                                           {"/range/viscosity_Pa_s", range.viscosity_Pa_s},
                                           {"/range/magnetization_A_m", range.magnetization_A_m},
                                           {"/range/frequency_Hz", range.frequency_Hz},
                                           {"/range/bx_T", range.bx_T},
                                           {"/range/by_T", range.by_T}})
        rules.require(path,
                      std::isfinite(interval.low) && std::isfinite(interval.high) && interval.low <= interval.high,
                      fmt::format("holds {} to {}; it must be two finite numbers, the lower one first.", interval.low,
                                  interval.high));
    }
  } // namespace

  ModelProblem find_problem(const ReducedModel &model)
  {
    Rules rules;
    check(rules, model.tail);
    check(rules, model.elasticity, model.tail.n_amplitudes(), model.n_modes());
    rules.require("/elasticity", model.elasticity.energy.are_given() == model.tail.amplitudes.are_given(),
                  "and /tail disagree: polynomials of shapes and of the energy belong together.");
    rules.require("/elasticity", model.dimension() == 2 || model.elasticity.energy.are_given(),
                  "has Gram matrices, which a swimmer in space does not know.");
    check(rules, model.magnet, model.tail.n_amplitudes());
    check(rules, model.area, model.tail.n_amplitudes());
    check(rules, model.resistance, model.n_modes());
    check(rules, model.inertia, model.resistance, model.n_modes());
    check(rules, model.range);
    return rules.problem();
  }
} // namespace swimtwin
