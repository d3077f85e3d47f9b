// Nodal fields as vectors, components together, and back.
#pragma once

#include <fom/elastic/elastic_tail.h>

#include <Eigen/Dense>

namespace swimtwin
{
  template <int dim>
  Eigen::VectorXd vector_of(const NodalField<dim> &field)
  {
    Eigen::VectorXd values(field.size() * dim);
    for (unsigned int a = 0; a < field.size(); ++a)
      for (int c = 0; c < dim; ++c)
        values[a * dim + c] = field[a][c];
    return values;
  }

  template <int dim>
  NodalField<dim> nodal_field(const Eigen::VectorXd &values)
  {
    NodalField<dim> field(values.size() / dim);
    for (unsigned int a = 0; a < field.size(); ++a)
      for (int c = 0; c < dim; ++c)
        field[a][c] = values[a * dim + c];
    return field;
  }
} // namespace swimtwin
