#include <rom/training/bent_tail.h>

#include <datasets/system/error.h>
#include <rom/swimmer/dense_algebra.h>
#include <rom/training/load_response.h>
#include <rom/training/monomial_features.h>
#include <rom/training/pod.h>
#include <rom/training/relaxed_tail.h>
#include <rom/training/sampled_shapes.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr int    n_along_runs = 90, n_filling = 60, n_on_the_way = 5;
    constexpr double beyond_runs      = 1.2; ///< polynomials must not turn round where runs may come
    constexpr double smallest_mode    = 1e-5;
    constexpr int    max_modes_a_part = max_amplitudes / 2;

    std::vector<ShapePoint> points_of(const Eigen::MatrixXd &seen)
    {
      std::vector<ShapePoint> points;
      for (const auto q : seen.colwise())
        points.push_back({q, 0., 0., 0.});
      return points;
    }

    /// Twice as many for every coordinate beyond four: so fast the monomials grow.
    int n_shapes(const int for_four, const Eigen::Index r)
    {
      return for_four << std::max<Eigen::Index>(0, r - 4);
    }

    std::vector<Eigen::VectorXd> goals(const Eigen::MatrixXd &seen, const SampledRegion &region)
    {
      const Eigen::Index           r = seen.rows();
      const ShapePoint             rest{Eigen::VectorXd::Zero(seen.rows()), 0., 0., 0.};
      std::vector<Eigen::VectorXd> q;
      for (const auto &point :
           spread_out(points_of(seen), {rest}, region, Eigen::VectorXd::Ones(r), n_shapes(n_along_runs, r)))
        q.push_back(beyond_runs * point.q);
      for (const auto &point : filling_points(region, rest, n_shapes(n_filling, r)))
        q.push_back(beyond_runs * point.q);
      for (const auto &point : axis_points(region, rest))
        if (point.q.norm() > 0.)
          q.push_back(point.q);
      return q;
    }

    /// A matrix with few rows below that keep coefficients small where data do not tell them.
    Eigen::MatrixXd least_squares(const Eigen::MatrixXd &A, const Eigen::MatrixXd &data)
    {
      constexpr double ridge = 1e-7;
      Eigen::MatrixXd  rows(A.rows() + A.cols(), A.cols());
      Eigen::MatrixXd  right = Eigen::MatrixXd::Zero(A.rows() + A.cols(), data.cols());
      rows << A, ridge * std::sqrt(static_cast<double>(A.rows())) * Eigen::MatrixXd::Identity(A.cols(), A.cols());
      right.topRows(A.rows()) = data;
      return solve_by_plain_qr(rows, right);
    }

    Eigen::MatrixXi without_constant(const Eigen::MatrixXi &exponents, const int odd)
    {
      std::vector<int> rows;
      for (const int row : of_parity(exponents, odd))
        if (exponents.row(row).sum() > 0)
          rows.push_back(row);
      return exponents(rows, Eigen::all);
    }

    Eigen::VectorXd numbers_of(const RelaxedShape &shape)
    {
      Eigen::VectorXd numbers(shape.q.size() + shape.slope_m.size() + 1 + shape.displacement.size());
      numbers << shape.q, shape.slope_m, shape.energy_m2, shape.displacement;
      return numbers;
    }

    RelaxedShape shape_of(const Eigen::VectorXd &numbers, const Eigen::Index r)
    {
      return {numbers.head(r), numbers.tail(numbers.size() - 2 * r - 1), numbers[2 * r], numbers.segment(r, r)};
    }

    /// The ways are shared out over ranks; every rank gets all shapes, in the order of the ends.
    template <int dim>
    std::vector<RelaxedShape> relaxed_on_the_ways(RelaxedTail<dim> &tail, const std::vector<Eigen::VectorXd> &ends,
                                                  const MPI_Comm                       communicator,
                                                  const std::function<void(int, int)> &on_progress)
    {
      int rank, n_ranks;
      MPI_Comm_rank(communicator, &rank);
      MPI_Comm_size(communicator, &n_ranks);
      std::vector<std::vector<RelaxedShape>> ways(ends.size());
      for (std::size_t k = rank; k < ends.size(); k += n_ranks)
      {
        ways[k] = tail.on_the_way_to(ends[k], n_on_the_way);
        if (on_progress)
          on_progress(static_cast<int>(k) + 1, static_cast<int>(ends.size()));
      }
      std::vector<RelaxedShape> relaxed;
      for (std::size_t k = 0; k < ends.size(); ++k)
      {
        const int owner = static_cast<int>(k) % n_ranks;
        int       count = static_cast<int>(ways[k].size());
        MPI_Bcast(&count, 1, MPI_INT, owner, communicator);
        for (int i = 0; i < count; ++i)
        {
          Eigen::VectorXd numbers = rank == owner ? numbers_of(ways[k][i]) : Eigen::VectorXd();
          int             size    = static_cast<int>(numbers.size());
          MPI_Bcast(&size, 1, MPI_INT, owner, communicator);
          numbers.resize(size);
          MPI_Bcast(numbers.data(), size, MPI_DOUBLE, owner, communicator);
          relaxed.push_back(shape_of(numbers, ends[k].size()));
        }
      }
      return relaxed;
    }

    struct Shapes
    {
      Eigen::MatrixXd z;             ///< scaled coordinates, one row each
      Eigen::MatrixXd displacements; ///< one column each
      Eigen::MatrixXd slopes;        ///< of the energy by z, one row each
    };

    Shapes table_of(const std::vector<RelaxedShape> &relaxed, const Eigen::VectorXd &scale)
    {
      const auto m = static_cast<Eigen::Index>(relaxed.size());
      Shapes     shapes{Eigen::MatrixXd(m, scale.size()), Eigen::MatrixXd(relaxed.front().displacement.size(), m),
                    Eigen::MatrixXd(m, scale.size())};
      for (Eigen::Index k = 0; k < m; ++k)
      {
        shapes.z.row(k)             = relaxed[k].q.cwiseQuotient(scale).transpose();
        shapes.displacements.col(k) = relaxed[k].displacement;
        shapes.slopes.row(k)        = relaxed[k].slope_m.cwiseProduct(scale).transpose();
      }
      return shapes;
    }

    Eigen::MatrixXd modes_of(const Eigen::MatrixXd &fields, const TailSpace &space, const MPI_Comm communicator,
                             const double smallest)
    {
      PodBuilder builder(space.mean_product, communicator);
      builder.add(fields);
      const Pod    pod = builder.compute(max_modes_a_part);
      Eigen::Index n   = 0;
      while (n < pod.modes.cols() && pod.singular_values(n) > smallest)
        ++n;
      return pod.modes.leftCols(n);
    }

    void fit_shapes(const Shapes &shapes, const Eigen::MatrixXi &exponents, const TailSpace &space,
                    const MPI_Comm communicator, BentTail &bent)
    {
      const Eigen::MatrixXd mirror = space.mirrored(shapes.displacements);
      const double size = std::sqrt(shapes.displacements.cwiseProduct(space.mean_product * shapes.displacements).sum());
      const Eigen::MatrixXd odd =
          modes_of((shapes.displacements - mirror) / 2., space, communicator, smallest_mode * size);
      const Eigen::MatrixXd even =
          modes_of((shapes.displacements + mirror) / 2., space, communicator, smallest_mode * size);
      bent.modes.resize(odd.rows(), odd.cols() + even.cols());
      bent.modes << (odd - space.mirrored(odd)) / 2., (even + space.mirrored(even)) / 2.;
      bent.modes = space.kept_to_plane(bent.modes);
      bent.parity.resize(bent.modes.cols());
      bent.parity << Eigen::VectorXi::Constant(odd.cols(), -1), Eigen::VectorXi::Constant(even.cols(), 1);

      // On meshes without a mirror, modes of different parity are not quite orthogonal.
      const Eigen::MatrixXd gram = space.amplitudes(bent.modes, bent.modes);
      const Eigen::MatrixXd data =
          solve_by_lu<Eigen::MatrixXd>(gram, space.amplitudes(bent.modes, shapes.displacements)).transpose();
      const Eigen::MatrixXi e_odd = without_constant(exponents, 1), e_even = without_constant(exponents, 0);
      bent.amplitudes.exponents.resize(e_odd.rows() + e_even.rows(), exponents.cols());
      bent.amplitudes.exponents << e_odd, e_even;
      bent.amplitudes.coefficients = Eigen::MatrixXd::Zero(bent.amplitudes.exponents.rows(), bent.modes.cols());
      bent.amplitudes.coefficients.topLeftCorner(e_odd.rows(), odd.cols()) =
          least_squares(design(e_odd, shapes.z), data.leftCols(odd.cols()));
      bent.amplitudes.coefficients.bottomRightCorner(e_even.rows(), even.cols()) =
          least_squares(design(e_even, shapes.z), data.rightCols(even.cols()));
      const Eigen::MatrixXd left =
          shapes.displacements -
          bent.modes * (design(bent.amplitudes.exponents, shapes.z) * bent.amplitudes.coefficients).transpose();
      bent.shape_error = std::sqrt(left.cwiseProduct(space.mean_product * left).sum()) / size;
    }

    /// Derivatives of the monomials by z_k, one row per shape.
    Eigen::MatrixXd slope_design(const Eigen::MatrixXi &exponents, const Eigen::MatrixXd &z, const Eigen::Index k)
    {
      Eigen::MatrixXi lower = exponents;
      lower.col(k)          = (exponents.col(k).array() - 1).max(0);
      return design(lower, z) * exponents.col(k).cast<double>().asDiagonal();
    }

    /// To the multipliers, which are the energy's derivatives; small bends count by their own size.
    void fit_energy(const Shapes &shapes, const Eigen::MatrixXi &exponents, BentTail &bent)
    {
      const Eigen::Index m = shapes.z.rows(), r = shapes.z.cols();
      bent.energy.exponents        = without_constant(exponents, 0);
      const Eigen::VectorXd weight = (shapes.z.rowwise().norm().array() + .1).inverse();
      Eigen::MatrixXd       A(m * r, bent.energy.exponents.rows()), data(m * r, 1);
      for (Eigen::Index k = 0; k < r; ++k)
      {
        A.middleRows(k * m, m)    = weight.asDiagonal() * slope_design(bent.energy.exponents, shapes.z, k);
        data.middleRows(k * m, m) = weight.asDiagonal() * shapes.slopes.col(k);
      }
      const double size        = std::sqrt(data.squaredNorm() / static_cast<double>(m * r));
      bent.energy.coefficients = size * least_squares(A, data / size);
      bent.moment_error        = (A * bent.energy.coefficients - data).norm() / data.norm();
    }
    void fit_polynomials(const std::vector<RelaxedShape> &relaxed, const TailSpace &space, const MPI_Comm communicator,
                         BentTail &bent)
    {
      const Eigen::VectorXd &scale  = bent.amplitudes.scale_m;
      const Shapes           shapes = table_of(relaxed, scale);
      const auto             m      = shapes.z.rows();
      // Angles enter by their sines and cosines: a power is worth an angle, over its factorial.
      const Eigen::VectorXd effects = (.5 * scale / bent.coordinates.length_m()).cwiseMin(.7).cwiseMax(.02);
      fit_shapes(shapes, feature_sets(effects, m).back(), space, communicator, bent);
      fit_energy(shapes, feature_sets(effects, 2 * m).back(), bent);
      bent.polynomials = CoordinatePolynomials(bent.amplitudes, Eigen::VectorXi::Constant(scale.size(), -1));
    }

    void add_response(const LoadResponse &response, std::vector<RelaxedShape> &shapes)
    {
      for (RelaxedShape &shape : shapes)
      {
        const Eigen::VectorXd moment = response.stiffness * shape.q;
        shape.displacement += response.fields * shape.q;
        shape.energy_m2 += .5 * shape.q.dot(moment);
        shape.slope_m += moment;
      }
    }

    /// Over fields (columns) and the tail.
    double mean_square(const Eigen::MatrixXd &fields, const TailSpace &space)
    {
      return fields.cwiseProduct(space.mean_product * fields).sum() / static_cast<double>(fields.cols());
    }
  } // namespace

  template <int dim>
  BentTail fit_bent_tail(const Swimmer<dim> &swimmer, const TailSpace &space, const BendingCoordinates &coordinates,
                         const Eigen::MatrixXd &seen, const Eigen::MatrixXd &displacements, const MPI_Comm communicator,
                         const std::function<void(int, int)> &on_progress)
  {
    const SampledRegion       region = region_around(points_of(seen), 1.);
    RelaxedTail<dim>          tail(swimmer, coordinates);
    const auto                ends    = goals(seen, region);
    std::vector<RelaxedShape> relaxed = relaxed_on_the_ways(tail, ends, communicator, on_progress);
    if (2 * relaxed.size() < n_on_the_way * ends.size())
      throw ComputationError("more than half of the tail's shapes of least energy could not be computed: narrow the "
                             "range (a stiffer tail, a weaker field) or lower --modes");

    BentTail bent{
        coordinates,
        {},
        {},
        {},
        {},
        {{Eigen::VectorXd::Ones(seen.rows()), Eigen::MatrixXi::Zero(1, seen.rows()), Eigen::MatrixXd::Zero(1, 1)},
         Eigen::VectorXi::Constant(seen.rows(), -1)}};
    bent.n_shapes           = static_cast<int>(relaxed.size());
    bent.amplitudes.scale_m = bent.energy.scale_m = region.coordinate_scale_m;
    fit_polynomials(relaxed, space, communicator, bent);
    if (displacements.cols() == 0)
      return bent;
    add_response(fit_load_response(swimmer, space, bent, displacements, seen), relaxed);
    fit_polynomials(relaxed, space, communicator, bent);
    return bent;
  }

  template BentTail fit_bent_tail<2>(const Swimmer<2> &, const TailSpace &, const BendingCoordinates &,
                                     const Eigen::MatrixXd &, const Eigen::MatrixXd &, MPI_Comm,
                                     const std::function<void(int, int)> &);
  template BentTail fit_bent_tail<3>(const Swimmer<3> &, const TailSpace &, const BendingCoordinates &,
                                     const Eigen::MatrixXd &, const Eigen::MatrixXd &, MPI_Comm,
                                     const std::function<void(int, int)> &);

  double left_by(const TailBasis &basis, const Eigen::MatrixXd &displacements, const TailSpace &space)
  {
    const Eigen::MatrixXd q    = basis.coordinates_of(space, displacements);
    Eigen::MatrixXd       left = displacements;
    for (Eigen::Index k = 0; k < left.cols(); ++k)
      left.col(k) -= basis.displacement(q.col(k));
    return std::sqrt(mean_square(left, space));
  }

  void record_representation(const Eigen::MatrixXd &displacements, const TailSpace &space, TailBasis &basis)
  {
    basis.projection_error_m = left_by(basis, displacements, space);
    basis.energy_captured    = 1. - std::pow(basis.projection_error_m, 2) / mean_square(displacements, space);
  }
} // namespace swimtwin
