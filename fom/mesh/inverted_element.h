// Meshes with an element that is inside out are refused where they are made.
#pragma once

#include <datasets/system/error.h>
#include <fom/geometry/simplex_mesh.h>

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
} // namespace swimtwin
