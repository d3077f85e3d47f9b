#include <fom/isoparametric_cell.h>
#include <fom/mesh_motion.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Point<dim> centroid(const SimplexMesh<dim> &mesh, const CellNodes<dim> &cell)
    {
      Point<dim> center;
      for (int v = 0; v <= dim; ++v)
        center += mesh.nodes[cell[v]] / (dim + 1.);
      return center;
    }

    template <int dim>
    std::vector<double> cell_volumes(const SimplexMesh<dim> &mesh)
    {
      IsoparametricCell<dim> map(2);
      std::vector<double>    volumes;
      for (const auto &cell : mesh.cells)
      {
        map.reinit(cell_positions<dim>(cell, mesh.nodes));
        double volume = 0.;
        for (unsigned int q = 0; q < map.n_points(); ++q)
          volume += map.weight(q);
        volumes.push_back(volume);
      }
      return volumes;
    }

    /// The cell's weight in the law of mesh motion.
    template <int dim>
    std::vector<double> cell_stiffness(const SimplexMesh<dim> &mesh, const MeshMotion law, const std::vector<unsigned int> &moving_nodes)
    {
      const std::vector<double> volume = cell_volumes(mesh);
      const double              smallest = *std::min_element(volume.begin(), volume.end()),
                   largest               = *std::max_element(volume.begin(), volume.end());
      std::vector<double> stiffness(mesh.n_cells(), 1.);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (law == MeshMotion::weighted_harmonic)
          stiffness[c] = 1. + (1. - smallest / largest) / (volume[c] / largest);
        else if (law == MeshMotion::elastic)
        {
          const Point<dim> center   = centroid(mesh, mesh.cells[c]);
          double           distance = std::numeric_limits<double>::max();
          for (const auto node : moving_nodes)
            distance = std::min(distance, center.distance_square(mesh.nodes[node]));
          stiffness[c] = std::pow(smallest, 2. / dim) / std::max(distance, std::pow(volume[c], 2. / dim));
        }
      return stiffness;
    }

    /// elastic: 2 mu D:D + lambda div div with lambda = mu = 1; else component-wise Laplacian.
    template <int dim>
    void cell_matrix(const IsoparametricCell<dim> &map, const MeshMotion law, const double stiffness, std::vector<std::vector<double>> &K)
    {
      constexpr unsigned int n = n_cell_nodes<dim>;
      for (auto &row : K)
        std::fill(row.begin(), row.end(), 0.);
      for (unsigned int q = 0; q < map.n_points(); ++q)
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
          {
            const auto  &ga = map.gradient(q, a), &gb = map.gradient(q, b);
            const double w = stiffness * map.weight(q);
            for (int i = 0; i < dim; ++i)
            {
              K[a * dim + i][b * dim + i] += w * (ga * gb);
              if (law == MeshMotion::elastic)
                for (int j = 0; j < dim; ++j)
                  K[a * dim + i][b * dim + j] += w * (ga[j] * gb[i] + ga[i] * gb[j]);
            }
          }
    }

    LinearSolverOptions extension_options()
    {
      LinearSolverOptions options;
      options.tolerance         = 1e-11;
      options.positive_definite = true;
      return options;
    }
  } // namespace

  template <int dim>
  MeshExtension<dim>::MeshExtension(const SimplexMesh<dim> &mesh, const NodeNumbering<dim> &numbering, const MeshMotion law,
                                    std::vector<unsigned int> moving_nodes, const std::vector<unsigned int> &still_nodes)
    : mesh_(mesh), numbering_(numbering), moving_nodes_(std::move(moving_nodes)), map_(numbering.size(), 0, 1.),
      condensation_(map_), system_(mesh.communicator(), extension_options())
  {
    std::vector<char> is_vector(numbering.size(), 0);
    for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
      for (int c = 0; c < dim; ++c)
        is_vector[numbering.vector_index(node, c)] = 1;
    for (unsigned int row = 0; row < numbering.size(); ++row)
      if (!is_vector[row])
        map_.impose(row); // pressures have no part in this
    for (const auto *nodes : {&std::as_const(moving_nodes_), &still_nodes})
      for (const auto node : *nodes)
        for (int c = 0; c < dim; ++c)
          map_.impose(numbering.vector_index(node, c));
    std::vector<unsigned int> owner(numbering.size());
    for (unsigned int i = 0; i < owner.size(); ++i)
      owner[i] = numbering.owner(i);
    map_.close(owner, false, mesh.communicator());
    assemble(law);
  }

  template <int dim>
  void MeshExtension<dim>::assemble(const MeshMotion law)
  {
    std::vector<char> moves(mesh_.n_nodes(), 0);
    for (const auto node : moving_nodes_)
      moves[node] = 1;
    constexpr unsigned int    n = n_cell_nodes<dim> * dim;
    std::vector<unsigned int> owned;
    for (unsigned int c = 0; c < mesh_.n_cells(); ++c)
      if (mesh_.is_owned(c))
      {
        std::vector<unsigned int> rows(n);
        for (unsigned int i = 0; i < n; ++i)
          rows[i] = numbering_.vector_index(mesh_.cells[c][i / dim], i % dim);
        owned.push_back(c);
        condensation_.add_cell(rows);
        if (std::any_of(mesh_.cells[c].begin(), mesh_.cells[c].end(), [&](const unsigned int node) { return moves[node]; }))
          boundary_cells_.push_back({rows, {}});
      }
    condensation_.lay_out(system_);

    const std::vector<double>        stiffness = cell_stiffness(mesh_, law, moving_nodes_);
    IsoparametricCell<dim>           map;
    std::vector<std::vector<double>> K(n, std::vector<double>(n));
    const std::vector<double>        no_load(n, 0.);
    condensation_.reset();
    auto boundary_cell = boundary_cells_.begin();
    for (unsigned int k = 0; k < owned.size(); ++k)
    {
      const auto &nodes = mesh_.cells[owned[k]];
      map.reinit(cell_positions<dim>(nodes, mesh_.nodes));
      cell_matrix(map, law, stiffness[owned[k]], K);
      condensation_.add(k, K, no_load);
      if (std::any_of(nodes.begin(), nodes.end(), [&](const unsigned int node) { return moves[node]; }))
        (boundary_cell++)->matrix = K;
    }
    system_.set_matrix(condensation_.values());
    last_solution_.assign(map_.n_unknowns(), 0.);
  }

  template <int dim>
  std::vector<Tensor<1, dim>> MeshExtension<dim>::extend(const std::vector<Tensor<1, dim>> &displacement)
  {
    for (unsigned int k = 0; k < moving_nodes_.size(); ++k)
      for (int c = 0; c < dim; ++c)
        map_.imposed[numbering_.vector_index(moving_nodes_[k], c)] = displacement[k][c];

    std::vector<double> rhs(map_.n_unknowns(), 0.);
    for (const auto &[rows, K] : boundary_cells_)
      for (unsigned int i = 0; i < rows.size(); ++i)
      {
        double load = 0.;
        for (unsigned int j = 0; j < rows.size(); ++j)
          load -= K[i][j] * map_.imposed[rows[j]];
        map_.add_load(rows[i], load, rhs);
      }
    system_.set_right_hand_side(rhs);
    if (!system_.solve(last_solution_))
      return {};

    const std::vector<double>   values = map_.expand(last_solution_);
    std::vector<Tensor<1, dim>> result(mesh_.n_nodes());
    for (unsigned int node = 0; node < mesh_.n_nodes(); ++node)
      for (int c = 0; c < dim; ++c)
        result[node][c] = values[numbering_.vector_index(node, c)];
    return result;
  }

  template class MeshExtension<2>;
  template class MeshExtension<3>;
} // namespace swimtwin
