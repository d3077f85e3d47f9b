#include <fom/fluid/fluid_blocks.h>

namespace swimtwin
{
  template <int dim>
  std::vector<UnknownKind> own_kinds(const FluidDomain<dim> &fluid, const MotionMap<dim> &map)
  {
    std::vector<UnknownKind> kinds(map.n_unknowns(), UnknownKind::body);
    const auto               mark = [&](const unsigned int row, const UnknownKind kind) {
      if (map.end(row) - map.begin(row) == 1 && map.begin(row)->unknown < map.first_head_unknown())
        kinds[map.begin(row)->unknown] = kind;
    };
    for (unsigned int i = 0; i < fluid.mesh().n_nodes(); ++i)
      for (int c = 0; c < dim; ++c)
        mark(fluid.numbering().vector_index(i, c), static_cast<UnknownKind>(c));
    for (unsigned int c = 0; c < fluid.mesh().n_cells(); ++c)
      for (int v = 0; v <= dim; ++v)
        mark(fluid.numbering().pressure_index(fluid.mesh().cells[c][v]), UnknownKind::pressure);
    for (unsigned int row = fluid.n_rows(); row < map.n_rows(); ++row)
      mark(row, UnknownKind::body); // surface nodes that move like a tail's
    return {kinds.begin() + map.first_owned(), kinds.begin() + map.last_owned()};
  }

  template <int dim>
  std::vector<double> pressure_masses(const FluidDomain<dim> &fluid, const MotionMap<dim> &map)
  {
    std::vector<double>       masses(map.n_unknowns(), 0.);
    const std::vector<double> of_rows = fluid.pressure_masses();
    for (unsigned int row = 0; row < of_rows.size(); ++row)
      if (of_rows[row] != 0.)
        map.add_load(row, of_rows[row], masses);
    return masses;
  }

  template std::vector<UnknownKind> own_kinds<2>(const FluidDomain<2> &, const MotionMap<2> &);
  template std::vector<UnknownKind> own_kinds<3>(const FluidDomain<3> &, const MotionMap<3> &);
  template std::vector<double>      pressure_masses<2>(const FluidDomain<2> &, const MotionMap<2> &);
  template std::vector<double>      pressure_masses<3>(const FluidDomain<3> &, const MotionMap<3> &);
} // namespace swimtwin
