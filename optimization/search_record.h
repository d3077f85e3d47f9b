// Every point that a search has seen: counted, within a budget, the best one kept.
#pragma once

#include <optimization/minimization_problem.h>

#include <optional>

namespace swimtwin
{
  struct SearchPoint
  {
    Eigen::VectorXd x;
    Evaluation      evaluation;
    bool            with_derivatives = false;
    double          violation        = 0.; ///< the largest, in constraint scales
  };

  class SearchRecord
  {
  public:
    SearchRecord(const MinimizationProblem &problem, int max_evaluations, double feasibility_tolerance);

    /// Computes the point, unless it was the last one. Numbers that are not finite are a failure.
    const SearchPoint &evaluate(const Eigen::VectorXd &x, bool derivatives);
    /// The point with derivatives, by differences if the problem's own are not to be used; fails as its evaluation
    /// says.
    SearchPoint differentiate(const SearchPoint &point, bool own_derivatives, const Eigen::VectorXd &variable_scales);

    /// Violations are measured in these from here on.
    void set_constraint_scales(const Eigen::VectorXd &scales);

    bool                              is_spent() const { return n_evaluations_ >= max_evaluations_; }
    const std::optional<SearchPoint> &best() const { return best_; }
    bool                              is_feasible() const { return best_ && best_->violation <= tolerance_; }

    int                            n_evaluations() const { return n_evaluations_; }
    int                            n_gradients() const { return n_gradients_; }
    const std::string             &first_failure() const { return first_failure_; }
    const std::vector<SearchStep> &trace() const { return trace_; }

  private:
    void   check(SearchPoint &point);
    void   remember(const SearchPoint &point);
    bool   is_better(const SearchPoint &point) const;
    double violation(const Eigen::VectorXd &constraints) const;

    const MinimizationProblem &problem_;
    int                        max_evaluations_;
    double                     tolerance_;

    Eigen::VectorXd            constraint_scales_;
    SearchPoint                last_;
    std::optional<SearchPoint> best_;
    int                        n_evaluations_ = 0, n_gradients_ = 0;
    std::string                first_failure_;
    std::vector<SearchStep>    trace_;
  };
} // namespace swimtwin
