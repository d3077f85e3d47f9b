#include <fom/elastic/hyperelasticity.h>

#include <cmath>
#include <limits>

namespace swimtwin
{
  using namespace dealii;

  LameConstants lame_constants(const double young_modulus_Pa, const double poisson_ratio)
  {
    return {young_modulus_Pa * poisson_ratio / ((1. + poisson_ratio) * (1. - 2. * poisson_ratio)),
            young_modulus_Pa / (2. * (1. + poisson_ratio))};
  }

  namespace
  {
    template <int dim>
    Tensor<2, dim> green_lagrange_strain(const Tensor<2, dim> &F)
    {
      Tensor<2, dim> strain = transpose(F) * F;
      for (int i = 0; i < dim; ++i)
        strain[i][i] -= 1.;
      return 0.5 * strain;
    }

    /// S = lambda tr(E) 1 + 2 mu E.
    template <int dim>
    Tensor<2, dim> second_piola_stress(const Tensor<2, dim> &F, const LameConstants &lame)
    {
      const Tensor<2, dim> strain = green_lagrange_strain(F);
      Tensor<2, dim>       S      = 2. * lame.mu_Pa * strain;
      for (int i = 0; i < dim; ++i)
        S[i][i] += lame.lambda_Pa * trace(strain);
      return S;
    }
  } // namespace

  template <int dim>
  double StVenantKirchhoff<dim>::energy(const Tensor<2, dim> &F) const
  {
    const Tensor<2, dim> strain = green_lagrange_strain(F);
    const double         tr     = trace(strain);
    return 0.5 * lame_.lambda_Pa * tr * tr + lame_.mu_Pa * scalar_product(strain, strain);
  }

  template <int dim>
  Tensor<2, dim> StVenantKirchhoff<dim>::stress(const Tensor<2, dim> &F) const
  {
    return F * second_piola_stress(F, lame_);
  }

  template <int dim>
  typename HyperelasticLaw<dim>::Response StVenantKirchhoff<dim>::respond(const Tensor<2, dim> &F) const
  {
    // dP = dF S + F (lambda tr(dE) 1 + 2 mu dE) with dE = sym(F^T dF), so that with dF = e_k (x) e_l:
    const Tensor<2, dim> S   = second_piola_stress(F, lame_);
    const Tensor<2, dim> FFt = F * transpose(F);
    Tensor<4, dim>       A;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        for (int k = 0; k < dim; ++k)
          for (int l = 0; l < dim; ++l)
            A[i][j][k][l] = (i == k ? S[l][j] : 0.) + lame_.lambda_Pa * F[i][j] * F[k][l] +
                            lame_.mu_Pa * (F[i][l] * F[k][j] + (j == l ? FFt[i][k] : 0.));
    return {F * S, A};
  }

  template <int dim>
  double NeoHookean<dim>::energy(const Tensor<2, dim> &F) const
  {
    const double J = determinant(F);
    if (J <= 0.)
      return std::numeric_limits<double>::infinity();
    const double log_J = std::log(J);
    return 0.5 * lame_.mu_Pa * (scalar_product(F, F) - dim - 2. * log_J) + 0.5 * lame_.lambda_Pa * log_J * log_J;
  }

  template <int dim>
  Tensor<2, dim> NeoHookean<dim>::stress(const Tensor<2, dim> &F) const
  {
    const Tensor<2, dim> F_inverse_transpose = transpose(invert(F));
    return lame_.mu_Pa * F + (lame_.lambda_Pa * std::log(determinant(F)) - lame_.mu_Pa) * F_inverse_transpose;
  }

  template <int dim>
  typename HyperelasticLaw<dim>::Response NeoHookean<dim>::respond(const Tensor<2, dim> &F) const
  {
    const Tensor<2, dim> G           = invert(F); // d(F^-T)_ij / dF_kl = -G_jk G_li
    const double         coefficient = lame_.lambda_Pa * std::log(determinant(F)) - lame_.mu_Pa;
    Tensor<4, dim>       A;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        for (int k = 0; k < dim; ++k)
          for (int l = 0; l < dim; ++l)
            A[i][j][k][l] = (i == k && j == l ? lame_.mu_Pa : 0.) + lame_.lambda_Pa * G[j][i] * G[l][k] -
                            coefficient * G[j][k] * G[l][i];
    return {lame_.mu_Pa * F + coefficient * transpose(G), A};
  }

  template <int dim>
  std::unique_ptr<HyperelasticLaw<dim>> make_law(const MaterialModel model, const LameConstants &lame)
  {
    if (model == MaterialModel::neo_hookean)
      return std::make_unique<NeoHookean<dim>>(lame);
    return std::make_unique<StVenantKirchhoff<dim>>(lame);
  }

  template class StVenantKirchhoff<2>;
  template class StVenantKirchhoff<3>;
  template class NeoHookean<2>;
  template class NeoHookean<3>;
  template std::unique_ptr<HyperelasticLaw<2>> make_law<2>(MaterialModel, const LameConstants &);
  template std::unique_ptr<HyperelasticLaw<3>> make_law<3>(MaterialModel, const LameConstants &);
} // namespace swimtwin
