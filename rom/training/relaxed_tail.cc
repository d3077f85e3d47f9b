#include <rom/training/relaxed_tail.h>

#include <fom/elastic/nodal_vector.h>
#include <fom/geometry/reflection.h>
#include <rom/swimmer/dense_algebra.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    constexpr std::ptrdiff_t nowhere = -1;
  }

  template <int dim>
  RelaxedTail<dim>::RelaxedTail(const Swimmer<dim> &swimmer, const BendingCoordinates &coordinates)
      : swimmer_(swimmer), coordinates_(coordinates)
  {
    const auto &mesh = swimmer.tail().mesh;
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      for (int i = 0; i < dim; ++i)
        is_fixed_.push_back(swimmer.is_clamped(a));
    cells_.resize(mesh.n_cells());
    std::iota(cells_.begin(), cells_.end(), 0);
    if constexpr (dim == 3)
      choose_half();
    lay_out();
    solver_.analyzePattern(tangent_);
  }

  template <int dim>
  void RelaxedTail<dim>::choose_half()
  {
    constexpr int z      = dim - 1;
    const auto   &mesh   = swimmer_.tail().mesh;
    const auto    images = images_of_nodes(mesh);
    if (!images)
      return; // it is solved whole
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      if (mesh.nodes[a][z] > 0.)
        images_.push_back({a, (*images)[a]});
    weight_ = 2.;
    std::erase_if(cells_, [&](const unsigned int c) {
      return std::any_of(mesh.cells[c].begin(), mesh.cells[c].end(),
                         [&](const auto a) { return mesh.nodes[a][z] < 0.; });
    });
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      for (int i = 0; i < dim; ++i)
        if (mesh.nodes[a][z] < 0. || (i == z && mesh.nodes[a][z] == 0.))
          is_fixed_[dim * a + i] = true;
  }

  template <int dim>
  void RelaxedTail<dim>::reflect(Eigen::VectorXd &displacement) const
  {
    for (const auto &[node, image] : images_)
      for (int i = 0; i < dim; ++i)
        displacement[dim * image + i] = (i == dim - 1 ? -1. : 1.) * displacement[dim * node + i];
  }

  template <int dim>
  void RelaxedTail<dim>::lay_out()
  {
    const auto &mesh = swimmer_.tail().mesh;
    const auto  n    = static_cast<Eigen::Index>(is_fixed_.size());
    const auto  row  = [](const CellNodes<dim> &cell, const int i) {
      return static_cast<Eigen::Index>(dim * cell[i / dim] + i % dim);
    };
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index i = 0; i < n; ++i)
      entries.emplace_back(i, i, 0.);
    for (const auto c : cells_)
      for (int i = 0; i < n_cell_rows; ++i)
        for (int j = 0; j < n_cell_rows; ++j)
          if (const auto a = row(mesh.cells[c], i), b = row(mesh.cells[c], j); !is_fixed_[a] && !is_fixed_[b])
            entries.emplace_back(a, b, 0.);
    tangent_.resize(n, n);
    tangent_.setFromTriplets(entries.begin(), entries.end());

    const auto *inner = tangent_.innerIndexPtr(), *outer = tangent_.outerIndexPtr();
    for (const auto c : cells_)
      for (int j = 0; j < n_cell_rows; ++j)
        for (int i = 0; i < n_cell_rows; ++i)
        {
          const auto a = row(mesh.cells[c], i), b = row(mesh.cells[c], j);
          place_.push_back(is_fixed_[a] || is_fixed_[b]
                               ? nowhere
                               : std::lower_bound(inner + outer[b], inner + outer[b + 1], a) - inner);
        }
  }

  template <int dim>
  void RelaxedTail<dim>::add_to_tangent(const std::size_t k, const CellMatrix &matrix)
  {
    const std::ptrdiff_t *place = place_.data() + k * n_cell_rows * n_cell_rows;
    for (int entry = 0; entry < n_cell_rows * n_cell_rows; ++entry)
      if (place[entry] != nowhere)
        tangent_.valuePtr()[place[entry]] += weight_ * matrix.data()[entry];
  }

  template <int dim>
  typename RelaxedTail<dim>::Assembly RelaxedTail<dim>::assemble(const Eigen::VectorXd &displacement,
                                                                 const Eigen::VectorXd &multipliers)
  {
    const auto           &mesh  = swimmer_.tail().mesh;
    const double          E     = swimmer_.scene().tail->young_modulus_Pa;
    const NodalField<dim> field = nodal_field<dim>(displacement);
    const Eigen::Index    n = displacement.size(), r = coordinates_.n_coordinates();
    Assembly              result{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, r), Eigen::VectorXd::Zero(r)};
    const Eigen::VectorXd angles = coordinates_.rotations(displacement);
    tangent_.coeffs()            = 0.;
    for (Eigen::Index i = 0; i < n; ++i)
      if (is_fixed_[i])
        tangent_.coeffRef(i, i) = 1.;

    typename ElasticTail<dim>::CellForce   force;
    typename ElasticTail<dim>::CellTangent tangent;
    CellMatrix                             matrix;
    for (std::size_t place = 0; place < cells_.size(); ++place)
    {
      const auto  c       = cells_[place];
      const auto &nodes   = mesh.cells[c];
      const auto  in_cell = [](const int i) { return dim * (i / 2) + i % 2; }; // of what lies in the plane
      swimmer_.elasticity().cell_force_and_tangent(c, field, force, tangent);
      for (int i = 0; i < n_cell_rows; ++i)
      {
        if (!is_fixed(nodes[i / dim], i % dim))
          result.force[dim * nodes[i / dim] + i % dim] += weight_ * force[i] / E;
        for (int j = 0; j < n_cell_rows; ++j)
          matrix(i, j) = tangent[i][j] / E;
      }
      const auto d = coordinates_.in_plane(c, displacement);
      for (std::size_t k = 0; k < coordinates_.n_points_of_cell(); ++k)
      {
        const auto &[u, v, axial_m, mean] = coordinates_.points_of(c)[k];
        // phi = Im log(s + i t): its derivatives are those of an analytic function.
        const double          s = 2. + u.dot(d), t = v.dot(d), size = s * s + t * t;
        const double          re = (s * s - t * t) / (size * size), im = 2. * s * t / (size * size);
        const auto            slope = ((s * v - t * u) / size).eval();
        const Eigen::VectorXd share = coordinates_.share(c, k);
        const double          by_re = multipliers.dot(share) * re, by_im = multipliers.dot(share) * im;
        result.q += weight_ * angles[static_cast<Eigen::Index>(c * coordinates_.n_points_of_cell() + k)] * share;
        for (int i = 0; i < u.size(); ++i)
        {
          if (!is_fixed(nodes[i / 2], i % 2))
            result.constraints.row(dim * nodes[i / 2] + i % 2) += weight_ * slope[i] * share.transpose();
          for (int j = 0; j < u.size(); ++j)
            matrix(in_cell(i), in_cell(j)) += by_re * (u[i] * v[j] + v[i] * u[j]) - by_im * (u[i] * u[j] - v[i] * v[j]);
        }
      }
      add_to_tangent(place, matrix);
    }
    return result;
  }

  template <int dim>
  bool RelaxedTail<dim>::relax(const Eigen::VectorXd &q, RelaxedShape &shape)
  {
    constexpr int    n_iterations = 25;
    constexpr double tolerance    = 1e-9;
    const double     length       = coordinates_.length_m();
    for (int k = 0; k < n_iterations; ++k)
    {
      const Assembly at = assemble(shape.displacement, shape.slope_m);
      solver_.factorize(tangent_);
      if (solver_.info() != Eigen::Success)
        return false;
      const Eigen::VectorXd residual = at.force - at.constraints * shape.slope_m;
      const Eigen::VectorXd free     = solver_.solve(residual);
      const Eigen::MatrixXd held     = solver_.solve(at.constraints);
      const Eigen::MatrixXd S        = at.constraints.transpose() * held;
      const Eigen::VectorXd change   = solve_by_lu<Eigen::VectorXd>(S, q - at.q + at.constraints.transpose() * free);
      const Eigen::VectorXd step     = held * change - free;
      if (!step.allFinite())
        return false;
      shape.displacement += step;
      reflect(shape.displacement);
      shape.slope_m += change;
      if (step.cwiseAbs().maxCoeff() < tolerance * length)
        return !swimmer_.elasticity().is_inverted(nodal_field<dim>(shape.displacement));
    }
    return false;
  }

  template <int dim>
  std::vector<RelaxedShape> RelaxedTail<dim>::on_the_way_to(const Eigen::VectorXd &q, const int n)
  {
    const double              E = swimmer_.scene().tail->young_modulus_Pa;
    std::vector<RelaxedShape> shapes;
    RelaxedShape shape{Eigen::VectorXd::Zero(q.size()), Eigen::VectorXd::Zero(dim * swimmer_.tail().mesh.n_nodes()), 0.,
                       Eigen::VectorXd::Zero(q.size())};
    RelaxedShape before = shape;
    for (int k = 1; k <= n; ++k)
    {
      RelaxedShape next = shape;
      next.q            = q * k / n;
      if (k > 1)
      {
        next.displacement += shape.displacement - before.displacement;
        next.slope_m += shape.slope_m - before.slope_m;
      }
      if (!relax(next.q, next))
        break;
      next.energy_m2 = swimmer_.elasticity().energy(nodal_field<dim>(next.displacement)) / E;
      before         = shape;
      shape          = next;
      shapes.push_back(next);
    }
    return shapes;
  }

  template class RelaxedTail<2>;
  template class RelaxedTail<3>;
} // namespace swimtwin
