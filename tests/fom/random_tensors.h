// Random inputs for laws, the same at every run.
#pragma once

#include <deal.II/base/tensor.h>

#include <random>

namespace swimtwin
{
  class RandomNumbers
  {
  public:
    /// Uniform in [-1, 1].
    double operator()() { return distribution_(generator_); }

    template <int dim>
    dealii::Tensor<1, dim> vector()
    {
      dealii::Tensor<1, dim> v;
      for (int i = 0; i < dim; ++i)
        v[i] = (*this)();
      return v;
    }
    template <int dim>
    dealii::Tensor<2, dim> matrix()
    {
      dealii::Tensor<2, dim> m;
      for (int i = 0; i < dim; ++i)
        m[i] = vector<dim>();
      return m;
    }
    /// 1 plus something of size 0.3, with a determinant above 0.4.
    template <int dim>
    dealii::Tensor<2, dim> deformation_gradient()
    {
      dealii::Tensor<2, dim> F;
      do
      {
        F = 0.3 * matrix<dim>();
        for (int i = 0; i < dim; ++i)
          F[i][i] += 1.;
      } while (determinant(F) < 0.4);
      return F;
    }
    /// By the Cayley transform of a skew matrix.
    template <int dim>
    dealii::Tensor<2, dim> rotation()
    {
      const dealii::Tensor<2, dim> m = matrix<dim>(), skew = m - transpose(m);
      dealii::Tensor<2, dim>       one;
      for (int i = 0; i < dim; ++i)
        one[i][i] = 1.;
      return invert(one - skew) * (one + skew);
    }

  private:
    std::mt19937                           generator_{20240501};
    std::uniform_real_distribution<double> distribution_{-1., 1.};
  };
} // namespace swimtwin
