#include <rom/training/posed_body.h>

namespace swimtwin
{
  namespace
  {
    template <int dim>
    std::array<double, 2> center_about_middle(const Scene &scene, const double angle_rad)
    {
      const Swimmer<dim> swimmer(scene, MPI_COMM_SELF);
      ShapePoint         turned;
      turned.angle_rad  = angle_rad;
      const auto center = posed(swimmer, turned, swimmer.configuration_at_rest().shape, {}).pose.center;
      return {center[0], center[1]};
    }
  } // namespace

  std::array<double, 2> turned_center_m(const Scene &scene, const double angle_rad)
  {
    if (scene.domain->moves_with_swimmer)
      return scene.head.center_m;
    return scene.dimension == 2 ? center_about_middle<2>(scene, angle_rad) : center_about_middle<3>(scene, angle_rad);
  }

  template <int dim>
  Configuration<dim> posed(const Swimmer<dim> &swimmer, const ShapePoint &point, NodalField<dim> shape,
                           const std::optional<double> height_m)
  {
    Configuration<dim> c      = swimmer.configuration_at_rest();
    const double       rest_m = c.pose.center[1];
    auto               middle = c.pose.to_laboratory(swimmer.arm_to_middle(c.shape));
    middle[0] += point.drift_x_m;
    c.pose.set_attitude(Attitude<dim>::about_z(point.angle_rad));
    c.shape       = std::move(shape);
    c.pose.center = middle - c.pose.rotation() * swimmer.arm_to_middle(c.shape);
    if (height_m)
      c.pose.center[1] = rest_m + *height_m;
    return c;
  }

  template Configuration<2> posed<2>(const Swimmer<2> &, const ShapePoint &, NodalField<2>, std::optional<double>);
  template Configuration<3> posed<3>(const Swimmer<3> &, const ShapePoint &, NodalField<3>, std::optional<double>);
} // namespace swimtwin
