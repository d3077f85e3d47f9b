#include <reports/run/spatial_view.h>

#include <datasets/surface/closed_surface.h>
#include <datasets/surface/elastic_part.h>
#include <reports/page/shown_units.h>
#include <reports/run/run_scripts.h>
#include <reports/run/shown_instants.h>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr int n_views = 4;

    using PointInSpace = Eigen::Vector3d;
    using Polygon      = std::vector<PointInSpace>; ///< m

    struct SwimmerInSpace
    {
      double               time = 0.;
      std::vector<Polygon> tail, head;
    };

    /// Each quadratic face on the boundary as four plane triangles.
    std::vector<std::array<unsigned int, 3>> boundary_triangles(const Eigen::MatrixXi &cells)
    {
      constexpr int face[4][6] = {
          {0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {0, 3, 2, 7, 9, 6}, {1, 2, 3, 5, 9, 8}}; // seen from outside
      std::map<std::array<unsigned int, 3>, std::pair<int, SurfaceFace>> faces;
      for (Eigen::Index cell = 0; cell < cells.rows(); ++cell)
        for (const auto &corners : face)
        {
          SurfaceFace nodes;
          for (int i = 0; i < 6; ++i)
            nodes[i] = static_cast<unsigned int>(cells(cell, corners[i]));
          std::array<unsigned int, 3> key{nodes[0], nodes[1], nodes[2]};
          std::sort(key.begin(), key.end());
          auto &[n_owners, kept] = faces[key];
          ++n_owners;
          kept = nodes;
        }
      std::vector<SurfaceFace> boundary;
      for (const auto &[key, owned] : faces)
        if (const auto &[n_owners, nodes] = owned; n_owners == 1)
          boundary.push_back(nodes);
      return flat_triangles(boundary, true);
    }

    struct PoseInSpace
    {
      PointInSpace       center; ///< m
      Eigen::Quaterniond rotation;
    };

    PoseInSpace head_pose(const SnapshotSet &set, const Eigen::Index row)
    {
      if (set.pose_in_space.size() > 0)
      {
        const auto pose = set.pose_in_space.row(row);
        return {pose.head<3>().transpose(), Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6])};
      }
      return {PointInSpace(set.pose(row, 0), set.pose(row, 1), 0.),
              Eigen::Quaterniond(Eigen::AngleAxisd(set.pose(row, 2), PointInSpace::UnitZ()))};
    }

    PoseInSpace head_pose(const TrajectoryRow &row)
    {
      return {PointInSpace(row.head_x_m, row.head_y_m, row.head_z_m),
              Eigen::Quaterniond(row.head_qw, row.head_qx, row.head_qy, row.head_qz)};
    }

    PointInSpace placed(const PointInSpace &point, const PoseInSpace &pose)
    {
      return pose.center + pose.rotation * point;
    }

    std::vector<Polygon> tail_surface(const SnapshotSet &set, const Eigen::Index row, const PoseInSpace &pose)
    {
      std::vector<Polygon> surface;
      for (const auto &triangle : boundary_triangles(set.tail_cells))
      {
        Polygon &polygon = surface.emplace_back();
        for (const unsigned int node : triangle)
        {
          const PointInSpace at_rest = set.tail_nodes_m.row(node).transpose();
          const PointInSpace moved   = set.tail_displacement_m.row(row).segment<3>(3 * node).transpose();
          polygon.push_back(placed(at_rest + moved, pose));
        }
      }
      return surface;
    }

    /// x and radius from the nose to the back.
    std::vector<std::array<double, 2>> meridian(const Head &head)
    {
      constexpr int n_arcs = 16;
      const double  a = .5 * head.size_m[0], b = .5 * head.size_m[1];
      if (head.shape == HeadShape::rectangle)
        return {{-a, 0.}, {-a, b}, {a, b}, {a, 0.}};
      std::vector<std::array<double, 2>> points;
      for (int i = 0; i <= n_arcs; ++i)
        points.push_back({-a * std::cos(std::numbers::pi * i / n_arcs), b * std::sin(std::numbers::pi * i / n_arcs)});
      return points;
    }

    std::vector<Polygon> head_surface(const Scene &scene, const PoseInSpace &pose)
    {
      constexpr int        n_angles = 36;
      std::vector<Polygon> surface;
      const Head          &head = scene.head;
      if (head.surface)
      {
        for (std::size_t f = 0; f < head.surface->faces.size(); ++f)
          if (const auto &face = head.surface->faces[f]; !scene.tail || !scene.tail->part->has_face[f])
            surface.push_back({placed(head.surface->nodes[face[0]], pose), placed(head.surface->nodes[face[1]], pose),
                               placed(head.surface->nodes[face[2]], pose)});
        return surface;
      }
      const auto points = meridian(head);
      for (std::size_t i = 0; i + 1 < points.size(); ++i)
        for (int k = 0; k < n_angles; ++k)
        {
          const auto at = [&](const std::size_t point, const int angle) {
            const auto &[x, r] = points[point];
            const double phi   = 2. * std::numbers::pi * angle / n_angles;
            return placed({x, r * std::cos(phi), r * std::sin(phi)}, pose);
          };
          surface.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
        }
      return surface;
    }

    std::vector<SwimmerInSpace> views(const ShownRun &run)
    {
      std::vector<SwimmerInSpace> views;
      if (run.has_tail())
      {
        const SnapshotSet &set = *run.snapshots;
        for (const std::size_t i :
             closest_instants(run, n_views, set.time_s.size(), [&](const std::size_t k) { return set.time_s[k]; }))
        {
          const auto        row  = static_cast<Eigen::Index>(i);
          const PoseInSpace pose = head_pose(set, row);
          views.push_back(
              {shown_time(run, set.time_s[i]), tail_surface(set, row, pose), head_surface(run.scene, pose)});
        }
        return views;
      }
      for (const std::size_t i : closest_instants(run, n_views, run.trajectory.size(),
                                                  [&](const std::size_t k) { return run.trajectory[k].time_s; }))
      {
        const TrajectoryRow &row = run.trajectory[i];
        views.push_back({shown_time(run, row.time_s), {}, head_surface(run.scene, head_pose(row))});
      }
      return views;
    }

    /// Smallest box around everything.
    class Box
    {
    public:
      void add(const PointInSpace &point)
      {
        low_  = low_.cwiseMin(point);
        high_ = high_.cwiseMax(point);
      }
      void set_in(GnuplotPicture &picture) const
      {
        const double margin = .03 * (high_ - low_).maxCoeff();
        for (int c = 0; c < 3; ++c)
        {
          picture.set(fmt::format("{}_min", "xyz"[c]), low_[c] - margin);
          picture.set(fmt::format("{}_max", "xyz"[c]), high_[c] + margin);
        }
      }

    private:
      PointInSpace low_ = PointInSpace::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
    };

    void add_surface(const std::vector<Polygon> &surface, const std::string &name, GnuplotTable &table, Box &box)
    {
      table.begin_block(name + ": polygons, x, y, z (mm)");
      for (const Polygon &polygon : surface)
      {
        for (const PointInSpace &point : polygon)
        {
          const PointInSpace shown = mm * point;
          table.add_row({shown[0], shown[1], shown[2]});
          box.add(shown);
        }
        table.end_polygon();
      }
    }
  } // namespace

  GnuplotPicture spatial_view_picture(const ShownRun &run)
  {
    const bool     periodic = run.has_full_period();
    GnuplotPicture picture =
        make_picture(run, "spatial_view", gnuplot_scripts::spatial_view, "The swimmer in space",
                     periodic ? "four instants of the last full period" : "four instants of the run");
    Box         box;
    std::string instants;
    for (const SwimmerInSpace &view : views(run))
    {
      if (run.has_tail())
        add_surface(view.tail, "tail", picture.table, box);
      add_surface(view.head, "head", picture.table, box);
      instants += fmt::format("{}{:.4g}", instants.empty() ? "" : " ", view.time);
    }
    box.set_in(picture);
    picture.set_text("instants", instants);
    picture.set_text("instant_unit", periodic ? "periods" : "s");
    picture.set_flag("has_tail", run.has_tail());
    return picture;
  }
} // namespace swimtwin
