#include <calibration/search_misfit.h>

namespace swimtwin
{
  SearchMisfit::SearchMisfit(const FitInput &input, const ModelError &error)
      : none_{0., error.decades, "none", {}, Eigen::MatrixXd(input.data.n(), 0)},
        misfit_(input.data, input.map, none_, RobustLoss(input.problem.loss, input.problem.loss_width))
  {
    const Eigen::VectorXd of_model = error.size.cwiseProduct(input.data.observed_m);
    misfit_.sigma_m                = (misfit_.sigma_m.cwiseAbs2() + of_model.cwiseAbs2()).cwiseSqrt();
  }

  MinimizationProblem SearchMisfit::minimization_problem(std::shared_ptr<DisplacementSource> source) const
  {
    MinimizationProblem problem;
    problem.lower    = misfit_.map().lower();
    problem.upper    = misfit_.map().upper();
    problem.evaluate = [this, source = std::move(source)](const Eigen::VectorXd &x, const bool derivatives,
                                                          Evaluation &evaluation) {
      const MisfitRows rows = misfit_.rows(*source, x, derivatives);
      evaluation.failure    = rows.failure;
      if (evaluation.failed())
        return;
      evaluation.objective = rows.misfit();
      if (derivatives)
        evaluation.gradient = rows.by_unknowns.transpose() * rows.rows;
    };
    return problem;
  }

  SearchOptions search_options(const CalibrationProblem &problem)
  {
    return {.method          = search_method(problem.method),
            .max_evaluations = problem.max_evaluations,
            .seed            = static_cast<unsigned long>(problem.seed)};
  }
} // namespace swimtwin
