#include <calibration/fit/search_misfit.h>

#include <rom/swimmer/dense_algebra.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace swimtwin
{
  namespace
  {
    // A robust loss changes its weights with the components: until these stay.
    constexpr int    most_reweightings  = 50;
    constexpr double smallest_component = 1e-9;

    /// z that makes sum_i w_i (r - A z)_i^2 + |z|^2 least.
    Eigen::VectorXd weighted_components(const Eigen::MatrixXd &A, const Eigen::VectorXd &weights,
                                        const Eigen::VectorXd &r)
    {
      const Eigen::MatrixXd WA     = weights.asDiagonal() * A;
      Eigen::MatrixXd       normal = A.transpose() * WA;
      normal.diagonal().array() += 1.;
      return solve_symmetric<Eigen::VectorXd>(normal, WA.transpose() * r);
    }

    /// z that makes sum_i rho((r - A z)_i) + |z|^2 / 2 least: each reweighting lowers it.
    Eigen::VectorXd fitted_components(const RobustLoss &loss, const Eigen::MatrixXd &A, const Eigen::VectorXd &r)
    {
      Eigen::VectorXd z = Eigen::VectorXd::Zero(A.cols());
      for (int i = 0; i < most_reweightings && z.size() > 0; ++i)
      {
        const Eigen::VectorXd weights = (r - A * z).unaryExpr([&loss](const double s) { return loss.weight(s); });
        const Eigen::VectorXd before  = std::exchange(z, weighted_components(A, weights, r));
        if (!loss.is_robust() || (z - before).lpNorm<Eigen::Infinity>() < smallest_component)
          break;
      }
      return z;
    }
  } // namespace

  Eigen::VectorXd SearchMisfit::unknowns(const Displacements &displacements, const Eigen::VectorXd &x) const
  {
    Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(misfit_.n_unknowns());
    unknowns.head(x.size())  = x;
    KnownDisplacements    known(displacements);
    const Prediction      without_error = misfit_.predict(known, unknowns, false);
    const Eigen::MatrixXd A =
        (misfit_.noise_scale * misfit_.sigma_m).cwiseInverse().asDiagonal() * without_error.by_error;
    unknowns.tail(misfit_.n_components()) = fitted_components(misfit_.loss, A, misfit_.residuals(without_error));
    return unknowns;
  }

  MinimizationProblem SearchMisfit::minimization_problem(std::shared_ptr<DisplacementSource> source) const
  {
    MinimizationProblem problem;
    problem.lower    = misfit_.map().lower();
    problem.upper    = misfit_.map().upper();
    problem.evaluate = [this, source = std::move(source)](const Eigen::VectorXd &x, const bool derivatives,
                                                          Evaluation &evaluation) {
      const Displacements &motion = source->evaluate(misfit_.map().swimmer(x), derivatives);
      evaluation.failure          = motion.failure;
      if (evaluation.failed())
        return;
      KnownDisplacements known(motion);
      const MisfitRows   rows = misfit_.rows(known, unknowns(motion, x), derivatives);
      evaluation.objective    = rows.misfit();
      if (derivatives) // by x alone: at the least misfit that by the components is zero
        evaluation.gradient = rows.by_unknowns.leftCols(x.size()).transpose() * rows.rows;
    };
    return problem;
  }

  double size_of_residuals(const FitInput &input, const double misfit)
  {
    const int n_degrees_of_freedom = std::max(1, input.data.n() - input.map.size());
    return std::max(1., std::sqrt(2. * misfit / n_degrees_of_freedom));
  }

  SearchOptions search_options(const CalibrationProblem &problem)
  {
    return {.method          = search_method(problem.method),
            .max_evaluations = problem.max_evaluations,
            .seed            = static_cast<unsigned long>(problem.seed)};
  }
} // namespace swimtwin
