#include <rom/training/tail_basis.h>

#include <datasets/system/error.h>
#include <rom/training/bent_tail.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace swimtwin
{
  Eigen::VectorXd products(const Eigen::VectorXd &q)
  {
    Eigen::VectorXd p(q.size() * (q.size() + 1) / 2);
    for (Eigen::Index i = 0, k = 0; i < q.size(); ++i)
      for (Eigen::Index j = 0; j <= i; ++j, ++k)
        p(k) = q(i) * q(j);
    return p;
  }

  Eigen::MatrixXd products_derivative(const Eigen::VectorXd &q)
  {
    Eigen::MatrixXd d = Eigen::MatrixXd::Zero(q.size() * (q.size() + 1) / 2, q.size());
    for (Eigen::Index i = 0, k = 0; i < q.size(); ++i)
      for (Eigen::Index j = 0; j <= i; ++j, ++k)
      {
        d(k, i) += q(j);
        d(k, j) += q(i);
      }
    return d;
  }

  Eigen::VectorXd TailBasis::follower_amplitudes(const Eigen::VectorXd &q) const
  {
    return quadratic * products(q);
  }

  int TailBasis::n_coordinates() const
  {
    return bent ? bent->coordinates.n_coordinates() : static_cast<int>(coordinates.cols());
  }

  Eigen::MatrixXd TailBasis::coordinates_of(const TailSpace &space, const Eigen::MatrixXd &displacements) const
  {
    return bent ? bent->coordinates.of(displacements) : space.amplitudes(coordinates, displacements);
  }

  Eigen::VectorXd TailBasis::displacement(const Eigen::VectorXd &q) const
  {
    if (bent)
      return bent->modes * bent->polynomials.value(q);
    return coordinates * q + followers * follower_amplitudes(q);
  }

  Eigen::MatrixXd TailBasis::tangent(const Eigen::VectorXd &q) const
  {
    if (bent)
      return bent->modes * bent->polynomials.slopes(q);
    return coordinates + followers * (quadratic * products_derivative(q));
  }

  TailSpace make_tail_space(const SnapshotSet &set)
  {
    const Eigen::Index                         n      = set.tail_nodes_m.rows();
    const double                               length = set.tail_nodes_m.cwiseAbs().maxCoeff();
    std::map<std::array<std::int64_t, 2>, int> node_at;
    const auto                                 key = [&](const double x, const double y) {
      constexpr double cells = 1e9; // of a length: finer than any mesh, coarser than round-off
      return std::array<std::int64_t, 2>{std::llround(x / length * cells), std::llround(y / length * cells)};
    };
    for (Eigen::Index a = 0; a < n; ++a)
      node_at[key(set.tail_nodes_m(a, 0), set.tail_nodes_m(a, 1))] = static_cast<int>(a);

    TailSpace             space;
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(2 * n);
    space.nodes_m             = set.tail_nodes_m;
    space.mean_product        = set.tail_mass_m2 / (one.dot(set.tail_mass_m2 * one) / 2.);
    for (Eigen::Index a = 0; a < n; ++a)
    {
      const auto image = node_at.find(key(set.tail_nodes_m(a, 0), -set.tail_nodes_m(a, 1)));
      if (image == node_at.end())
        throw ComputationError(
            "the tail's mesh is not symmetric about its axis: a reduced model needs a symmetric one");
      space.mirror.push_back(image->second);
    }
    return space;
  }

  Eigen::MatrixXd TailSpace::displacements(const std::vector<SnapshotSet> &sets) const
  {
    Eigen::Index n = 0;
    for (const auto &set : sets)
      n += set.tail_displacement_m.rows();
    Eigen::MatrixXd X(nodes_m.size(), n);
    Eigen::Index    first = 0;
    for (const auto &set : sets)
    {
      X.middleCols(first, set.tail_displacement_m.rows()) = set.tail_displacement_m.transpose();
      first += set.tail_displacement_m.rows();
    }
    return X;
  }

  void TailSpace::require_same_mesh(const SnapshotSet &set, const std::string &origin) const
  {
    if (set.tail_nodes_m.rows() != nodes_m.rows() ||
        (set.tail_nodes_m - nodes_m).cwiseAbs().maxCoeff() > 1e-12 * nodes_m.cwiseAbs().maxCoeff())
      throw InputError(origin + " has another tail mesh than the scene: snapshots that are used together need the " +
                       "same [tail] shape and mesh sizes");
  }

  Eigen::MatrixXd TailSpace::mirrored(const Eigen::MatrixXd &fields) const
  {
    Eigen::MatrixXd result(fields.rows(), fields.cols());
    for (std::size_t a = 0; a < mirror.size(); ++a)
    {
      result.row(2 * a)     = fields.row(2 * mirror[a]);
      result.row(2 * a + 1) = -fields.row(2 * mirror[a] + 1);
    }
    return result;
  }

  double TailSpace::norm(const Eigen::VectorXd &field) const
  {
    return std::sqrt(field.dot(mean_product * field));
  }

  Eigen::VectorXd TailSpace::orthogonal_part(const Eigen::MatrixXd &orthonormal, Eigen::VectorXd field) const
  {
    for (int pass = 0; pass < 2 && orthonormal.cols() > 0; ++pass) // twice is enough
      field -= orthonormal * amplitudes(orthonormal, field);
    return field;
  }

  void append_column(Eigen::MatrixXd &matrix, const Eigen::VectorXd &column)
  {
    matrix.conservativeResize(column.size(), matrix.cols() + 1);
    matrix.rightCols(1) = column;
  }
} // namespace swimtwin
