#include <fom/space/untangling.h>

#include <fom/geometry/reflection.h>

#include <algorithm>
#include <limits>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    constexpr double       sound       = 0.01; ///< quality that a folded element is brought to
    constexpr int          most_sweeps = 12;
    constexpr unsigned int most_folded = 100;

    class Untangling
    {
    public:
      /// `image`: of every vertex; empty for a mesh that is no mirror image.
      Untangling(SimplexMesh<3> &mesh, const std::vector<unsigned int> &image) : mesh_(mesh), image_(image)
      {
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          if (is_upper(c) && quality(c) <= 0.)
            bad_.push_back(c);
      }
      bool has_folded_elements() const { return !bad_.empty(); }
      /// Where many are folded the mesh is too coarse, and no node will help.
      bool is_promising() const { return has_folded_elements() && bad_.size() <= most_folded; }

      void fix_surface(const QuadraticSurface &half, const int on_plane, const std::vector<Point<3>> &kept)
      {
        is_fixed_.assign(mesh_.n_nodes(), 0);
        for (unsigned int t = 0; t < half.corners.triangles.size(); ++t)
          if (half.patch_of[t] != on_plane)
            for (int v = 0; v < 3; ++v)
            {
              const unsigned int a = half.corners.triangles[t][v], b = half.corners.triangles[t][(v + 1) % 3];
              is_fixed_[a] = is_fixed_[mesh_.edge_node(a, b)] = 1;
            }
        for (unsigned int i = 0; i < kept.size(); i += 2)
        {
          const unsigned int a = half.existing_number_at(kept[i]);
          is_fixed_[a]         = 1;
          if (i + 2 < kept.size())
            is_fixed_[mesh_.edge_node(a, half.existing_number_at(kept[i + 2]))] = 1;
        }
      }

      void run()
      {
        cells_at_.resize(mesh_.n_nodes());
        for (unsigned int c = 0; c < mesh_.n_cells(); ++c)
          if (is_upper(c))
            for (const auto node : mesh_.cells[c])
              cells_at_[node].push_back(c);
        for (int sweep = 0; sweep < most_sweeps && has_folded_elements(); ++sweep)
        {
          for (const auto c : bad_)
            for (const auto node : mesh_.cells[c])
              if (!is_fixed_[node])
                improve(node);
          std::erase_if(bad_, [&](const unsigned int c) { return quality(c) >= sound; });
        }
      }

    private:
      double quality(const unsigned int c) const
      {
        return element_quality(cell_positions<3>(mesh_.cells[c], mesh_.nodes));
      }
      bool has_image() const { return !image_.empty(); }
      bool is_upper(const unsigned int c) const
      {
        return !has_image() || std::all_of(mesh_.cells[c].begin(), mesh_.cells[c].begin() + 4,
                                           [&](const unsigned int v) { return mesh_.nodes[v][2] >= 0.; });
      }
      double worst_around(const std::vector<unsigned int> &cells) const
      {
        double worst = 1.;
        for (const auto c : cells)
          worst = std::min(worst, quality(c));
        return worst;
      }
      unsigned int image_of(const unsigned int node) const
      {
        if (node < mesh_.n_vertices())
          return image_[node];
        const auto &[a, b] = mesh_.edges()[node - mesh_.n_vertices()];
        return mesh_.edge_node(image_[a], image_[b]);
      }

      /// A vertex takes the middles of its straight edges along.
      void move(const unsigned int node, const Tensor<1, 3> &by)
      {
        shift(node, by);
        if (node >= mesh_.n_vertices())
          return;
        for (const auto middle : middles_at(node))
          shift(middle, .5 * by);
      }
      std::vector<unsigned int> middles_at(const unsigned int vertex) const
      {
        std::vector<unsigned int> middles;
        for (const auto c : cells_at_[vertex])
          for (auto m = mesh_.cells[c].begin() + 4; m != mesh_.cells[c].end(); ++m)
            if (const auto &ends = mesh_.edges()[*m - mesh_.n_vertices()];
                (ends[0] == vertex || ends[1] == vertex) && !is_fixed_[*m])
              middles.push_back(*m);
        std::sort(middles.begin(), middles.end());
        middles.erase(std::unique(middles.begin(), middles.end()), middles.end());
        return middles;
      }
      void shift(const unsigned int node, const Tensor<1, 3> &by)
      {
        mesh_.nodes[node] += by;
        if (!has_image())
          return;
        if (const unsigned int other = image_of(node); other != node)
          mesh_.nodes[other] = mirrored(mesh_.nodes[node]);
      }

      /// Search along axes and diagonals, by ever shorter steps, for where the worst element around is best.
      void improve(const unsigned int node)
      {
        const auto &cells = cells_at_[node];
        double      size  = 0.;
        for (const auto c : cells)
          size = std::max(size, mesh_.nodes[mesh_.cells[c][0]].distance(mesh_.nodes[mesh_.cells[c][1]]));
        const auto directions = unit_directions(has_image() && image_of(node) == node);
        double     best       = worst_around(cells);
        for (double step = size / 4.; step > size / 300.; step /= 2.)
          for (const auto &direction : directions)
          {
            const Tensor<1, 3> by = step * direction;
            move(node, by);
            if (const double now = worst_around(cells); now > best)
              best = now;
            else
              move(node, -by);
          }
      }
      static std::vector<Tensor<1, 3>> unit_directions(const bool in_plane)
      {
        std::vector<Tensor<1, 3>> directions;
        for (const double x : {0., 1., -1.})
          for (const double y : {0., 1., -1.})
            for (const double z : {0., 1., -1.})
              if (const Tensor<1, 3> d({x, y, z}); d.norm() > 0. && !(in_plane && z != 0.))
                directions.push_back(d / d.norm());
        return directions;
      }

      SimplexMesh<3>                        &mesh_;
      const std::vector<unsigned int>       &image_;
      std::vector<unsigned int>              bad_;
      std::vector<char>                      is_fixed_;
      std::vector<std::vector<unsigned int>> cells_at_; ///< of z >= 0
    };
  } // namespace

  void untangle(SimplexMesh<3> &mesh, const QuadraticSurface &half, const std::vector<unsigned int> &image,
                const int on_plane, const std::vector<Point<3>> &kept)
  {
    Untangling untangling(mesh, image);
    if (!untangling.is_promising())
      return;
    untangling.fix_surface(half, on_plane, kept);
    untangling.run();
  }

  void untangle(SimplexMesh<3> &mesh, const QuadraticSurface &surface)
  {
    constexpr int no_plane = std::numeric_limits<int>::min();
    untangle(mesh, surface, {}, no_plane);
  }
} // namespace swimtwin
