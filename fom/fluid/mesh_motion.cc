#include <fom/fluid/mesh_motion.h>

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

    /// Gradients of the linear shape functions and volume of a cell with straight edges.
    template <int dim>
    struct LinearCell
    {
      std::array<Tensor<1, dim>, dim + 1> gradient;
      double                              volume;

      LinearCell(const SimplexMesh<dim> &mesh, const CellNodes<dim> &cell)
      {
        Tensor<2, dim> edges; // row i: from vertex 0 to vertex i + 1
        for (int i = 0; i < dim; ++i)
          edges[i] = mesh.nodes[cell[i + 1]] - mesh.nodes[cell[0]];
        const Tensor<2, dim> inverse = invert(edges);
        for (int i = 0; i < dim; ++i)
        {
          for (int c = 0; c < dim; ++c)
            gradient[i + 1][c] = inverse[c][i];
          gradient[0] -= gradient[i + 1];
        }
        volume = determinant(edges) / (dim == 2 ? 2. : 6.);
      }
    };

    template <int dim>
    std::vector<double> cell_volumes(const SimplexMesh<dim> &mesh)
    {
      std::vector<double> volumes;
      for (const auto &cell : mesh.cells)
        volumes.push_back(LinearCell<dim>(mesh, cell).volume);
      return volumes;
    }

    /// The cell's weight in the law of mesh motion.
    template <int dim>
    std::vector<double> cell_stiffness(const SimplexMesh<dim> &mesh, const MeshMotion law,
                                       const std::vector<unsigned int> &moving_nodes)
    {
      const std::vector<double> volume   = cell_volumes(mesh);
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
    void cell_matrix(const LinearCell<dim> &cell, const MeshMotion law, const double stiffness,
                     std::vector<std::vector<double>> &K)
    {
      const double w = stiffness * cell.volume;
      for (int a = 0; a <= dim; ++a)
        for (int b = 0; b <= dim; ++b)
        {
          const auto &ga = cell.gradient[a], &gb = cell.gradient[b];
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              K[a * dim + i][b * dim + j] = (i == j ? w * (ga * gb) : 0.) +
                                            (law == MeshMotion::elastic ? w * (ga[j] * gb[i] + ga[i] * gb[j]) : 0.);
        }
    }

  } // namespace

  template <int dim>
  MeshExtension<dim>::MeshExtension(const SimplexMesh<dim> &mesh, const NodeNumbering<dim> &numbering,
                                    const MeshMotion law, std::vector<unsigned int> moving_nodes,
                                    const std::vector<unsigned int> &still_nodes, const MirrorPairs<dim> &mirror_pairs,
                                    const LinearSolver solver)
      : mesh_(mesh), numbering_(numbering), moving_nodes_(std::move(moving_nodes)), map_(numbering.size(), 0, 1.),
        condensation_(map_),
        system_(mesh.communicator(),
                {.positive_definite = true, .method = solver, .standard = StandardPreconditioner::multigrid})
  {
    std::vector<char> is_unknown(numbering.size(), 0);
    for (unsigned int vertex = 0; vertex < mesh.n_vertices(); ++vertex)
      for (int c = 0; c < dim; ++c)
        is_unknown[numbering.vector_index(vertex, c)] = 1;
    for (const auto *nodes : {&std::as_const(moving_nodes_), &still_nodes})
      for (const auto node : *nodes)
        for (int c = 0; c < dim; ++c)
          is_unknown[numbering.vector_index(node, c)] = 0;
    for (unsigned int row = 0; row < numbering.size(); ++row)
      if (!is_unknown[row])
        map_.impose(row);
    mirror_pairs.describe(map_, numbering, false);
    std::vector<unsigned int> owner(numbering.size());
    for (unsigned int i = 0; i < owner.size(); ++i)
      owner[i] = numbering.owner(i);
    map_.close(owner, false, mesh.communicator());
    assemble(law, mirror_pairs);
  }

  template <int dim>
  void MeshExtension<dim>::assemble(const MeshMotion law, const MirrorPairs<dim> &mirror_pairs)
  {
    std::vector<char> moves(mesh_.n_nodes(), 0);
    for (const auto node : moving_nodes_)
      moves[node] = 1;
    const auto touches = [&](const CellNodes<dim> &nodes) {
      return std::any_of(nodes.begin(), nodes.begin() + dim + 1, [&](const unsigned int node) { return moves[node]; });
    };
    constexpr unsigned int    n = (dim + 1) * dim;
    std::vector<unsigned int> owned;
    for (unsigned int c = 0; c < mesh_.n_cells(); ++c)
      if (mesh_.is_owned(c) && !mirror_pairs.is_image(mesh_.cells[c]))
      {
        std::vector<unsigned int> rows(n);
        for (unsigned int i = 0; i < n; ++i)
          rows[i] = numbering_.vector_index(mesh_.cells[c][i / dim], i % dim);
        owned.push_back(c);
        condensation_.add_cell(rows);
        if (touches(mesh_.cells[c]))
          boundary_cells_.push_back({rows, {}});
      }
    condensation_.lay_out(system_);

    const std::vector<double>        stiffness = cell_stiffness(mesh_, law, moving_nodes_);
    std::vector<std::vector<double>> K(n, std::vector<double>(n));
    const std::vector<double>        no_load(n, 0.);
    condensation_.reset();
    auto boundary_cell = boundary_cells_.begin();
    for (unsigned int k = 0; k < owned.size(); ++k)
    {
      const auto &nodes = mesh_.cells[owned[k]];
      cell_matrix(LinearCell<dim>(mesh_, nodes), law, stiffness[owned[k]], K);
      condensation_.add(k, K, no_load);
      if (touches(nodes))
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
    if (system_.is_iterative()) // whatever was before, the mesh is the same
      last_solution_.assign(map_.n_unknowns(), 0.);
    if (!system_.solve(last_solution_))
      return {};

    // Vertices move by the solution, prescribed nodes exactly; other mid-edge nodes stay in the middle of their edge.
    const std::vector<double>   values = map_.expand(last_solution_);
    std::vector<Tensor<1, dim>> result(mesh_.n_nodes());
    for (unsigned int vertex = 0; vertex < mesh_.n_vertices(); ++vertex)
      for (int c = 0; c < dim; ++c)
        result[vertex][c] = values[numbering_.vector_index(vertex, c)];
    for (unsigned int e = 0; e < mesh_.edges().size(); ++e)
      result[mesh_.n_vertices() + e] = .5 * (result[mesh_.edges()[e][0]] + result[mesh_.edges()[e][1]]);
    for (unsigned int k = 0; k < moving_nodes_.size(); ++k)
      result[moving_nodes_[k]] = displacement[k];
    return result;
  }

  template class MeshExtension<2>;
  template class MeshExtension<3>;
} // namespace swimtwin
