#include <rom/training/tail_basis.h>

#include <datasets/system/error.h>
#include <fom/geometry/cell_search.h>
#include <fom/geometry/reflection.h>
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

  namespace
  {
    TailSpace without_mirror(const SnapshotSet &set)
    {
      const Eigen::VectorXd one    = Eigen::VectorXd::Ones(set.tail_nodes_m.size());
      const double          volume = one.dot(set.tail_mass_m2 * one) / static_cast<double>(set.tail_nodes_m.cols());
      return {set.tail_nodes_m, set.tail_mass_m2 / volume, {}, {}};
    }

    /// Node by node: what other nodes' values add up to at a node's image. Components across the mirror change sign.
    Eigen::SparseMatrix<double> mirror_of(const std::vector<std::vector<std::pair<unsigned int, double>>> &at_image,
                                          const int                                                        dim)
    {
      const auto                          n = static_cast<Eigen::Index>(dim * at_image.size());
      std::vector<Eigen::Triplet<double>> entries;
      for (std::size_t a = 0; a < at_image.size(); ++a)
        for (const auto &[node, value] : at_image[a])
          for (int c = 0; c < dim; ++c)
            entries.emplace_back(dim * a + c, dim * node + c, c == 1 ? -value : value);
      Eigen::SparseMatrix<double> mirror(n, n);
      mirror.setFromTriplets(entries.begin(), entries.end());
      return mirror;
    }
  } // namespace

  TailSpace make_tail_space(const SnapshotSet &set)
  {
    const Eigen::Index                                  n      = set.tail_nodes_m.rows();
    const double                                        length = set.tail_nodes_m.cwiseAbs().maxCoeff();
    std::map<std::array<std::int64_t, 2>, unsigned int> node_at;
    const auto                                          key = [&](const double x, const double y) {
      constexpr double cells = 1e9; // of a length: finer than any mesh, coarser than round-off
      return std::array<std::int64_t, 2>{std::llround(x / length * cells), std::llround(y / length * cells)};
    };
    for (Eigen::Index a = 0; a < n; ++a)
      node_at[key(set.tail_nodes_m(a, 0), set.tail_nodes_m(a, 1))] = static_cast<unsigned int>(a);

    std::vector<std::vector<std::pair<unsigned int, double>>> at_image;
    for (Eigen::Index a = 0; a < n; ++a)
    {
      const auto image = node_at.find(key(set.tail_nodes_m(a, 0), -set.tail_nodes_m(a, 1)));
      if (image == node_at.end())
        throw ComputationError(
            "the tail's mesh is not symmetric about its axis: a reduced model needs a symmetric one");
      at_image.push_back({{image->second, 1.}});
    }
    TailSpace space = without_mirror(set);
    space.mirror    = mirror_of(at_image, 2);
    return space;
  }

  template <>
  TailSpace make_tail_space<2>(const SnapshotSet &set, const SimplexMesh<2> & /*mesh*/)
  {
    return make_tail_space(set);
  }

  template <>
  TailSpace make_tail_space<3>(const SnapshotSet &set, const SimplexMesh<3> &mesh)
  {
    const CellSearch<3>                                       search(mesh, mesh.nodes);
    const auto                                                images = images_of_nodes(mesh); // in the plane of motion
    std::vector<std::vector<std::pair<unsigned int, double>>> at_image(mesh.n_nodes());
    std::vector<char>                                         is_clamped(mesh.n_nodes(), 0); // where fields are zero
    for (const int node : set.clamped_nodes)
      is_clamped[static_cast<unsigned int>(node)] = 1;
    for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
    {
      const auto &x = mesh.nodes[node];
      if ((images && x[2] < 0.) || is_clamped[node])
        continue;
      const auto place = search.find({x[0], -x[1], x[2]});
      if (!place)
        throw ComputationError(
            "the tail is not its own image in the mirror y -> -y: a reduced model needs one that is");
      const bool on_plane = images && x[2] == 0.; // from both sides
      for (unsigned int a = 0; a < n_cell_nodes<3>; ++a)
      {
        const unsigned int other = mesh.cells[place->cell][a];
        at_image[node].emplace_back(other, (on_plane ? .5 : 1.) * place->value[a]);
        if (on_plane)
          at_image[node].emplace_back((*images)[other], .5 * place->value[a]);
      }
    }
    for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
      if (at_image[node].empty() && !is_clamped[node])
        for (const auto &[other, value] : at_image[(*images)[node]])
          at_image[node].emplace_back((*images)[other], value);
    TailSpace space = without_mirror(set);
    space.mirror    = mirror_of(at_image, 3);
    if (images)
      space.images = *images;
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
    if (set.pose_in_space.size() > 0)
      throw InputError(origin +
                       " has motions out of the plane of x and y, in which the reduced swimmer moves: leave it out");
    if (set.tail_nodes_m.rows() != nodes_m.rows() || set.tail_nodes_m.cols() != nodes_m.cols() ||
        (set.tail_nodes_m - nodes_m).cwiseAbs().maxCoeff() > 1e-12 * nodes_m.cwiseAbs().maxCoeff())
      throw InputError(origin + " has another tail mesh than the scene: snapshots that are used together need the " +
                       "same [tail] shape and mesh sizes");
  }

  Eigen::MatrixXd TailSpace::kept_to_plane(const Eigen::MatrixXd &fields) const
  {
    constexpr int   dim = 3, z = 2;
    Eigen::MatrixXd result = fields;
    for (std::size_t a = 0; a < images.size(); ++a)
      for (int i = 0; i < dim; ++i)
        result.row(dim * a + i) =
            (fields.row(dim * a + i) + (i == z ? -1. : 1.) * fields.row(dim * images[a] + i)) / 2.;
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
