#include <fom/surface/surface_mesh.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_simplex_p.h>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    double cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    /// Symmetric bilinear form whose value at (x, x) is the area under a quadratic edge from p over m to q: the
    /// integral of x cross dx is 4/3 (p cross m + m cross q) - 1/3 p cross q.
    double area_form(const FaceNodes<2> &edge, const std::vector<Tensor<1, 2>> &x, const std::vector<Tensor<1, 2>> &y)
    {
      const auto &[p, m, q] = edge;
      const auto term       = [&](const unsigned int a, const unsigned int b) {
        return .5 * (cross(x[a], y[b]) + cross(y[a], x[b]));
      };
      return (4. * term(p, m) + 4. * term(m, q) - term(p, q)) / 3.;
    }

    /// Shape functions of a quadratic triangle at points that integrate degree 5 exactly: x . (dx/dr cross dx/ds) is of
    /// degree 4.
    class TriangleRule
    {
    public:
      TriangleRule() : quadrature_(3)
      {
        const FE_SimplexP<2> quadratic(2);
        for (const auto &point : quadrature_.get_points())
          for (unsigned int a = 0; a < 6; ++a)
          {
            value_.push_back(quadratic.shape_value(a, point));
            gradient_.push_back(quadratic.shape_grad(a, point));
          }
      }
      unsigned int n_points() const { return quadrature_.size(); }
      double       weight(const unsigned int q) const { return quadrature_.weight(q); }
      double       value(const unsigned int q, const unsigned int a) const { return value_[6 * q + a]; }
      Tensor<1, 3> at(const unsigned int q, const FaceNodes<3> &face, const std::vector<Tensor<1, 3>> &x) const
      {
        Tensor<1, 3> sum;
        for (unsigned int a = 0; a < 6; ++a)
          sum += value(q, a) * x[face[a]];
        return sum;
      }
      /// Normal, as long as the area per area of the reference triangle.
      Tensor<1, 3> normal(const unsigned int q, const FaceNodes<3> &face, const std::vector<Tensor<1, 3>> &x) const
      {
        Tensor<1, 3> along[2];
        for (unsigned int a = 0; a < 6; ++a)
          for (int i = 0; i < 2; ++i)
            along[i] += gradient_[6 * q + a][i] * x[face[a]];
        return cross_product_3d(along[0], along[1]);
      }

    private:
      QGaussSimplex<2>          quadrature_;
      std::vector<double>       value_;
      std::vector<Tensor<1, 2>> gradient_;
    };

    const TriangleRule &triangle_rule()
    {
      static const TriangleRule rule;
      return rule;
    }

    /// int y . n over the faces with nodes at x.
    double flux(const std::vector<FaceNodes<3>> &faces, const std::vector<Tensor<1, 3>> &x,
                const std::vector<Tensor<1, 3>> &y)
    {
      const TriangleRule &rule = triangle_rule();
      double              sum  = 0.;
      for (const auto &face : faces)
        for (unsigned int q = 0; q < rule.n_points(); ++q)
          sum += rule.weight(q) * (rule.normal(q, face, x) * rule.at(q, face, y));
      return sum;
    }

    template <int dim>
    std::vector<Tensor<1, dim>> vectors(const std::vector<Point<dim>> &points)
    {
      return {points.begin(), points.end()};
    }
  } // namespace

  template <>
  double enclosed_volume<2>(const std::vector<FaceNodes<2>> &faces, const std::vector<Tensor<1, 2>> &x)
  {
    double sum = 0.;
    for (const auto &edge : faces)
      sum += area_form(edge, x, x);
    return .5 * sum;
  }

  template <>
  double enclosed_volume_rate<2>(const std::vector<FaceNodes<2>> &faces, const std::vector<Tensor<1, 2>> &x,
                                 const std::vector<Tensor<1, 2>> &v)
  {
    double sum = 0.;
    for (const auto &edge : faces)
      sum += area_form(edge, x, v);
    return 2. * .5 * sum;
  }

  template <>
  double enclosed_volume<3>(const std::vector<FaceNodes<3>> &faces, const std::vector<Tensor<1, 3>> &x)
  {
    return flux(faces, x, x) / 3.;
  }

  template <>
  double enclosed_volume_rate<3>(const std::vector<FaceNodes<3>> &faces, const std::vector<Tensor<1, 3>> &x,
                                 const std::vector<Tensor<1, 3>> &v)
  {
    return flux(faces, x, v);
  }

  template <>
  std::vector<double> surface_shares<2>(const SurfaceMesh<2> &surface)
  {
    // Simpson's rule on every edge.
    std::vector<double> share(surface.nodes.size(), 0.);
    double              length = 0.;
    for (const auto &[p, m, q] : surface.faces)
    {
      const double edge = surface.nodes[p].distance(surface.nodes[q]);
      share[p] += edge / 6.;
      share[m] += edge * 4. / 6.;
      share[q] += edge / 6.;
      length += edge;
    }
    for (double &s : share)
      s /= length;
    return share;
  }

  template <>
  std::vector<double> surface_shares<3>(const SurfaceMesh<3> &surface)
  {
    const TriangleRule             &rule = triangle_rule();
    const std::vector<Tensor<1, 3>> x    = vectors(surface.nodes);
    std::vector<double>             share(x.size(), 0.);
    double                          area = 0.;
    for (const auto &face : surface.faces)
      for (unsigned int q = 0; q < rule.n_points(); ++q)
      {
        const double dA = rule.weight(q) * rule.normal(q, face, x).norm();
        area += dA;
        for (unsigned int a = 0; a < 6; ++a)
          share[face[a]] += dA * rule.value(q, a);
      }
    for (double &s : share)
      s /= area;
    return share;
  }
} // namespace swimtwin
