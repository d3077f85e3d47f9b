// Monomials of several coordinates, evaluated by recursion: each is another one times a coordinate.
#pragma once

#include <Eigen/Dense>

#include <vector>

namespace swimtwin
{
  /// d monomial / d coordinate = power * lower, by places in the table.
  struct MonomialDerivative
  {
    int monomial = 0, coordinate = 0, power = 0, lower = 0;
  };

  class MonomialTable
  {
  public:
    /// One monomial per row of `exponents` (n x n_coordinates); those that occur in their derivatives are added.
    /// Monomials with `parity` -1, the product of the coordinates' parities (1 or -1) to their powers, come after all
    /// others; within a parity lower degrees come first.
    MonomialTable(const Eigen::MatrixXi &exponents, const Eigen::VectorXi &parity);

    using Coordinates = Eigen::Ref<const Eigen::VectorXd>;

    int size() const { return static_cast<int>(order_.size()) + 1; }
    int n_even() const { return n_even_; }
    int n_coordinates() const { return n_coordinates_; }
    /// Rows as the monomials stand in the table (size() of them), from one row per row of `exponents`.
    Eigen::MatrixXd in_order(const Eigen::MatrixXd &coefficients) const;
    int             place_of_one() const { return constant_place_; }
    /// All that are not zero.
    const std::vector<MonomialDerivative> &derivatives() const { return derivatives_; }

    /// Column 0 of `values` (size() rows) becomes the monomials at z.
    void evaluate(const Coordinates &z, Eigen::Ref<Eigen::MatrixXd> values) const;
    /// Column 0 as above; column 1 becomes their rates where z changes at z_rate.
    void evaluate_with_rate(const Coordinates &z, const Coordinates &z_rate, Eigen::Ref<Eigen::MatrixXd> values) const;
    /// Column 0 as above; column 1 + k becomes their derivatives by z_k.
    void evaluate_with_gradient(const Coordinates &z, Eigen::Ref<Eigen::MatrixXd> values) const;

  private:
    struct Step
    {
      int position = 0, parent = 0, coordinate = 0;
    };

    std::vector<Step>               order_; ///< of all but the constant, parents first
    std::vector<MonomialDerivative> derivatives_;
    std::vector<int>                position_of_row_;
    int                             n_even_ = 0, n_coordinates_ = 0, constant_place_ = 0;
  };
} // namespace swimtwin
