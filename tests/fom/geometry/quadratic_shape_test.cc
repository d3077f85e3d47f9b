#include <fom/geometry/quadratic_shape.h>

#include <deal.II/fe/fe_simplex_p.h>
#include <gtest/gtest.h>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// Of values and of gradients to those of deal.II's element.
    template <int dim>
    double largest_difference(const Point<dim> &reference)
    {
      const FE_SimplexP<dim> element(2);
      const auto             shape = quadratic_shape(reference);
      double                 worst = 0.;
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
        worst = std::max({worst, std::abs(shape.value[a] - element.shape_value(a, reference)),
                          (shape.gradient[a] - element.shape_grad(a, reference)).norm()});
      return worst;
    }
  } // namespace

  TEST(QuadraticShape, IsDealIIsElement)
  {
    for (const double x : {-.2, 0., .3, .55, 1.})
      for (const double y : {-.1, 0., .25, .4})
      {
        EXPECT_LT(largest_difference(Point<2>(x, y)), 1e-14);
        for (const double z : {0., .15, .7})
          EXPECT_LT(largest_difference(Point<3>(x, y, z)), 1e-14);
      }
  }
} // namespace swimtwin
