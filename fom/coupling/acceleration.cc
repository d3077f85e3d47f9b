#include <fom/coupling/acceleration.h>

#include <algorithm>

namespace swimtwin
{
  using Eigen::VectorXd;

  VectorXd AitkenRelaxation::next(const VectorXd &x, const VectorXd &image)
  {
    const VectorXd residual = image - x;
    if (residual_before_.size() > 0)
    {
      const VectorXd change = residual - residual_before_;
      if (const double square = change.squaredNorm(); square > 0.)
        factor_ = std::clamp(-factor_ * residual_before_.dot(change) / square, smallest_factor_, 1.);
    }
    residual_before_ = residual;
    return x + factor_ * residual;
  }

  void AitkenRelaxation::start()
  {
    residual_before_.resize(0);
  }

  void AitkenRelaxation::forget(const double first_factor)
  {
    factor_          = first_factor;
    smallest_factor_ = 0.1 * first_factor;
    residual_before_.resize(0);
  }

  void QuasiNewtonLeastSquares::start()
  {
    if (problems_.empty() || !problems_.back().empty())
      problems_.emplace_back();
    while (int(problems_.size()) > reused_problems_ + 1)
      problems_.erase(problems_.begin());
    residual_before_.resize(0);
  }

  void QuasiNewtonLeastSquares::forget(const double first_factor)
  {
    first_factor_ = first_factor;
    problems_.clear();
    start();
  }

  VectorXd QuasiNewtonLeastSquares::next(const VectorXd &x, const VectorXd &image)
  {
    const VectorXd residual = image - x;
    if (residual_before_.size() > 0)
      problems_.back().push_back({residual - residual_before_, image - image_before_});
    residual_before_ = residual;
    image_before_    = image;

    // Newest difference first: orthogonalise, leave out what is almost a combination of newer ones, and minimise
    // |residual + sum_k c_k (difference of residuals)_k|.
    constexpr double                 least_new_part = 1e-2;
    std::vector<VectorXd>            q;
    std::vector<std::vector<double>> r; ///< columns
    std::vector<const VectorXd *>    images;
    for (auto problem = problems_.rbegin(); problem != problems_.rend(); ++problem)
      for (auto difference = problem->rbegin(); difference != problem->rend(); ++difference)
      {
        VectorXd            v = difference->residual;
        std::vector<double> column;
        for (const auto &direction : q)
        {
          column.push_back(direction.dot(v));
          v -= column.back() * direction;
        }
        const double norm = v.norm();
        if (!(norm > least_new_part * difference->residual.norm()))
          continue;
        column.push_back(norm);
        q.push_back(v / norm);
        r.push_back(std::move(column));
        images.push_back(&difference->image);
      }
    if (q.empty())
      return x + first_factor_ * residual;

    VectorXd next = image;
    VectorXd c(q.size());
    for (int k = int(q.size()) - 1; k >= 0; --k)
    {
      c[k] = -q[k].dot(residual);
      for (unsigned int j = k + 1; j < q.size(); ++j)
        c[k] -= r[j][k] * c[j];
      c[k] /= r[k][k];
      next += c[k] * *images[k];
    }
    return next;
  }

  std::unique_ptr<Acceleration> make_acceleration(const Numerics &numerics)
  {
    if (numerics.acceleration == AccelerationMethod::iqn_ils)
      return std::make_unique<QuasiNewtonLeastSquares>(numerics.iqn_reused_steps);
    return std::make_unique<AitkenRelaxation>();
  }
} // namespace swimtwin
