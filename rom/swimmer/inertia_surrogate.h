// The inertia of the swimmer against its shape, and its derivatives (docs/equations.md, section 14).
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/monomial_table.h>
#include <rom/swimmer/state_vectors.h>
#include <rom/swimmer/swimmer_parameters.h>

#include <array>
#include <vector>

namespace swimtwin
{
  /// Inertia at one shape and pose, and what evaluating it needs. Make it with InertiaSurrogate::make; it belongs to
  /// one thread. Units as in ReducedInertia, times the density.
  struct InertiaValues
  {
    VelocityMatrix              mass;              ///< M
    VelocityVector              force;             ///< 1/2 dM/dt xi + (xi . N_i xi)_i
    std::vector<VelocityMatrix> mass_slopes;       ///< dM/dz_c
    VelocityMatrix              force_by_velocity; ///< with what the velocity changes in dz/dt left out
    Eigen::MatrixXd             force_by_variable; ///< by z at given dz/dt
    Eigen::MatrixXd             force_by_rate;     ///< by dz/dt: 1/2 dM/dz_c xi

    Eigen::MatrixXd monomials;         ///< values, then derivatives by z, as columns
    Eigen::MatrixXd rates;             ///< their values and their rates
    Eigen::MatrixXd quadratic_entries; ///< in columns like the monomials
    /// Of fluid and tail.
    struct Material
    {
      Eigen::MatrixXd entries;                 ///< of C: values, derivatives by z, rates; log on the diagonal
      VelocityMatrix  relative, relative_rate; ///< C and dC/dt
      VelocityMatrix  factor;                  ///< L_0 C
      VelocityMatrix  factor_rate;             ///< L_0 dC/dt; of `differentiate` alone
    };
    std::array<Material, 2> materials;
  };

  class InertiaSurrogate
  {
  public:
    InertiaSurrogate() = default;
    /// `parity` of the variables z and of the velocities. Where the coefficients keep them, only half of them are ever
    /// touched.
    InertiaSurrogate(const ReducedInertia &inertia, const InertialDensities &densities, const Eigen::VectorXi &parity,
                     const Eigen::VectorXi &velocity_parity);

    InertiaValues make() const;
    /// mass and force, for velocities xi that change z at the rate dz/dt.
    void evaluate(const Eigen::VectorXd &z, const Eigen::VectorXd &z_rate, const VelocityVector &velocity,
                  InertiaValues &result) const;
    /// Derivatives too.
    void differentiate(const Eigen::VectorXd &z, const Eigen::VectorXd &z_rate, const VelocityVector &velocity,
                       InertiaValues &result) const;

    /// M alone.
    VelocityMatrix mass(const Eigen::VectorXd &z) const;

  private:
    InertiaSurrogate(const ReducedInertia &inertia, const InertialDensities &densities, const Eigen::VectorXi &parity,
                     const Eigen::VectorXi &of_velocity, bool has_mirror);

    /// xi_j xi_k in force i, or entry (i, j) of M.
    struct Term
    {
      int i, j, k;
    };
    /// Polynomials of some terms, even ones first: each of them has monomials of its own parity alone. Without a mirror
    /// all count as even.
    struct Polynomials
    {
      std::vector<Term> terms;
      Eigen::MatrixXd   even, odd; ///< terms x monomials

      /// One column per column of the monomials, which are even ones first, too.
      void evaluate(const Eigen::Ref<const Eigen::MatrixXd> &monomials, Eigen::Ref<Eigen::MatrixXd> values) const;
    };

    /// M of one material: density L_0 C C^T L_0^T.
    struct Mass
    {
      double                       density = 0.;
      VelocityMatrix               factor_at_rest;
      Polynomials                  entries;
      std::vector<Eigen::MatrixXd> gradient; ///< of d(entries)/dz_d: terms x monomials
    };

    /// `coefficients`: a row per monomial as the table has them, a column per term.
    Polynomials order(const Eigen::MatrixXd &coefficients, const std::vector<Term> &terms) const;
    Mass        mass_of(const InertiaPolynomials &material, double density, const std::vector<Term> &pairs) const;
    void        set_head(const ReducedInertia &inertia, double density, Eigen::MatrixXd &quadratic);
    void        set_masses(InertiaValues &result) const;
    void        set_force(const VelocityVector &velocity, InertiaValues &result) const;
    void        differentiate_mass(const Mass &mass, const Eigen::VectorXd &z_rate, const VelocityVector &velocity,
                                   InertiaValues::Material &at, InertiaValues &result) const;
    void        differentiate_quadratic(const VelocityVector &velocity, InertiaValues &result) const;

    int                              n_ = 0;
    Eigen::VectorXi                  velocity_parity_;
    std::array<std::vector<Term>, 2> pairs_; ///< xi_i xi_j: even ones, odd ones
    MonomialTable                    monomials_{Eigen::MatrixXi::Zero(1, 1), Eigen::VectorXi::Ones(1)};
    std::array<Mass, 2>              masses_;    ///< of fluid and tail
    VelocityMatrix                   head_;      ///< its M
    Polynomials                      quadratic_; ///< by parity, then by force, then as `pairs_`
  };
} // namespace swimtwin
