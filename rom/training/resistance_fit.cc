#include <rom/training/resistance_fit.h>

#include <datasets/system/error.h>
#include <rom/swimmer/dense_algebra.h>
#include <rom/training/explored_shapes.h>
#include <rom/training/monomial_features.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace swimtwin
{
  Eigen::VectorXd SampledRegion::variables(const ShapePoint &point) const
  {
    Eigen::VectorXd z(n_variables());
    z.head(point.q.size()) = point.q.cwiseQuotient(coordinate_scale_m);
    if (depends_on_angle)
      z(point.q.size()) = point.angle_rad / angle_scale_rad;
    if (depends_on_height)
      z(z.size() - 1) = point.drift_y_m / height_scale_m;
    return z;
  }

  Eigen::MatrixXd factor_at_rest(const Eigen::MatrixXd &rest, const bool has_mirror)
  {
    Eigen::MatrixXd symmetric = rest;
    for (Eigen::Index i = 0; i < rest.rows(); ++i)
      for (Eigen::Index j = 0; j < rest.cols(); ++j)
        if (has_mirror && velocity_parity(i) * velocity_parity(j) < 0)
          symmetric(i, j) = 0.;
    return cholesky_factor(symmetric);
  }

  Eigen::MatrixXd seen_from(const Eigen::MatrixXd &L, const Eigen::MatrixXd &A)
  {
    const Eigen::MatrixXd half = solve_lower(L, A);
    return solve_lower<Eigen::MatrixXd>(L, half.transpose()).transpose();
  }

  Eigen::VectorXd factor_entries(const Eigen::MatrixXd &L0, const Eigen::MatrixXd &resistance)
  {
    const Eigen::MatrixXd scaled = seen_from(L0, resistance);
    const Eigen::MatrixXd C      = cholesky_factor((scaled + scaled.transpose()) / 2.);
    const Eigen::Index    n      = C.rows();
    Eigen::VectorXd       entries(n * (n + 1) / 2);
    for (Eigen::Index i = 0, k = 0; i < n; ++i)
      for (Eigen::Index j = 0; j <= i; ++j, ++k)
        entries(k) = i == j ? std::log(C(i, i)) : C(i, j);
    return entries;
  }

  Eigen::VectorXd variable_effects(const Eigen::MatrixXd &rest, const std::vector<Eigen::MatrixXd> &axis,
                                   const bool has_mirror)
  {
    const Eigen::MatrixXd L0 = factor_at_rest(rest, has_mirror);
    Eigen::VectorXd       effects(axis.size());
    for (std::size_t i = 0; i < axis.size(); ++i)
      effects(i) = std::max(1e-4, factor_entries(L0, axis[i]).cwiseAbs().maxCoeff());
    return effects;
  }

  namespace
  {
    /// Columns of C's entries of one parity, in an n x n matrix.
    std::vector<int> entries_of_parity(const Eigen::Index n, const int odd)
    {
      std::vector<int> columns;
      for (int i = 0, k = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j, ++k)
          if ((velocity_parity(i) * velocity_parity(j) < 0) == (odd == 1))
            columns.push_back(k);
      return columns;
    }

    std::vector<FittedTogether> fitted_together(const Eigen::MatrixXi &exponents, const SampleTable &table)
    {
      if (table.has_mirror)
        return {{of_parity(exponents, 0), entries_of_parity(table.n, 0)},
                {of_parity(exponents, 1), entries_of_parity(table.n, 1)}};
      return {{counted(exponents.rows()), counted(table.entries.cols())}};
    }

    Eigen::MatrixXd fit_coefficients(const Eigen::MatrixXi &exponents, const SampleTable &table, const double ridge)
    {
      const Eigen::MatrixXd A = table.weight.asDiagonal() * design(exponents, table.z);
      Eigen::MatrixXd       c = Eigen::MatrixXd::Zero(exponents.rows(), table.entries.cols());
      for (const auto &[features, entries] : fitted_together(exponents, table))
      {
        Eigen::MatrixXd data   = Eigen::MatrixXd::Zero(A.rows() + static_cast<Eigen::Index>(features.size()),
                                                       static_cast<Eigen::Index>(entries.size()));
        data.topRows(A.rows()) = table.weight.asDiagonal() * table.entries(Eigen::all, entries);
        c(features, entries)   = solve_by_plain_qr(with_ridge(A(Eigen::all, features), table.weight, ridge), data);
      }
      return c;
    }

    Eigen::MatrixXd factor(const Eigen::VectorXd &entries, const Eigen::Index n)
    {
      Eigen::MatrixXd C = Eigen::MatrixXd::Zero(n, n);
      for (Eigen::Index i = 0, k = 0; i < n; ++i)
        for (Eigen::Index j = 0; j <= i; ++j, ++k)
          C(i, j) = i == j ? std::exp(entries(k)) : entries(k);
      return C;
    }

    /// Largest relative error of the resistance for any motion.
    double relative_error(const Eigen::VectorXd &fitted, const Eigen::VectorXd &truth, const Eigen::Index n)
    {
      const Eigen::MatrixXd D = solve_lower(factor(fitted, n), factor(truth, n));
      return (D * D.transpose() - Eigen::MatrixXd::Identity(n, n)).operatorNorm();
    }

    /// Weighted root mean square of the smallest errors that hold `share` of the squared weights.
    double trimmed_rms(const std::vector<double> &errors, const std::vector<double> &weights, const double share)
    {
      std::vector<std::size_t> order(errors.size());
      std::iota(order.begin(), order.end(), 0u);
      std::sort(order.begin(), order.end(), [&](const auto a, const auto b) { return errors[a] < errors[b]; });
      const double all = std::inner_product(weights.begin(), weights.end(), weights.begin(), 0.);
      double       sum = 0., taken = 0.;
      for (const std::size_t k : order)
      {
        const double square = weights[k] * weights[k];
        if (taken + square > share * all)
          break;
        sum += square * errors[k] * errors[k];
        taken += square;
      }
      return taken > 0. ? std::sqrt(sum / taken) : 0.;
    }

    /// The table with the guide's rows below it.
    SampleTable guided(SampleTable table, const SampleTable &guide, const FitRestraint &restraint)
    {
      if (restraint.guidance == 0.)
        return table;
      const Eigen::Index n = table.z.rows(), more = guide.z.rows();
      const double       weight = restraint.guidance * table.weight.norm() / std::sqrt(static_cast<double>(more));
      table.z.conservativeResize(n + more, Eigen::NoChange);
      table.entries.conservativeResize(n + more, Eigen::NoChange);
      table.weight.conservativeResize(n + more);
      table.z.bottomRows(more)       = guide.z;
      table.entries.bottomRows(more) = guide.entries;
      table.weight.tail(more).setConstant(weight);
      return table;
    }

    Eigen::MatrixXd fit_restrained(const Eigen::MatrixXi &exponents, const SampleTable &table, const SampleTable &guide,
                                   const FitRestraint &restraint)
    {
      return fit_coefficients(exponents, guided(table, guide, restraint), restraint.ridge);
    }

    FitQuality cross_validate(const Eigen::MatrixXi &exponents, const SampleTable &table, const SampleTable &guide,
                              const FitRestraint &restraint)
    {
      constexpr int       n_folds = 5;
      FitQuality          quality{0., 0., static_cast<int>(exponents.rows())};
      std::vector<double> errors, weights;
      for (int fold = 0; fold < n_folds; ++fold)
      {
        std::vector<int> kept, held;
        for (int k = 0; k < table.z.rows(); ++k)
          (k > 0 && k % n_folds == fold ? held : kept).push_back(k); // rest is always kept
        const SampleTable     test = table.rows(held);
        const Eigen::MatrixXd fitted =
            design(exponents, test.z) * fit_restrained(exponents, table.rows(kept), guide, restraint);
        for (Eigen::Index k = 0; k < fitted.rows(); ++k)
        {
          errors.push_back(relative_error(fitted.row(k).transpose(), test.entries.row(k).transpose(), table.n));
          weights.push_back(test.weight(k));
        }
      }
      // A few shapes that nearly touch themselves are twice as far off with any monomials, and would decide alone.
      constexpr double usual_share = 0.9;
      quality.rms                  = trimmed_rms(errors, weights, usual_share);
      quality.largest              = *std::max_element(errors.begin(), errors.end());
      return quality;
    }

    /// Largest condition of the resistances, seen from that at rest, that these entries of C stand for, one row each.
    double largest_condition(const Eigen::MatrixXd &entries, const Eigen::Index n)
    {
      double largest = 1.;
      for (Eigen::Index k = 0; k < entries.rows(); ++k)
      {
        const Eigen::VectorXd singular = factor(entries.row(k).transpose(), n).jacobiSvd().singularValues();
        largest                        = std::max(largest, std::pow(singular(0) / singular(n - 1), 2));
      }
      return std::isfinite(largest) ? largest : std::numeric_limits<double>::infinity();
    }

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
    const Eigen::Index n       = samples.front().resistance.rows();
    resistance_.factor_at_rest = factor_at_rest(samples.front().resistance, region.has_mirror);
    SampleTable table{Eigen::MatrixXd(samples.size(), region.n_variables()),
                      Eigen::MatrixXd(samples.size(), n * (n + 1) / 2), Eigen::VectorXd(samples.size()), n,
                      region.has_mirror};
    // Where the resistance is far from that at rest no polynomial follows it; fitted all the same, such corners would
    // spoil the shapes that swimmers go through.
    constexpr double far = 0.5; // in entries of C
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
      table.z.row(k)       = region.variables(samples[k].point).transpose();
      table.entries.row(k) = factor_entries(resistance_.factor_at_rest, samples[k].resistance).transpose();
      table.weight(k)      = samples[k].point.weight / (1. + table.entries.row(k).squaredNorm() / (far * far));
    }

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
    fit_chosen_features(feature_sets(effects, table.z.rows(), region.has_mirror), table, economy);
    fit_halves(table);

    const SampleTable     rows = guided(table, guide_, restraint_);
    const Eigen::MatrixXd A    = rows.weight.asDiagonal() * design(resistance_.exponents, rows.z);
    parts_                     = fitted_together(resistance_.exponents, table);
    for (const auto &[features, entries] : parts_)
    {
      const Eigen::MatrixXd inverse =
          inverse_factor(with_ridge(A(Eigen::all, features), rows.weight, restraint_.ridge));
      covariance_.push_back(inverse * inverse.transpose());
    }
  }

  void ResistanceFit::fit_halves(const SampleTable &table)
  {
    for (const int half : {0, 1})
    {
      std::vector<int> rows{0}; // rest is in both
      for (int k = 1; k < table.z.rows(); ++k)
        if (k % 2 == half)
          rows.push_back(k);
      resistance_.half_fits.push_back(fit_restrained(resistance_.exponents, table.rows(rows), guide_, restraint_));
    }
  }

  /// Coarse fits first; the best of those that are sound by a margin guides finer ones, which are on their own if there
  /// is none. Of all that are sound the smallest that is nearly as good as the best, or moves the swimmer like it.
  void ResistanceFit::fit_chosen_features(const std::vector<Eigen::MatrixXi> &sets, const SampleTable &table,
                                          const FitEconomy &economy)
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
    const double          bound  = times * largest_condition(table.entries, table.n);
    const Eigen::MatrixXd beyond = variables_beyond(region_, n_judged + n_guiding), judged = beyond.topRows(n_judged);
    guide_.z = beyond.bottomRows(n_guiding);

    std::vector<Candidate> candidates;
    const auto             add = [&](const std::size_t set, const FitRestraint &restraint) {
      FitQuality quality = cross_validate(sets[set], table, guide_, restraint);
      if (!std::isfinite(quality.rms))
        quality.rms = std::numeric_limits<double>::max();
      candidates.push_back({set, restraint, quality});
    };
    const auto is_within = [&](const Candidate &candidate, const double condition) {
      quality_                 = candidate.quality;
      restraint_               = candidate.restraint;
      resistance_.exponents    = sets[candidate.set];
      resistance_.coefficients = fit_restrained(resistance_.exponents, table, guide_, restraint_);
      return largest_condition(design(resistance_.exponents, judged) * resistance_.coefficients, table.n) <= condition;
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
    if (const auto guiding = fit_best_within(share_of_guide * bound); guiding != candidates.end())
    {
      guide_.entries = design(resistance_.exponents, guide_.z) * resistance_.coefficients;
      for (std::size_t i = guiding->set; i < sets.size(); ++i) // read once: `add` moves the candidates
        for (const double guidance : {1e-3, 1e-2, 1e-1})
          add(i, {smallest_ridge, guidance});
    }
    else
      for (std::size_t i = n_coarse; i < sets.size(); ++i)
        add_with_ridges(i);
    const auto best = fit_best_within(bound);
    if (best == candidates.end())
    {
      is_within(*std::min_element(candidates.begin(), candidates.end(),
                                  [](const auto &a, const auto &b) { return a.set < b.set; }),
                bound); // the fewest monomials
      return;
    }
    // The best of each set, by sets.
    constexpr double no_worse = 3.; // times; farther off, ways are alike by chance
    const double     rms      = best->quality.rms;
    const auto       ways     = economy.ways ? economy.ways(resistance_) : Eigen::Matrix2Xd();
    std::stable_sort(candidates.begin(), candidates.end(), [](const auto &a, const auto &b) { return a.set < b.set; });
    std::find_if(candidates.begin(), candidates.end(), [&](const Candidate &candidate) {
      return candidate.quality.rms <= (economy.ways ? std::max(no_worse, economy.nearly) : economy.nearly) * rms &&
             is_within(candidate, bound) &&
             (candidate.quality.rms <= economy.nearly * rms ||
              relative_difference(economy.ways(resistance_), ways) <= economy.apart);
    });
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
    const Eigen::MatrixXd L = resistance_.factor_at_rest * factor(fitted, n);
    const Eigen::VectorXd truth =
        sample.resistance.llt().solve(L * (L.transpose() * velocity)); // under the same forces
    const Eigen::VectorXd off = truth - velocity;
    return std::sqrt(off.dot(sample.resistance * off) / truth.dot(sample.resistance * truth));
  }
} // namespace swimtwin
