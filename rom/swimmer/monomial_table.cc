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

    Exponents parent_of(Exponents exponents)
    {
      --exponents[static_cast<std::size_t>(last_coordinate(exponents))];
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
    for (Eigen::Index row = 0; row < exponents.rows(); ++row)
      for (Exponents e = row_of(exponents, row); positions.emplace(e, -1).second && last_coordinate(e) >= 0;)
        e = parent_of(e);

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
      if (const int k = last_coordinate(e); k < 0)
        constant_place_ = at;
      else
        order_.push_back({at, positions.at(parent_of(e)), k});
    for (Eigen::Index row = 0; row < exponents.rows(); ++row)
      position_of_row_.push_back(positions.at(row_of(exponents, row)));
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
    const double *const value = values.data();
    for (int l = 0; l < n_coordinates_; ++l)
    {
      double *const slope    = values.col(1 + l).data();
      slope[constant_place_] = 0.;
      for (const auto &[at, parent, k] : order_)
        slope[at] = slope[parent] * z[k] + (k == l ? value[parent] : 0.);
    }
  }
} // namespace swimtwin
