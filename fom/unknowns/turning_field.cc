#include <fom/unknowns/turning_field.h>

namespace swimtwin
{
  template <int dim>
  bool outruns_step(const TurningField<dim> &field, const MotionMap<dim> &map, LinearSystem &system)
  {
    // Along the axis about which the field turns the head, as far as it may.
    std::vector<std::pair<PetscInt, double>> load;
    double                                   torque_by_rate = 0.;
    for (unsigned int i = 0; i < map.n_head_unknowns(); ++i)
      if (const int k = map.head_component(i) - dim; k >= 0)
      {
        load.push_back({map.first_head_unknown() + i, field.axis[k]});
        for (int l = 0; l < n_rotations<dim>; ++l)
          if (map.head_unknown(dim + l))
            torque_by_rate += field.axis[k] * field.torque_by_rate[k][l] * field.axis[l];
      }
    if (!(torque_by_rate > 0.))
      return false;
    const double response = system.response_to_load(load); // 1 / (zeta - a), by the map's length
    return !(response > 0. && torque_by_rate / (map.length_scale() * map.length_scale()) * response <= 1.);
  }

  template bool outruns_step<2>(const TurningField<2> &, const MotionMap<2> &, LinearSystem &);
  template bool outruns_step<3>(const TurningField<3> &, const MotionMap<3> &, LinearSystem &);
} // namespace swimtwin
