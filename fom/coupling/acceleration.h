// Accelerations of a fixed-point iteration x = S(x).
#pragma once

#include <datasets/scene/scene.h>

#include <Eigen/Dense>

#include <memory>
#include <vector>

namespace swimtwin
{
  class Acceleration
  {
  public:
    virtual ~Acceleration() = default;

    /// A new problem begins, like the last one: what was learnt of S is kept as far as the method can use it.
    virtual void start() = 0;
    /// From an iterate x and its image S(x), the next iterate.
    virtual Eigen::VectorXd next(const Eigen::VectorXd &x, const Eigen::VectorXd &image) = 0;
    /// S has changed altogether: start from nothing, with a relaxation factor.
    virtual void forget(double first_factor) = 0;
  };

  /// Relaxation x + a (S(x) - x) with Aitken's factor: a secant through the last two residuals along their difference.
  /// A problem's first factor is the last one of the problem before. Between a tenth of the very first factor and 1:
  /// for a stiffness against a drag all good factors are positive, and what lies outside is round-off. Kuettler and
  /// Wall, Comput. Mech. 43 (2008).
  class AitkenRelaxation : public Acceleration
  {
  public:
    void            start() override;
    Eigen::VectorXd next(const Eigen::VectorXd &x, const Eigen::VectorXd &image) override;
    void            forget(double first_factor) override;
    double          factor() const { return factor_; }

  private:
    double          factor_ = 1., smallest_factor_ = 0.;
    Eigen::VectorXd residual_before_;
  };

  /// Interface quasi-Newton by least squares: S's inverse Jacobian is taken from differences of residuals and images,
  /// those of the last `reused_problems` problems included; differences that are almost combinations of newer ones are
  /// left out. Degroote, Bathe, Vierendeels, Comput. Struct. 87 (2009); filter: Haelterman et al., Comput. Struct. 171
  /// (2016).
  class QuasiNewtonLeastSquares : public Acceleration
  {
  public:
    explicit QuasiNewtonLeastSquares(int reused_problems) : reused_problems_(reused_problems) {}
    void            start() override;
    Eigen::VectorXd next(const Eigen::VectorXd &x, const Eigen::VectorXd &image) override;
    void            forget(double first_factor) override;

  private:
    struct Difference
    {
      Eigen::VectorXd residual, image;
    };
    double                               first_factor_ = 1.;
    int                                  reused_problems_;
    std::vector<std::vector<Difference>> problems_; ///< oldest first; the present one last
    Eigen::VectorXd                      residual_before_, image_before_;
  };

  std::unique_ptr<Acceleration> make_acceleration(const Numerics &numerics);
} // namespace swimtwin
