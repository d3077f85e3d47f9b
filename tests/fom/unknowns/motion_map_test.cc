#include <fom/unknowns/motion_map.h>

#include <tests/fom/random_tensors.h>

#include <deal.II/base/mpi.h>
#include <gtest/gtest.h>

#include <numeric>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    constexpr double length_scale = 0.25;

    Tensor<2, 2> some_rotation(std::integral_constant<int, 2>)
    {
      return RandomNumbers().rotation<2>();
    }
    Tensor<2, 3> some_rotation(std::integral_constant<int, 3>)
    {
      return RandomNumbers().rotation<3>();
    }

    /// Nodes 0-4 of a fluid and 5-8 of a tail: 0 imposed, 1 on the bare head, 2 and 3 tied to tail nodes 5 and 6, 4
    /// free; 5 clamped to the head, 6 and 7 free, 8 in the middle of 5 and 7.
    template <int dim>
    struct SmallMap
    {
      static constexpr unsigned int n_nodes = 9;
      MotionMap<dim>                map{5 * dim, 4 * dim, length_scale};
      RandomNumbers                 random;
      Tensor<1, dim>                X1 = random.vector<dim>(), X5 = random.vector<dim>();
      Tensor<2, dim>                rotation = some_rotation(std::integral_constant<int, dim>());

      static unsigned int row(const unsigned int node, const unsigned int component) { return node * dim + component; }

      explicit SmallMap(const bool head_is_free = true)
      {
        for (unsigned int c = 0; c < dim; ++c)
        {
          map.impose(row(0, c));
          map.tie_to_head(row(1, c), c, X1);
          map.tie(row(2, c), {row(5, c)});
          map.tie(row(3, c), {row(6, c)});
          map.tie_to_head(row(5, c), c, X5);
          map.tie(row(8, c), {row(5, c), row(7, c)});
        }
        map.close(std::vector<unsigned int>(n_nodes * dim, 0), head_is_free, MPI_COMM_WORLD);
        map.set_rotation(rotation);
      }

      std::vector<double> random_vector(const unsigned int n)
      {
        std::vector<double> v(n);
        for (auto &entry : v)
          entry = random();
        return v;
      }
      Tensor<1, dim> at(const std::vector<double> &rows, const unsigned int node) const
      {
        Tensor<1, dim> v;
        for (int c = 0; c < dim; ++c)
          v[c] = rows[row(node, c)];
        return v;
      }
    };

    template <typename Dimension>
    class MotionMapTest : public ::testing::Test
    {
    public:
      static constexpr int dimension = Dimension::value;
    };
    using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
    TYPED_TEST_SUITE(MotionMapTest, Dimensions, );

    constexpr double rounding = 1e-14; // of a few operations on numbers of order one
  }                                    // namespace

  TYPED_TEST(MotionMapTest, NodesOfTheHeadMoveRigidly)
  {
    constexpr int        dim = TestFixture::dimension;
    SmallMap<dim>        small;
    std::vector<double>  unknowns(small.map.n_unknowns(), 0.);
    const Tensor<1, dim> U = small.random.template vector<dim>();
    AngularVelocity<dim> omega;
    const unsigned int   first = small.map.first_head_unknown();
    for (int k = 0; k < n_rotations<dim>; ++k)
    {
      omega[k]                  = small.random();
      unknowns[first + dim + k] = omega[k] * length_scale;
    }
    for (int c = 0; c < dim; ++c)
      unknowns[first + c] = U[c];
    const auto rows     = small.map.expand(unknowns);
    const auto velocity = [&](const Tensor<1, dim> &X) {
      return U + rotational_velocity<dim>(omega, small.rotation * X);
    };
    EXPECT_LE((small.at(rows, 1) - velocity(small.X1)).norm(), rounding);
    EXPECT_LE((small.at(rows, 5) - velocity(small.X5)).norm(), rounding);
    EXPECT_LE((small.at(rows, 2) - velocity(small.X5)).norm(), rounding) << "tied to a clamped node";
    EXPECT_LE((small.at(rows, 8) - .5 * velocity(small.X5)).norm(), rounding)
        << "mean of a clamped node and one at rest";
    EXPECT_EQ(small.at(rows, 4).norm(), 0.);
    for (int k = 0; k < n_rigid<dim>; ++k)
      EXPECT_NEAR(rows[small.map.head_row(k)], k < dim ? U[k] : omega[k - dim], rounding) << "the head's own row";
  }

  // A held head whose motion is given moves its nodes as a free one that has this motion, and a given shape adds to it.
  TYPED_TEST(MotionMapTest, GivenMotionIsThatOfAFreeHeadWithTheSameVelocities)
  {
    constexpr int        dim = TestFixture::dimension;
    SmallMap<dim>        free, held(false);
    const Tensor<1, dim> shape_rate = free.random.template vector<dim>();
    std::vector<double>  unknowns(free.map.n_unknowns(), 0.);
    for (int k = 0; k < n_rigid<dim>; ++k)
    {
      const double value                          = free.random();
      unknowns[free.map.first_head_unknown() + k] = k < dim ? value : value * length_scale;
      held.map.give(held.map.head_row(k), value);
    }
    for (unsigned int c = 0; c < dim; ++c)
      held.map.give(held.row(2, c), shape_rate[c]); // tied to a clamped node
    held.map.set_rotation(held.rotation);
    const auto expected = free.map.expand(unknowns);
    const auto rows     = held.map.expand(std::vector<double>(held.map.n_unknowns(), 0.));
    for (const unsigned int node : {1, 3, 4, 5, 6, 7, 8})
      EXPECT_LE((held.at(rows, node) - free.at(expected, node)).norm(), rounding) << "node " << node;
    EXPECT_LE((held.at(rows, 2) - free.at(expected, 2) - shape_rate).norm(), rounding);
    for (int k = 0; k < n_rigid<dim>; ++k)
      EXPECT_NEAR(rows[held.map.head_row(k)], expected[free.map.head_row(k)], rounding);
  }

  // An image has what it follows, and not that and its own.
  TYPED_TEST(MotionMapTest, AGivenShapeIsNotAddedTwice)
  {
    constexpr int  dim = TestFixture::dimension;
    MotionMap<dim> map(dim, 2 * dim, length_scale);
    const auto     row = SmallMap<dim>::row;
    for (int c = 0; c < dim; ++c)
    {
      map.tie(row(1, c), {map.head_row(c)});
      map.reflect(row(2, c), row(1, c), c == 1 ? -1. : 1.);
    }
    map.close(std::vector<unsigned int>(map.n_rows(), 0), false, MPI_COMM_WORLD);
    for (int c = 0; c < dim; ++c)
    {
      map.give(row(1, c), 3. + c);
      map.give(row(2, c), (c == 1 ? -1. : 1.) * (3. + c));
    }
    map.set_rotation(some_rotation(std::integral_constant<int, dim>()));
    const auto rows = map.expand(std::vector<double>(map.n_unknowns(), 0.));
    for (int c = 0; c < dim; ++c)
    {
      EXPECT_EQ(rows[row(1, c)], 3. + c);
      EXPECT_EQ(rows[row(2, c)], (c == 1 ? -1. : 1.) * (3. + c));
    }
  }

  TYPED_TEST(MotionMapTest, TiedRowsAreTheMeanOfTheirMasters)
  {
    constexpr int dim = TestFixture::dimension;
    SmallMap<dim> small;
    const auto    rows = small.map.expand(small.random_vector(small.map.n_unknowns()));
    EXPECT_EQ((small.at(rows, 3) - small.at(rows, 6)).norm(), 0.);
    EXPECT_LE((small.at(rows, 8) - .5 * (small.at(rows, 5) + small.at(rows, 7))).norm(), rounding);
  }

  TYPED_TEST(MotionMapTest, TurningRowsAddTheHeadsRotationToAnotherRow)
  {
    constexpr int   dim = TestFixture::dimension;
    SmallMap<dim>   small;
    MotionMap<dim> &map = small.map;
    const auto      row = SmallMap<dim>::row;
    const auto      X   = small.random.template vector<dim>();
    for (unsigned int c = 0; c < dim; ++c)
      map.tie_and_turn(row(3, c), row(6, c), c, Tensor<1, dim>());
    map.close(std::vector<unsigned int>(SmallMap<dim>::n_nodes * dim, 0), true, MPI_COMM_WORLD);
    for (unsigned int c = 0; c < dim; ++c)
      map.move_on_head(row(3, c), X);
    map.set_rotation(small.rotation);
    const auto           rows = map.expand(small.random_vector(map.n_unknowns()));
    AngularVelocity<dim> omega;
    for (int k = 0; k < n_rotations<dim>; ++k)
      omega[k] = rows[map.head_row(dim + k)];
    const auto expected = small.at(rows, 6) + rotational_velocity<dim>(omega, small.rotation * X);
    EXPECT_LE((small.at(rows, 3) - expected).norm(), rounding);
    EXPECT_GT(omega.norm(), 0.);
  }

  TYPED_TEST(MotionMapTest, ImposedRowsHaveTheirValue)
  {
    constexpr int dim = TestFixture::dimension;
    SmallMap<dim> small;
    small.map.imposed[SmallMap<dim>::row(0, 1)] = 7.;
    const auto rows                             = small.map.expand(small.random_vector(small.map.n_unknowns()));
    EXPECT_EQ(small.at(rows, 0)[0], 0.);
    EXPECT_EQ(small.at(rows, 0)[1], 7.);
  }

  TYPED_TEST(MotionMapTest, LoadsAreAddedByTheTranspose)
  {
    constexpr int       dim = TestFixture::dimension;
    SmallMap<dim>       small;
    const auto          y = small.random_vector(small.map.n_unknowns()), f = small.random_vector(small.map.n_rows());
    std::vector<double> transposed(y.size(), 0.);
    for (unsigned int row = 0; row < f.size(); ++row)
      small.map.add_load(row, f[row], transposed);
    const auto   Py = small.map.expand(y);
    const double a  = std::inner_product(Py.begin(), Py.end(), f.begin(), 0.),
                 b  = std::inner_product(y.begin(), y.end(), transposed.begin(), 0.);
    EXPECT_NEAR(a, b, 100. * rounding);
  }

  TYPED_TEST(MotionMapTest, FixedHeadHasNoUnknowns)
  {
    constexpr int dim = TestFixture::dimension;
    SmallMap<dim> free, fixed(false);
    EXPECT_EQ(free.map.n_unknowns(), fixed.map.n_unknowns() + n_rigid<dim>);
    const auto rows = fixed.map.expand(fixed.random_vector(fixed.map.n_unknowns()));
    EXPECT_EQ(fixed.at(rows, 1).norm(), 0.);
    EXPECT_EQ(fixed.at(rows, 2).norm(), 0.);
  }

  TYPED_TEST(MotionMapTest, ReflectedRowsFollowTheirOriginalsWithASignAndImposedOnesStay)
  {
    constexpr int   dim = TestFixture::dimension;
    SmallMap<dim>   small;
    MotionMap<dim> &map = small.map;
    const auto      row = SmallMap<dim>::row;
    map.reflect(row(0, 0), row(4, 0), -1.); // imposed before
    map.reflect(row(4, 1), row(6, 1), -1.);
    map.close(std::vector<unsigned int>(SmallMap<dim>::n_nodes * dim, 0), true, MPI_COMM_WORLD);
    map.imposed[row(0, 0)] = 7.;
    const auto rows        = map.expand(small.random_vector(map.n_unknowns()));
    EXPECT_EQ(rows[row(0, 0)], 7.);
    EXPECT_EQ(rows[row(4, 1)], -rows[row(6, 1)]);
    EXPECT_NE(rows[row(4, 1)], 0.);
  }

  TYPED_TEST(MotionMapTest, AHeadOnTheAxisHasOneUnknownAndMovesAlongX)
  {
    constexpr int dim = TestFixture::dimension;
    SmallMap<dim> small;
    const auto    n_unknowns = small.map.n_unknowns();
    small.map.keep_head_to({0});
    small.map.close(std::vector<unsigned int>(SmallMap<dim>::n_nodes * dim, 0), true, MPI_COMM_WORLD);
    EXPECT_EQ(small.map.n_unknowns(), n_unknowns - n_rigid<dim> + 1);
    EXPECT_EQ(small.map.first_head_unknown(), small.map.n_unknowns() - 1);
    const auto y    = small.random_vector(small.map.n_unknowns());
    const auto rows = small.map.expand(y);
    for (const unsigned int node : {1, 2, 5})
      for (int c = 0; c < dim; ++c)
        EXPECT_EQ(small.at(rows, node)[c], c == 0 ? y.back() : 0.);
    for (int k = 0; k < n_rigid<dim>; ++k)
      EXPECT_EQ(rows[small.map.head_row(k)], k == 0 ? y.back() : 0.);
  }
} // namespace swimtwin
