// Hyperelastic laws: energy density, first Piola-Kirchhoff stress and its derivative, as functions of F.
#pragma once

#include <datasets/scene/scene.h>

#include <deal.II/base/tensor.h>

#include <memory>

namespace swimtwin
{
  struct LameConstants
  {
    double lambda_Pa, mu_Pa;
  };

  /// lambda = E nu / ((1 + nu)(1 - 2 nu)), mu = E / (2 (1 + nu)); the same in 3D and in plane strain.
  LameConstants lame_constants(double young_modulus_Pa, double poisson_ratio);

  /// A material without memory. In 2D: plane strain.
  template <int dim>
  class HyperelasticLaw
  {
  public:
    struct Response
    {
      dealii::Tensor<2, dim> stress;  ///< P = dW/dF (Pa)
      dealii::Tensor<4, dim> tangent; ///< dP/dF (Pa)
    };

    virtual ~HyperelasticLaw() = default;
    /// W(F) in J/m^3; infinite where the law is not defined (neo-Hookean at det F <= 0).
    virtual double                 energy(const dealii::Tensor<2, dim> &F) const  = 0;
    virtual dealii::Tensor<2, dim> stress(const dealii::Tensor<2, dim> &F) const  = 0;
    virtual Response               respond(const dealii::Tensor<2, dim> &F) const = 0;
  };

  /// W = lambda/2 tr(E)^2 + mu E:E, E = (F^T F - 1)/2. The reference study's law.
  template <int dim>
  class StVenantKirchhoff : public HyperelasticLaw<dim>
  {
  public:
    explicit StVenantKirchhoff(const LameConstants &lame) : lame_(lame) {}
    double                                  energy(const dealii::Tensor<2, dim> &F) const override;
    dealii::Tensor<2, dim>                  stress(const dealii::Tensor<2, dim> &F) const override;
    typename HyperelasticLaw<dim>::Response respond(const dealii::Tensor<2, dim> &F) const override;

  private:
    LameConstants lame_;
  };

  /// W = mu/2 (F:F - dim - 2 ln J) + lambda/2 (ln J)^2, compressible neo-Hookean.
  template <int dim>
  class NeoHookean : public HyperelasticLaw<dim>
  {
  public:
    explicit NeoHookean(const LameConstants &lame) : lame_(lame) {}
    double                                  energy(const dealii::Tensor<2, dim> &F) const override;
    dealii::Tensor<2, dim>                  stress(const dealii::Tensor<2, dim> &F) const override;
    typename HyperelasticLaw<dim>::Response respond(const dealii::Tensor<2, dim> &F) const override;

  private:
    LameConstants lame_;
  };

  /// The law that a scene's tail asks for.
  template <int dim>
  std::unique_ptr<HyperelasticLaw<dim>> make_law(MaterialModel model, const LameConstants &lame);
} // namespace swimtwin
