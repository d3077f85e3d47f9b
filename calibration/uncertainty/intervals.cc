#include <calibration/uncertainty/intervals.h>

#include <datasets/system/parallel_for.h>
#include <rom/swimmer/dense_algebra.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/roots.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace swimtwin
{
  namespace
  {
    constexpr double farthest       = 5.5; // standard deviations to which a profile is followed
    constexpr int    n_curve_points = 25;

    const char *undecided_note = "the data do not see this parameter alone: it is part of a null direction";

    /// Independent standard normal numbers: a stream of its own for every seed and index.
    class NormalNumbers
    {
    public:
      NormalNumbers(const unsigned long seed, const std::size_t index)
      {
        std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(index), 0x5eedu};
        engine_.seed(sequence);
      }
      /// By inversion, so that every standard library gives the same.
      double operator()()
      {
        const double uniform = (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53;
        return boost::math::quantile(boost::math::normal(), uniform);
      }
      Eigen::VectorXd vector(const Eigen::Index n)
      {
        return Eigen::VectorXd::NullaryExpr(n, [this] { return (*this)(); });
      }

    private:
      std::mt19937_64 engine_;
    };

    /// Twice the least misfit with one parameter held, over the minimum.
    class ProfiledMisfit
    {
    public:
      ProfiledMisfit(const FitInput &input, const Estimate &estimate, const int parameter)
          : refit_(input, estimate), parameter_(parameter), estimate_(estimate.x()[parameter])
      {
        least_     = refit_.with_held(parameter, estimate_, false).half_square;
        deviation_ = std::sqrt(estimate.information.covariance(parameter, parameter));
        lower_     = input.map.lower()[parameter];
        upper_     = input.map.upper()[parameter];
      }

      double increase(const double x)
      {
        const LeastSquaresSolution solution = refit_.with_held(parameter_, x, true);
        least_                              = std::min(least_, solution.half_square);
        return 2. * (solution.half_square - least_);
      }

      /// Where the increase reaches a threshold on one side (-1 or 1); nothing if it does not within bounds and reach.
      std::optional<double> crossing(const int side, const double threshold)
      {
        const double end = side < 0 ? std::max(lower_, estimate_ - farthest * deviation_)
                                    : std::min(upper_, estimate_ + farthest * deviation_);
        refit_.with_held(parameter_, estimate_, false); // start the others from the estimate
        double inside = estimate_, outside = estimate_;
        for (int step = 1; outside != end; ++step)
        {
          outside = estimate_ + side * step * deviation_;
          if ((end - outside) * side <= 0.)
            outside = end;
          if (increase(outside) >= threshold)
            return root(inside, outside, threshold);
          inside = outside;
        }
        return std::nullopt;
      }

      double deviation() const { return deviation_; }
      bool   reaches_bound(const int side) const
      {
        return side < 0 ? estimate_ - farthest * deviation_ <= lower_ : estimate_ + farthest * deviation_ >= upper_;
      }

    private:
      double root(const double inside, const double outside, const double threshold)
      {
        std::uintmax_t n_steps = 40;
        const auto     beyond  = [&](const double x) { return increase(x) - threshold; };
        const auto     close = [this](const double a, const double b) { return std::abs(a - b) <= 1e-4 * deviation_; };
        const auto [a, b]    = boost::math::tools::toms748_solve(beyond, std::min(inside, outside),
                                                                 std::max(inside, outside), close, n_steps);
        return 0.5 * (a + b);
      }

      Refit  refit_;
      int    parameter_;
      double estimate_, least_ = 0., deviation_ = 0., lower_ = 0., upper_ = 0.;
    };

    std::string open_note(const ProfiledMisfit &profile, const int side)
    {
      return profile.reaches_bound(side)
                 ? fmt::format("the data allow every {} value up to the bound", side < 0 ? "lower" : "higher")
                 : fmt::format("the misfit does not rise enough within {} standard deviations", farthest);
    }

    ParameterProfile curve_of(const FitInput &input, const Estimate &estimate, const int j, const double factor,
                              ProfiledMisfit &profile)
    {
      ParameterProfile curve;
      curve.name         = input.map.names()[static_cast<std::size_t>(j)];
      curve.threshold    = factor * factor;
      const double reach = 1.4 * factor * profile.deviation();
      for (int i = 0; i < n_curve_points; ++i)
      {
        const double x = estimate.x()[j] + reach * (2. * i / (n_curve_points - 1.) - 1.);
        if (x < input.map.lower()[j] || x > input.map.upper()[j])
          continue;
        curve.value.push_back(input.map.value(j, x));
        curve.misfit_increase.push_back(profile.increase(x));
      }
      return curve;
    }

    double quantile(std::vector<double> values, const double share)
    {
      std::sort(values.begin(), values.end());
      const double place = share * static_cast<double>(values.size() - 1);
      const auto   below = static_cast<std::size_t>(place);
      const auto   above = std::min(below + 1, values.size() - 1);
      return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
    }
  } // namespace

  double coverage_factor(const double level, const bool noise_is_free, const int n_degrees_of_freedom)
  {
    const double share = 0.5 * (1. + level);
    return noise_is_free ? boost::math::quantile(boost::math::students_t(n_degrees_of_freedom), share)
                         : boost::math::quantile(boost::math::normal(), share);
  }

  ClaimedInterval curvature_interval(const FitInput &input, const Estimate &estimate, const int j, const double factor)
  {
    ClaimedInterval interval;
    interval.method = "curvature";
    if (estimate.information.touches_undecided(j))
    {
      interval.note = undecided_note;
      return interval;
    }
    const double half = factor * std::sqrt(estimate.information.covariance(j, j));
    interval.low      = input.map.value(j, estimate.x()[j] - half);
    interval.high     = input.map.value(j, estimate.x()[j] + half);
    return interval;
  }

  Profile profile_of(const FitInput &input, const Estimate &estimate, const int j, const double factor)
  {
    Profile result;
    result.interval.method = "profile";
    if (estimate.information.touches_undecided(j))
    {
      result.interval.note = undecided_note;
      return result;
    }
    ProfiledMisfit profile(input, estimate, j);
    const auto     low = profile.crossing(-1, factor * factor), high = profile.crossing(1, factor * factor);
    if (low)
      result.interval.low = input.map.value(j, *low);
    if (high)
      result.interval.high = input.map.value(j, *high);
    if (!low || !high)
      result.interval.note = open_note(profile, low ? 1 : -1);
    result.curve = curve_of(input, estimate, j, factor, profile);
    return result;
  }

  Bootstrap bootstrap(const FitInput &input, const Estimate &estimate, const int n_samples, const unsigned long seed)
  {
    const int         p = input.map.size(), k = estimate.error.n_components();
    Eigen::MatrixXd   x(n_samples, p);
    std::vector<char> converged(static_cast<std::size_t>(n_samples));
    parallel_for(static_cast<std::size_t>(n_samples), input.n_threads, [&] {
      return [&, refit = std::make_shared<Refit>(input, estimate)](const std::size_t i) {
        NormalNumbers   normal(seed, i);
        Eigen::VectorXd truth       = estimate.unknowns;
        truth.tail(k)               = normal.vector(k);
        const Eigen::VectorXd noise = normal.vector(input.data.n()).cwiseProduct(input.data.sigma_m);
        Eigen::VectorXd       means = estimate.x();
        for (int j = 0; j < p; ++j)
          if (input.map.has_prior(j))
            means[j] += input.map.prior_standard_deviation(j) * normal();
        const LeastSquaresSolution solution =
            refit->with_data(refit->predictions(truth) + estimate.noise_scale * noise, means);
        x.row(static_cast<Eigen::Index>(i)) = solution.unknowns.head(p);
        converged[i]                        = solution.converged;
      };
    });
    Bootstrap        result;
    std::vector<int> kept;
    for (int i = 0; i < n_samples; ++i)
      if (converged[static_cast<std::size_t>(i)])
        kept.push_back(i);
    result.x          = x(kept, Eigen::all);
    result.n_failures = n_samples - static_cast<int>(kept.size());
    return result;
  }

  ClaimedInterval bootstrap_interval(const FitInput &input, const Estimate &estimate, const Bootstrap &samples,
                                     const int j, const double level)
  {
    ClaimedInterval interval;
    interval.method = "bootstrap";
    if (estimate.information.touches_undecided(j))
      interval.note = undecided_note;
    else if (samples.x.rows() < 20)
      interval.note = "too few repetitions to tell";
    else
    {
      const std::vector<double> values(samples.x.col(j).begin(), samples.x.col(j).end());
      interval.low  = input.map.value(j, quantile(values, 0.5 * (1. - level)));
      interval.high = input.map.value(j, quantile(values, 0.5 * (1. + level)));
    }
    return interval;
  }

  Eigen::MatrixXd draws_from_curvature(const Estimate &estimate, const int n, const unsigned long seed)
  {
    const SymmetricEigen  eigen = symmetric_eigen(estimate.information.covariance);
    const Eigen::MatrixXd root  = eigen.vectors * eigen.values.cwiseMax(0.).cwiseSqrt().asDiagonal();
    Eigen::MatrixXd       draws(n, root.rows());
    for (int i = 0; i < n; ++i)
      draws.row(i) = estimate.x() + root * NormalNumbers(seed, static_cast<std::size_t>(i)).vector(root.cols());
    return draws;
  }
} // namespace swimtwin
