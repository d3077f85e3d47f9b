#include <rom/swimmer/monomial_table.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    using Exponents = std::vector<int>;

    /// Last coordinate that occurs; -1 for the constant.
    int last_coordinate(const Exponents &exponents)
    {
      for (int k = static_cast<int>(exponents.size()) - 1; k >= 0; --k)
        if (exponents[static_cast<std::size_t>(k)] > 0)
          return k;
      return -1;
    }

    Exponents lower_by(Exponents exponents, const int coordinate)
    {
      --exponents[static_cast<std::size_t>(coordinate)];
      return exponents;
    }

    Exponents row_of(const Eigen::MatrixXi &matrix, const Eigen::Index row)
    {
      Exponents exponents;
      for (Eigen::Index k = 0; k < matrix.cols(); ++k)
        exponents.push_back(matrix(row, k));
      return exponents;
    }

    bool is_even(const Exponents &exponents, const Eigen::VectorXi &parity)
    {
      int odd_powers = 0;
      for (std::size_t k = 0; k < exponents.size(); ++k)
        odd_powers += parity[static_cast<Eigen::Index>(k)] < 0 ? exponents[k] : 0;
      return odd_powers % 2 == 0;
    }

    /// By degree, so that parents come first.
    bool precedes(const Exponents &a, const Exponents &b)
    {
      const int degree_a = std::accumulate(a.begin(), a.end(), 0), degree_b = std::accumulate(b.begin(), b.end(), 0);
      return degree_a != degree_b ? degree_a < degree_b : a > b;
    }
  } // namespace

  MonomialTable::MonomialTable(const Eigen::MatrixXi &exponents, const Eigen::VectorXi &parity)
      : n_coordinates_(static_cast<int>(exponents.cols()))
  {
    std::map<Exponents, int, decltype(&precedes)> positions(&precedes);
    std::vector<Exponents>                        to_add;
    for (Eigen::Index row = 0; row < exponents.rows(); ++row)
      to_add.push_back(row_of(exponents, row));
    to_add.emplace_back(exponents.cols(), 0);
    while (!to_add.empty())
    {
      const Exponents e = std::move(to_add.back());
      to_add.pop_back();
      if (positions.emplace(e, -1).second)
        for (int k = 0; k < n_coordinates_; ++k)
          if (e[static_cast<std::size_t>(k)] > 0)
            to_add.push_back(lower_by(e, k));
    }

    int position = 0;
    for (const bool even : {true, false})
    {
      for (auto &[e, at] : positions)
        if (is_even(e, parity) == even)
          at = position++;
      if (even)
        n_even_ = position;
    }
    for (const auto &[e, at] : positions)
    {
      if (const int k = last_coordinate(e); k < 0)
        constant_place_ = at;
      else
        order_.push_back({at, positions.at(lower_by(e, k)), k});
      for (int k = 0; k < n_coordinates_; ++k)
        if (const int power = e[static_cast<std::size_t>(k)]; power > 0)
          derivatives_.push_back({at, k, power, positions.at(lower_by(e, k))});
    }
    for (Eigen::Index row = 0; row < exponents.rows(); ++row)
      position_of_row_.push_back(positions.at(row_of(exponents, row)));
  }

  Eigen::MatrixXd MonomialTable::in_order(const Eigen::MatrixXd &coefficients) const
  {
    Eigen::MatrixXd ordered = Eigen::MatrixXd::Zero(size(), coefficients.cols());
    for (Eigen::Index row = 0; row < coefficients.rows(); ++row)
      ordered.row(position_of_row_[static_cast<std::size_t>(row)]) += coefficients.row(row);
    return ordered;
  }

  void MonomialTable::evaluate(const Coordinates &z, Eigen::Ref<Eigen::MatrixXd> values) const
  {
    double *const value    = values.data();
    value[constant_place_] = 1.;
    for (const auto &[at, parent, k] : order_)
      value[at] = value[parent] * z[k];
  }

  void MonomialTable::evaluate_with_rate(const Coordinates &z, const Coordinates &z_rate,
                                         Eigen::Ref<Eigen::MatrixXd> values) const
  {
    double *const value = values.data(), *const rate = values.col(1).data();
    value[constant_place_] = 1.;
    rate[constant_place_]  = 0.;
    for (const auto &[at, parent, k] : order_)
    {
      value[at] = value[parent] * z[k];
      rate[at]  = rate[parent] * z[k] + value[parent] * z_rate[k];
    }
  }

  void MonomialTable::evaluate_with_gradient(const Coordinates &z, Eigen::Ref<Eigen::MatrixXd> values) const
  {
    evaluate(z, values);
    auto slopes = values.middleCols(1, n_coordinates_);
    slopes.setZero();
    for (const auto &[monomial, coordinate, power, lower] : derivatives_)
      slopes(monomial, coordinate) = power * values(lower, 0);
  }
} // namespace swimtwin
