// Meshes with an element that is inside out are refused where they are made.
#pragma once

#include <datasets/system/error.h>
#include <fom/geometry/simplex_mesh.h>

#include <array>
#include <string>

namespace swimtwin
{
  /// what() says where and why, without a remedy.
  class InvertedElement : public ComputationError
  {
  public:
    using ComputationError::ComputationError;
  };

  /// Throws InvertedElement unless the Jacobian determinant of every element is positive everywhere in it, which its
  /// Bernstein coefficients prove (element_quality). A refused element may be right by a hair. `name`: which mesh.
  template <int dim>
  void refuse_inverted_elements(const SimplexMesh<dim> &mesh, const std::string &name);

  /// The mesh that `make` makes with its argument times the wanted sizes: 1, or a little less where an
  /// element is inside out, since beside a curved surface that is a matter of where the mesher happens to put its
  /// nodes. Throws the first InvertedElement if none is right.
  template <typename Make>
  auto first_not_inverted(const Make &make) -> decltype(make(1.))
  {
    constexpr std::array smaller{0.95, 0.9, 0.8};
    try
    {
      return make(1.);
    }
    catch (const InvertedElement &)
    {
      for (const double factor : smaller)
        try
        {
          return make(factor);
        }
        catch (const ComputationError &)
        {
        }
      throw;
    }
  }
} // namespace swimtwin
