#include <datasets/surface/closed_surface.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  using Eigen::Vector3d;

  namespace
  {
    struct FacePoint
    {
      Vector3d x, area; ///< position; normal times the element of area
    };

    /// Of a quadratic face at barycentric coordinates (1 - s - t, s, t).
    FacePoint point_on(const std::array<Vector3d, 6> &node, const double s, const double t)
    {
      const double r     = 1. - s - t;
      const auto   value = [&](const std::array<double, 6> &weight) {
        Vector3d sum = Vector3d::Zero();
        for (int a = 0; a < 6; ++a)
          sum += weight[a] * node[a];
        return sum;
      };
      const Vector3d x =
          value({r * (2. * r - 1.), s * (2. * s - 1.), t * (2. * t - 1.), 4. * r * s, 4. * s * t, 4. * t * r});
      const Vector3d by_s = value({1. - 4. * r, 4. * s - 1., 0., 4. * (r - s), 4. * t, -4. * t});
      const Vector3d by_t = value({1. - 4. * r, 0., 4. * t - 1., -4. * s, 4. * s, 4. * (r - t)});
      return {x, by_s.cross(by_t)};
    }

    /// Gauss points of the triangle, exact for polynomials of degree 8: cubic moments of quadratic faces.
    template <typename Add>
    void integrate(const std::array<Vector3d, 6> &node, const Add &add)
    {
      constexpr std::array<double, 5> at{-0.906179845938664, -0.538469310105683, 0., 0.538469310105683,
                                         0.906179845938664},
          weight{0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366, 0.236926885056189};
      for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 5; ++j)
        {
          const double s = .5 * (1. + at[i]), t = .5 * (1. + at[j]) * (1. - s);
          add(point_on(node, s, t), .25 * weight[i] * weight[j] * (1. - s));
        }
    }
  } // namespace

  EnclosedVolume enclosed_volume(const ClosedSurface &surface)
  {
    // From a point amid the surface, so that nothing cancels: V = int x . n / 3, int x_i dV = int x_i^2 n_i / 2,
    // int x_i x_j dV = int x_i^2 x_j n_i / 2, int x_i^2 dV = int x_i^3 n_i / 3.
    const Extent    box    = extent(surface.nodes);
    const Vector3d  origin = .5 * (box.low + box.high);
    double          volume = 0.;
    Vector3d        first  = Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (const auto &face : surface.faces)
    {
      std::array<Vector3d, 6> node;
      for (int a = 0; a < 6; ++a)
        node[a] = surface.nodes[face[a]] - origin;
      integrate(node, [&](const FacePoint &point, const double weight) {
        const Vector3d &x = point.x, n = weight * point.area;
        volume += x.dot(n) / 3.;
        for (int i = 0; i < 3; ++i)
        {
          first[i] += .5 * x[i] * x[i] * n[i];
          for (int j = 0; j < 3; ++j)
            second(i, j) += i == j ? x[i] * x[i] * x[i] * n[i] / 3. : .25 * x[i] * x[j] * (x[i] * n[i] + x[j] * n[j]);
        }
      });
    }
    const Vector3d mean = first / volume;
    return {volume, origin + mean, second - volume * mean * mean.transpose()};
  }

  double triangle_quality(const Vector3d &a, const Vector3d &b, const Vector3d &c)
  {
    const double edges = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return edges > 0. ? 2. * std::sqrt(3.) * (b - a).cross(c - a).norm() / edges : 0.;
  }

  TriangleSizes triangle_sizes(const ClosedSurface &surface)
  {
    TriangleSizes sizes;
    for (const auto &face : surface.faces)
    {
      const Vector3d &a = surface.nodes[face[0]], &b = surface.nodes[face[1]], &c = surface.nodes[face[2]];
      for (const double edge : {(b - a).norm(), (c - b).norm(), (a - c).norm()})
      {
        sizes.mean_edge_m += edge / (3. * static_cast<double>(surface.faces.size()));
        sizes.longest_edge_m = std::max(sizes.longest_edge_m, edge);
      }
      sizes.worst_quality = std::min(sizes.worst_quality, triangle_quality(a, b, c));
    }
    return sizes;
  }

  Extent extent(const std::vector<Vector3d> &points)
  {
    Extent box{points.front(), points.front()};
    for (const Vector3d &x : points)
    {
      box.low  = box.low.cwiseMin(x);
      box.high = box.high.cwiseMax(x);
    }
    return box;
  }

  std::vector<std::array<unsigned int, 3>> flat_triangles(const std::vector<SurfaceFace> &faces, const bool is_curved)
  {
    std::vector<std::array<unsigned int, 3>> triangles;
    for (const auto &[a, b, c, ab, bc, ca] : faces)
      if (is_curved)
        triangles.insert(triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
      else
        triangles.push_back({a, b, c});
    return triangles;
  }
} // namespace swimtwin
