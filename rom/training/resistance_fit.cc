#include <rom/training/resistance_fit.h>

#include <rom/swimmer/dense_algebra.h>
#include <rom/training/monomial_features.h>
#include <rom/training/sampled_shapes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace swimtwin
{
  namespace
  {
    /// Variables, one row each, as far as the resistance is evaluated where motions lead beyond what was sampled:
    /// shapes at the utmost, poses up to there.
    Eigen::MatrixXd variables_beyond(const SampledRegion &region, const int n_points)
    {
      constexpr double   beyond = 1.5;
      const double       utmost = saturated(beyond);
      const Eigen::Index r      = region.coordinate_scale_m.size();
      const auto         points = filling_points(region, {Eigen::VectorXd::Zero(r), 0., 0., 0.}, n_points);
      Eigen::MatrixXd    z(n_points, region.n_variables());
      for (int k = 0; k < n_points; ++k)
      {
        z.row(k) = utmost * region.variables(points[static_cast<std::size_t>(k)]).transpose();
        z.row(k).head(r) *= utmost / z.row(k).head(r).norm();
      }
      return z;
    }

    Eigen::MatrixXd inverse_factor(const Eigen::MatrixXd &A)
    {
      const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
      const Eigen::MatrixXd                       R = qr.matrixQR().topRows(A.cols());
      return R.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(A.cols(), A.cols()));
    }
  } // namespace

  ResistanceFit::ResistanceFit(const std::vector<ResistanceSample> &samples, const SampledRegion &region,
                               const Eigen::VectorXd &effects, const UsualPlace &usual, const FitEconomy &economy)
      : region_(region)
  {
    resistance_.factor_at_rest     = factor_at_rest(samples.front().resistance, region.has_mirror);
    resistance_.coordinate_scale_m = region.coordinate_scale_m;
    resistance_.depends_on_angle   = region.depends_on_angle;
    resistance_.angle_scale_rad    = region.angle_scale_rad;
    resistance_.depends_on_height  = region.depends_on_height;
    resistance_.height_scale_m     = region.height_scale_m;
    if (region.depends_on_height)
    {
      resistance_.usual_by_sine_m     = usual.by_sine_m;
      resistance_.usual_by_coordinate = usual.by_coordinate;
    }
    table_ = table_of(samples);
    fit_chosen_features(feature_sets(effects, table_.z.rows(), region.has_mirror), economy);
    fit_halves();
    find_covariance();
  }

  SampleTable ResistanceFit::table_of(const std::vector<ResistanceSample> &samples) const
  {
    const Eigen::Index n = samples.front().resistance.rows();
    SampleTable        table{Eigen::MatrixXd(samples.size(), region_.n_variables()),
                      Eigen::MatrixXd(samples.size(), n * (n + 1) / 2), Eigen::VectorXd(samples.size()), n,
                      region_.has_mirror};
    // Where the resistance is far from that at rest no polynomial follows it; fitted all the same, such corners would
    // spoil the shapes that swimmers go through.
    constexpr double far = 0.5; // in entries of C
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
      table.z.row(k)       = region_.variables(samples[k].point).transpose();
      table.entries.row(k) = factor_entries(resistance_.factor_at_rest, samples[k].resistance).transpose();
      table.weight(k)      = samples[k].point.weight / (1. + table.entries.row(k).squaredNorm() / (far * far));
    }
    return table;
  }

  void ResistanceFit::favour(const std::vector<ResistanceSample> &used)
  {
    const SampleTable before = table_, more = table_of(used);
    const auto        below = [](const auto &upper, const auto &lower) {
      Eigen::MatrixXd both(upper.rows() + lower.rows(), upper.cols());
      both << upper, lower;
      return both;
    };
    table_.z       = below(before.z, more.z);
    table_.entries = below(before.entries, more.entries);
    for (const double times : {10., 3., 1.})
    {
      table_.weight                      = below(before.weight, Eigen::VectorXd(times * more.weight));
      const Eigen::MatrixXd coefficients = fit_restrained(resistance_.exponents, table_, guide_, restraint_);
      if (times > 1. && !(condition_beyond(coefficients) <= bound_))
        continue;
      resistance_.coefficients = coefficients;
      break;
    }
    resistance_.half_fits.clear();
    fit_halves();
    find_covariance();
  }

  /// The largest.
  double ResistanceFit::condition_beyond(const Eigen::MatrixXd &coefficients) const
  {
    return largest_condition(design(resistance_.exponents, beyond_) * coefficients, table_.n);
  }

  void ResistanceFit::find_covariance()
  {
    const SampleTable     rows = guided(table_, guide_, restraint_);
    const Eigen::MatrixXd A    = rows.weight.asDiagonal() * design(resistance_.exponents, rows.z);
    parts_                     = fitted_together(resistance_.exponents, table_);
    covariance_.clear();
    for (const auto &[features, entries] : parts_)
    {
      const Eigen::MatrixXd inverse =
          inverse_factor(with_ridge(A(Eigen::all, features), rows.weight, restraint_.ridge));
      covariance_.push_back(inverse * inverse.transpose());
    }
  }

  void ResistanceFit::fit_halves()
  {
    for (const int half : {0, 1})
    {
      std::vector<int> rows{0}; // rest is in both
      for (int k = 1; k < table_.z.rows(); ++k)
        if (k % 2 == half)
          rows.push_back(k);
      resistance_.half_fits.push_back(fit_restrained(resistance_.exponents, table_.rows(rows), guide_, restraint_));
    }
  }

  /// Coarse fits first; the best of those that are sound by a margin guides finer ones, which are on their own if there
  /// is none. Of all that are sound the smallest that is nearly as good as the best, or moves the swimmer like it.
  void ResistanceFit::fit_chosen_features(const std::vector<Eigen::MatrixXi> &sets, const FitEconomy &economy)
  {
    struct Candidate
    {
      std::size_t  set;
      FitRestraint restraint;
      FitQuality   quality;
    };
    constexpr int    n_judged = 1000, n_guiding = 500, most_of_coarse = 150;
    constexpr double times = 4., share_of_guide = .5;
    // Sound: nowhere beyond the samples is the condition more than some times that of the worst of them.
    bound_                       = times * largest_condition(table_.entries, table_.n);
    const Eigen::MatrixXd beyond = variables_beyond(region_, n_judged + n_guiding);
    beyond_                      = beyond.topRows(n_judged);
    guide_.z                     = beyond.bottomRows(n_guiding);

    std::vector<Candidate> candidates;
    const auto             add = [&](const std::size_t set, const FitRestraint &restraint) {
      FitQuality quality = cross_validate(sets[set], table_, guide_, restraint);
      if (!std::isfinite(quality.rms))
        quality.rms = std::numeric_limits<double>::max();
      candidates.push_back({set, restraint, quality});
    };
    const auto is_within = [&](const Candidate &candidate, const double condition) {
      quality_                 = candidate.quality;
      restraint_               = candidate.restraint;
      resistance_.exponents    = sets[candidate.set];
      resistance_.coefficients = fit_restrained(resistance_.exponents, table_, guide_, restraint_);
      return condition_beyond(resistance_.coefficients) <= condition;
    };
    const auto fit_best_within = [&](const double condition) {
      std::sort(candidates.begin(), candidates.end(),
                [](const auto &a, const auto &b) { return a.quality.rms < b.quality.rms; });
      return std::find_if(candidates.begin(), candidates.end(),
                          [&](const Candidate &candidate) { return is_within(candidate, condition); });
    };
    const auto add_with_ridges = [&](const std::size_t set) {
      for (const double ridge : {smallest_ridge, 1e-3, 3e-3, 1e-2})
        add(set, {ridge, 0.});
    };
    std::size_t n_coarse = 0;
    for (; n_coarse < sets.size() && (n_coarse == 0 || sets[n_coarse].rows() <= most_of_coarse); ++n_coarse)
      add_with_ridges(n_coarse);
    if (const auto guiding = fit_best_within(share_of_guide * bound_); guiding != candidates.end())
    {
      guide_.entries = design(resistance_.exponents, guide_.z) * resistance_.coefficients;
      for (std::size_t i = guiding->set; i < sets.size(); ++i) // read once: `add` moves the candidates
        for (const double guidance : {1e-3, 1e-2, 1e-1})
          add(i, {smallest_ridge, guidance});
    }
    else
      for (std::size_t i = n_coarse; i < sets.size(); ++i)
        add_with_ridges(i);
    const auto best = fit_best_within(bound_);
    if (best == candidates.end())
    {
      is_within(*std::min_element(candidates.begin(), candidates.end(),
                                  [](const auto &a, const auto &b) { return a.set < b.set; }),
                bound_); // the fewest monomials
      return;
    }
    const Candidate        finest = *best; // the order changes
    const Eigen::Matrix2Xd ways   = economy.ways ? economy.ways(resistance_) : Eigen::Matrix2Xd();
    const double           worst  = economy.ways ? std::max(no_rival, economy.nearly) : economy.nearly;
    std::stable_sort(candidates.begin(), candidates.end(), [](const auto &a, const auto &b) { return a.set < b.set; });
    std::optional<std::size_t> refused; // a set of which the best sound candidate will not do
    for (const Candidate &candidate : candidates)
    {
      const double worse = candidate.quality.rms / finest.quality.rms;
      if (!(worse <= worst) || candidate.set == refused || !is_within(candidate, bound_))
        continue;
      if (worse <= economy.nearly || are_alike(economy.ways(resistance_), ways, economy.target))
        return;
      refused = candidate.set;
    }
    is_within(finest, bound_);
  }

  double ResistanceFit::leverage(const ShapePoint &point) const
  {
    const Eigen::VectorXd a       = monomials(resistance_.exponents, region_.variables(point));
    double                largest = 0.;
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      const Eigen::VectorXd part = a(parts_[p].features);
      largest                    = std::max(largest, part.dot(covariance_[p] * part));
    }
    return largest;
  }

  std::vector<ShapePoint> ResistanceFit::worst_supported(const std::vector<ShapePoint> &candidates, const int n) const
  {
    const auto                   m          = static_cast<Eigen::Index>(candidates.size());
    auto                         covariance = covariance_;
    std::vector<Eigen::MatrixXd> rows;
    Eigen::MatrixXd              leverages(m, static_cast<Eigen::Index>(parts_.size())); // a column for each part
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      rows.emplace_back(m, static_cast<Eigen::Index>(parts_[p].features.size()));
      for (Eigen::Index k = 0; k < m; ++k)
        rows[p].row(k) = monomials(resistance_.exponents, region_.variables(candidates[k]))(parts_[p].features);
      leverages.col(p) = (rows[p] * covariance[p]).cwiseProduct(rows[p]).rowwise().sum();
    }
    std::vector<ShapePoint> chosen;
    while (static_cast<int>(chosen.size()) < std::min<Eigen::Index>(n, m))
    {
      Eigen::Index worst;
      leverages.rowwise().maxCoeff().maxCoeff(&worst);
      chosen.push_back(candidates[worst]);
      for (std::size_t p = 0; p < parts_.size(); ++p)
      {
        // One more row in the design matrix: Sherman and Morrison's formula.
        const Eigen::VectorXd a     = rows[p].row(worst).transpose();
        const Eigen::VectorXd Ma    = covariance[p] * a;
        const double          scale = 1. + a.dot(Ma);
        covariance[p] -= Ma * Ma.transpose() / scale;
        leverages.col(p) -= (rows[p] * Ma).cwiseAbs2() / scale;
      }
    }
    return chosen;
  }

  double ResistanceFit::velocity_error_at(const ResistanceSample &sample, const Eigen::VectorXd &velocity) const
  {
    const Eigen::Index    n = sample.resistance.rows();
    const Eigen::VectorXd fitted =
        resistance_.coefficients.transpose() * monomials(resistance_.exponents, region_.variables(sample.point));
    const Eigen::MatrixXd L = resistance_.factor_at_rest * factor_of(fitted, n);
    const Eigen::VectorXd truth =
        sample.resistance.llt().solve(L * (L.transpose() * velocity)); // under the same forces
    const Eigen::VectorXd off = truth - velocity;
    return std::sqrt(off.dot(sample.resistance * off) / truth.dot(sample.resistance * truth));
  }
} // namespace swimtwin
