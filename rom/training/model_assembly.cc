#include <rom/training/model_assembly.h>

#include <rom/training/bent_tail.h>
#include <rom/training/strain_grams.h>

namespace swimtwin
{
  namespace
  {
    template <int dim>
    ReducedTail assemble_tail(const Swimmer<dim> &swimmer, const SnapshotSet &set, const TailBasis &basis)
    {
      ReducedTail tail;
      tail.nodes_m         = set.tail_nodes_m;
      tail.cells           = set.tail_cells;
      tail.before_tip_node = static_cast<int>(swimmer.tail().axis_at_tip[1]);
      tail.tip_node        = static_cast<int>(swimmer.tail().axis_at_tip[2]);
      if (basis.bent)
      {
        tail.modes      = basis.bent->modes;
        tail.parity     = basis.bent->parity;
        tail.amplitudes = basis.bent->amplitudes;
        return tail;
      }
      tail.modes.resize(basis.coordinates.rows(), basis.n_coordinates() + basis.n_followers());
      tail.modes << basis.coordinates, basis.followers;
      tail.followers = basis.quadratic;
      tail.parity.resize(tail.modes.cols());
      tail.parity << Eigen::VectorXi::Constant(basis.n_coordinates(), -1),
          Eigen::VectorXi::Constant(basis.n_followers(), 1);
      return tail;
    }

    /// Integral of the modes' gradients along the axis: what a tail magnetised along it gains by them.
    template <int dim>
    ReducedMagnet assemble_magnet(const Swimmer<dim> &swimmer, const Eigen::MatrixXd &modes)
    {
      const auto   &axial = swimmer.elasticity().axial_gradient_of_node();
      ReducedMagnet magnet;
      magnet.head_area_m2        = swimmer.scene().head.volume(dim);
      magnet.tail_area_m2        = {swimmer.elasticity().volume(), 0.};
      magnet.tail_area_of_mode_m = Eigen::MatrixXd::Zero(2, modes.cols());
      for (std::size_t a = 0; a < axial.size(); ++a)
        magnet.tail_area_of_mode_m += axial[a] * modes.middleRows(dim * a, 2);
      return magnet;
    }
  } // namespace

  template <int dim>
  ReducedModel assemble_body(const Swimmer<dim> &swimmer, const SnapshotSet &set, const TailBasis &basis)
  {
    ReducedModel model;
    model.tail = assemble_tail(swimmer, set, basis);
    if (basis.bent)
      model.elasticity = {{}, {}, swimmer.scene().tail->poisson_ratio, basis.bent->energy};
    else if constexpr (dim == 2)
      model.elasticity = compute_strain_grams(swimmer, model.tail.modes);
    model.magnet = assemble_magnet(swimmer, model.tail.modes);
    // Coordinates only bend and followers follow: what is left of a change of area is not theirs to refuse.
    const Eigen::Index n = model.tail.modes.cols();
    model.area.is_kept   = false;
    model.area.linear_m  = Eigen::VectorXd::Zero(n);
    model.area.quadratic = Eigen::MatrixXd::Zero(n, n);
    model.scene_name     = swimmer.scene().name;
    model.scene_text     = swimmer.scene().text;
    return model;
  }

  template ReducedModel assemble_body<2>(const Swimmer<2> &, const SnapshotSet &, const TailBasis &);
  template ReducedModel assemble_body<3>(const Swimmer<3> &, const SnapshotSet &, const TailBasis &);
} // namespace swimtwin
