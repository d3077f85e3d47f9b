#include <rom/training/sample_table.h>

#include <rom/swimmer/dense_algebra.h>
#include <rom/training/factor_entries.h>
#include <rom/training/monomial_features.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace swimtwin
{
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
  } // namespace

  std::vector<FittedTogether> fitted_together(const Eigen::MatrixXi &exponents, const SampleTable &table)
  {
    if (table.has_mirror)
      return {{of_parity(exponents, 0), entries_of_parity(table.n, 0)},
              {of_parity(exponents, 1), entries_of_parity(table.n, 1)}};
    return {{counted(exponents.rows()), counted(table.entries.cols())}};
  }

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
    FitQuality          quality{0., 0., static_cast<int>(exponents.rows())};
    std::vector<double> errors, weights;
    for (const auto &[kept, held] : five_folds(table.z.rows()))
    {
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
} // namespace swimtwin
