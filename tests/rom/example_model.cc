#include <tests/datasets/example_scenes.h>
#include <tests/rom/example_model.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double start_m = 0.25e-3, length_m = 7.5e-3, half_height_m = 0.3e-3, tail_area_m2 = 4.5e-6;
    constexpr int    n_columns = 17, n_rows = 5; // of nodes; every second one is a vertex

    int node(const int i, const int j)
    {
      return i * n_rows + j;
    }

    /// Two triangles in the quadrilateral with its lower left vertex at (i, j); mirrored in the upper half.
    void add_cells(const int i, const int j, std::vector<std::array<int, 6>> &cells)
    {
      const bool upper = j > 0;
      const int  j0 = upper ? j + 2 : j, j1 = upper ? j : j + 2; // j1 is on the axis
      const int  middle = j + 1;
      cells.push_back(
          {node(i, j0), node(i + 2, j0), node(i + 2, j1), node(i + 1, j0), node(i + 2, middle), node(i + 1, middle)});
      cells.push_back(
          {node(i, j0), node(i + 2, j1), node(i, j1), node(i + 1, middle), node(i + 1, j1), node(i, middle)});
    }

    void make_mesh(ReducedTail &tail)
    {
      tail.nodes_m.resize(n_columns * n_rows, 2);
      for (int i = 0; i < n_columns; ++i)
        for (int j = 0; j < n_rows; ++j)
          tail.nodes_m.row(node(i, j)) << start_m + length_m * i / (n_columns - 1), half_height_m * (j - 2) / 2.;
      std::vector<std::array<int, 6>> cells;
      for (int i = 0; i + 2 < n_columns; i += 2)
        for (int j = 0; j + 2 < n_rows; j += 2)
          add_cells(i, j, cells);
      tail.cells.resize(static_cast<Eigen::Index>(cells.size()), 6);
      for (std::size_t c = 0; c < cells.size(); ++c)
        tail.cells.row(static_cast<Eigen::Index>(c)) = Eigen::Map<const Eigen::RowVectorXi>(cells[c].data(), 6);
      tail.tip_node        = node(n_columns - 1, 2);
      tail.before_tip_node = node(n_columns - 2, 2);
    }

    /// Bending by s^k, or stretching.
    Eigen::Vector2d raw_mode(const int k, const int parity, const double s, const double y)
    {
      const double power = 2. + k;
      return parity > 0 ? Eigen::Vector2d(std::pow(s, power), 0.)
                        : Eigen::Vector2d(-y / length_m * power * std::pow(s, power - 1.), std::pow(s, power));
    }

    void make_modes(ReducedTail &tail, const int r, const int n_followers)
    {
      const Eigen::Index n = tail.nodes_m.rows();
      const int          R = r + n_followers;
      tail.parity          = Eigen::VectorXi::Constant(R, -1);
      if (r > 2)
        tail.parity[2] = 1;
      tail.parity.tail(n_followers).setConstant(1);
      tail.modes.resize(2 * n, R);
      for (int k = 0; k < R; ++k)
      {
        for (Eigen::Index i = 0; i < n; ++i)
          tail.modes.col(k).segment<2>(2 * i) =
              raw_mode(k, tail.parity[k], (tail.nodes_m(i, 0) - start_m) / length_m, tail.nodes_m(i, 1));
        for (int pass = 0; pass < 2; ++pass)
          for (int l = 0; l < k; ++l)
            if (tail.parity[l] == tail.parity[k]) // the others are orthogonal by symmetry
              tail.modes.col(k) -= tail.modes.col(l) * (tail.modes.col(l).dot(tail.modes.col(k)) / n);
        tail.modes.col(k) *= std::sqrt(static_cast<double>(n)) / tail.modes.col(k).norm();
      }
    }

    /// Shortening by a few percent where the tail bends by its scale.
    void make_followers(ReducedTail &tail, const int r, const int n_followers, RandomNumbers &random)
    {
      tail.followers = Eigen::MatrixXd::Zero(n_followers, r * (r + 1) / 2);
      for (int k = 0; k < n_followers; ++k)
        for (int i = 0, product = 0; i < r; ++i)
          for (int j = 0; j <= i; ++j, ++product)
            if (tail.parity[i] == tail.parity[j])
              tail.followers(k, product) = 5. * random();
    }

    /// Symmetric and positive definite; entries between indices of different parity vanish.
    Eigen::MatrixXd random_definite(const Eigen::VectorXi &parity, RandomNumbers &random)
    {
      const Eigen::Index n = parity.size();
      Eigen::MatrixXd    B(n, n);
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
          B(i, j) = random() * (parity[i] == parity[j] ? 1. : 0.);
      return Eigen::MatrixXd::Identity(n, n) + 0.3 * B * B.transpose();
    }

    ReducedElasticity make_elasticity(const Eigen::VectorXi &parity, RandomNumbers &random)
    {
      const int       r = static_cast<int>(parity.size()), n = strain_monomial(r, r, 0);
      Eigen::VectorXi monomial_parity(n);
      Eigen::VectorXd scale(n);
      monomial_parity.head(r) = parity;
      scale.head(r).setConstant(15.);
      for (int i = 0; i < r; ++i)
        for (int j = 0; j <= i; ++j)
        {
          monomial_parity[strain_monomial(r, i, j)] = parity[i] * parity[j];
          scale[strain_monomial(r, i, j)]           = 1. / (length_m * length_m);
        }
      const auto gram = [&] {
        return Eigen::MatrixXd(tail_area_m2 * scale.asDiagonal() * random_definite(monomial_parity, random) *
                               scale.asDiagonal());
      };
      const Eigen::MatrixXd gram_lambda = gram(), gram_mu = gram();
      return {gram_lambda, gram_mu, 0.4};
    }

    /// Local drag on the nodes, twice as large across as along.
    Eigen::MatrixXd resistance_at_rest(const ReducedTail &tail)
    {
      const Eigen::Index n = tail.nodes_m.rows(), r = tail.n_coordinates();
      Eigen::MatrixXd    R = Eigen::MatrixXd::Zero(r + 3, r + 3);
      R.diagonal().head<3>() << 3., 6., 2e-6; // the head
      for (Eigen::Index i = 0; i < n; ++i)
      {
        Eigen::MatrixXd P(2, r + 3);
        P << 1., 0., -tail.nodes_m(i, 1), tail.modes.row(2 * i).head(r), 0., 1., tail.nodes_m(i, 0),
            tail.modes.row(2 * i + 1).head(r);
        R += P.transpose() * Eigen::Vector2d(8., 16.).asDiagonal() * P / static_cast<double>(n);
      }
      Eigen::VectorXi parity(r + 3);
      parity << 1, -1, -1, tail.parity.head(r);
      for (Eigen::Index i = 0; i < r + 3; ++i)
        for (Eigen::Index j = 0; j < r + 3; ++j)
          if (parity[i] != parity[j])
            R(i, j) = 0.; // but for round-off
      return R;
    }

    /// All exponents of total degree 0 to 3.
    Eigen::MatrixXi cubic_exponents(const int n_coordinates)
    {
      std::vector<Eigen::RowVectorXi> rows;
      const auto add = [&](const auto &self, Eigen::RowVectorXi row, const int k, const int left) -> void {
        if (k == n_coordinates)
          return rows.push_back(row);
        for (row[k] = 0; row[k] <= left; ++row[k])
          self(self, row, k + 1, left - row[k]);
      };
      add(add, Eigen::RowVectorXi::Zero(n_coordinates), 0, 3);
      Eigen::MatrixXi exponents(static_cast<Eigen::Index>(rows.size()), n_coordinates);
      for (std::size_t i = 0; i < rows.size(); ++i)
        exponents.row(static_cast<Eigen::Index>(i)) = rows[i];
      return exponents;
    }

    /// So that no polynomial keeps a mirror.
    void set_even(Eigen::VectorXi &coordinates, Eigen::VectorXi &velocities)
    {
      coordinates.setOnes();
      velocities.setOnes();
    }

    int parity_of(const Eigen::RowVectorXi &exponents, const Eigen::VectorXi &parity)
    {
      int product = 1;
      for (Eigen::Index k = 0; k < exponents.size(); ++k)
        if (exponents[k] % 2 != 0)
          product *= parity[k];
      return product;
    }

    ReducedResistance make_resistance(const ReducedTail &tail, const bool depends_on_angle, const bool has_mirror,
                                      RandomNumbers &random)
    {
      const int         r = tail.n_coordinates(), n = r + 3;
      ReducedResistance resistance;
      resistance.factor_at_rest     = resistance_at_rest(tail).llt().matrixL();
      resistance.coordinate_scale_m = Eigen::VectorXd::Constant(r, 1.5e-3);
      resistance.depends_on_angle   = depends_on_angle;
      resistance.angle_scale_rad    = 1.2;
      resistance.exponents          = cubic_exponents(r + (depends_on_angle ? 1 : 0));
      Eigen::VectorXi coordinate_parity(resistance.exponents.cols()), velocity_parity(n);
      coordinate_parity.setConstant(-1);
      coordinate_parity.head(r) = tail.parity.head(r);
      velocity_parity << 1, -1, -1, tail.parity.head(r);
      if (!has_mirror)
        set_even(coordinate_parity, velocity_parity);
      resistance.coefficients = Eigen::MatrixXd::Zero(resistance.exponents.rows(), n * (n + 1) / 2);
      for (Eigen::Index f = 0; f < resistance.exponents.rows(); ++f)
        for (int i = 0; i < n; ++i)
          for (int j = 0; j <= i; ++j)
            if (parity_of(resistance.exponents.row(f), coordinate_parity) == velocity_parity[i] * velocity_parity[j])
            {
              const int degree = resistance.exponents.row(f).sum();
              resistance.coefficients(f, i * (i + 1) / 2 + j) =
                  degree == 0 ? (i == j ? 0.05 : 0.) : 0.2 * random() / (1. + degree * degree);
            }
      return resistance;
    }

    /// Draws numbers of its own, so that models without height are what they were.
    void add_height(const Eigen::VectorXi &parity, ReducedResistance &resistance)
    {
      RandomNumbers      random(11);
      const Eigen::Index n = resistance.exponents.rows(), m = resistance.exponents.cols(),
                         r           = resistance.coordinate_scale_m.size();
      resistance.depends_on_height   = true;
      resistance.height_scale_m      = 2e-3;
      resistance.usual_by_sine_m     = 1e-3 * random();
      resistance.usual_by_coordinate = 0.3 * random.vector(r);
      resistance.usual_by_coordinate = (parity.head(r).array() < 0).select(resistance.usual_by_coordinate, 0.).eval();
      // Every second monomial again, once times the height and another coordinate that is odd, once times its square.
      std::vector<std::pair<Eigen::RowVectorXi, Eigen::RowVectorXd>> more;
      for (Eigen::Index f = 0; f < n; f += 2)
      {
        Eigen::RowVectorXi exponents(m + 1);
        exponents << resistance.exponents.row(f), 1;
        ++exponents[0];
        more.emplace_back(exponents, 0.3 * random() * resistance.coefficients.row(f));
        exponents << resistance.exponents.row(f), 2;
        more.emplace_back(exponents, 0.3 * random() * resistance.coefficients.row(f));
      }
      resistance.exponents.conservativeResize(n + static_cast<Eigen::Index>(more.size()), m + 1);
      resistance.exponents.rightCols<1>().setZero();
      resistance.coefficients.conservativeResize(resistance.exponents.rows(), Eigen::NoChange);
      for (std::size_t k = 0; k < more.size(); ++k)
      {
        resistance.exponents.row(n + static_cast<Eigen::Index>(k))    = more[k].first;
        resistance.coefficients.row(n + static_cast<Eigen::Index>(k)) = more[k].second;
      }
    }

    /// Each odd mode follows one coordinate, and all follow products of them.
    ShapePolynomials bent_amplitudes(const Eigen::VectorXi &parity, const int r, RandomNumbers &random)
    {
      ShapePolynomials bent{Eigen::VectorXd::Constant(r, 1.5e-3), cubic_exponents(r), {}};
      bent.coefficients = Eigen::MatrixXd::Zero(bent.exponents.rows(), parity.size());
      for (Eigen::Index f = 0; f < bent.exponents.rows(); ++f)
        for (Eigen::Index k = 0; k < parity.size(); ++k)
          if (const int degree = bent.exponents.row(f).sum(); degree > 0 && (degree % 2 == 0) == (parity[k] > 0))
            bent.coefficients(f, k) =
                1.5e-3 * (degree == 1 ? double(k < r && bent.exponents(f, k) == 1) : 0.1 * random());
      return bent;
    }

    /// Grows in all directions.
    ShapePolynomials bent_energy(const int r, RandomNumbers &random)
    {
      ShapePolynomials bent{Eigen::VectorXd::Constant(r, 1.5e-3), Eigen::MatrixXi::Zero(2 * r, r),
                            Eigen::MatrixXd::Zero(2 * r, 1)};
      for (int i = 0; i < r; ++i)
      {
        bent.exponents(i, i)     = 2;
        bent.exponents(r + i, i) = 2;
        bent.exponents(r + i, 0) += 2;
        bent.coefficients(i, 0)     = 2e-9 * (1. + 0.3 * random());
        bent.coefficients(r + i, 0) = 2e-10 * (1. + 0.3 * random());
      }
      return bent;
    }

    /// Relaxes in some milliseconds at the density of glycerol; quadratic forces without power.
    InertiaPolynomials inertia_of_material(const ReducedResistance &resistance, const Eigen::MatrixXi &exponents,
                                           const Eigen::VectorXi &coordinate_parity,
                                           const Eigen::VectorXi &velocity_parity, const double factor,
                                           RandomNumbers &random)
    {
      const auto      n = static_cast<int>(velocity_parity.size()), n_pairs = n * (n + 1) / 2;
      const auto     &L = resistance.factor_at_rest;
      Eigen::VectorXd unit(n);
      for (int i = 0; i < n; ++i)
        unit[i] = L.row(i).norm();
      InertiaPolynomials result{std::sqrt(factor) * L, Eigen::MatrixXd::Zero(exponents.rows(), n_pairs),
                                Eigen::MatrixXd::Zero(exponents.rows(), n * n_pairs)};
      for (Eigen::Index f = 0; f < exponents.rows(); ++f)
      {
        const int  parity = parity_of(exponents.row(f), coordinate_parity), degree = exponents.row(f).sum();
        const auto size = 1. / (1. + degree * degree);
        for (int i = 0; i < n; ++i)
          for (int j = 0; j <= i; ++j)
            if (velocity_parity[i] * velocity_parity[j] == parity)
              result.mass(f, i * (i + 1) / 2 + j) = degree == 0 ? (i == j ? 0.02 : 0.) : 0.2 * size * random();
        std::vector<Eigen::MatrixXd> N(static_cast<std::size_t>(n), Eigen::MatrixXd(n, n));
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j)
            for (int k = 0; k <= j; ++k)
              N[i](j, k) = N[i](k, j) = velocity_parity[i] * velocity_parity[j] * velocity_parity[k] == parity
                                            ? 30. * factor * size * random() * unit[i] * unit[j] * unit[k]
                                            : 0.;
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j)
            for (int k = 0; k <= j; ++k)
              result.quadratic(f, i * n_pairs + j * (j + 1) / 2 + k) =
                  (j == k ? 1. : 2.) * (N[i](j, k) - (N[i](j, k) + N[j](k, i) + N[k](i, j)) / 3.);
      }
      return result;
    }

    void add_inertia(ReducedModel &model, const bool has_mirror)
    {
      RandomNumbers         random(17);
      const Eigen::Index    r = model.n_modes(), n_pose = model.resistance.n_pose_coordinates();
      const Eigen::VectorXi parity = model.tail.coordinate_parity();
      Eigen::VectorXi       coordinates(r + n_pose), velocities(r + 3);
      coordinates << parity, Eigen::VectorXi::Constant(n_pose, -1);
      velocities << 1, -1, -1, parity;
      if (!has_mirror)
        set_even(coordinates, velocities);
      auto &inertia     = model.inertia;
      inertia.exponents = cubic_exponents(static_cast<int>(coordinates.size()));
      inertia.fluid = inertia_of_material(model.resistance, inertia.exponents, coordinates, velocities, 6e-6, random);
      inertia.tail  = inertia_of_material(model.resistance, inertia.exponents, coordinates, velocities, 1e-6, random);
      inertia.head_area_m2          = model.magnet.head_area_m2;
      inertia.head_second_moment_m4 = 2e-13;
    }

    void bend(ReducedModel &model, const int r)
    {
      RandomNumbers random(13);
      model.tail.amplitudes = bent_amplitudes(model.tail.parity, r, random);
      model.elasticity      = {{}, {}, 0.4, bent_energy(r, random)};
    }

    ReducedArea make_area(const Eigen::VectorXi &parity, const bool is_kept, RandomNumbers &random)
    {
      const Eigen::Index r = parity.size();
      ReducedArea        area{is_kept, Eigen::VectorXd::Zero(r), Eigen::MatrixXd::Zero(r, r)};
      for (Eigen::Index i = 0; i < r; ++i)
      {
        area.linear_m[i] = parity[i] > 0 ? 1e-3 : 0.;
        for (Eigen::Index j = 0; j <= i; ++j)
          area.quadratic(i, j) = area.quadratic(j, i) = parity[i] == parity[j] ? 0.2 * random() : 0.;
      }
      return area;
    }

    TrainedRange make_range()
    {
      return {{4e4, 3e5}, {1.52, 1.52}, {5e4, 2e5}, {0.1, 3.}, {5e-3, 5e-3}, {5e-3, 5e-3}};
    }

    TrainingRecord make_record()
    {
      TrainingRecord record;
      record.singular_values_m    = Eigen::Vector4d(1e-3, 1e-4, 1e-5, 1e-6);
      record.energy_captured      = 0.9999;
      record.n_snapshots          = 300;
      record.n_resistance_samples = 200;
      record.n_held_out_samples   = 20;
      record.velocity_error_rms   = 2e-3;
      record.velocity_error_max   = 8e-3;
      record.largest_condition    = 25.;
      record.cpu_time_s           = 600.;
      record.held_out_runs        = {{1e5, 1.52, 1e5, 0.8, 5e-3, 5e-3, 7e-5, 1e-7, 7.02e-5, 3e-7}};
      record.neglects = {"Inertia of fluid and solid: unsteady group up to 1.0.", "The walls' dependence on x."};
      return record;
    }
  } // namespace

  ReducedModel example_model(const ExampleOptions &options)
  {
    RandomNumbers random(7);
    ReducedModel  model;
    make_mesh(model.tail);
    make_modes(model.tail, options.n_modes, options.n_followers);
    make_followers(model.tail, options.n_modes, options.n_followers, random);
    model.elasticity                 = make_elasticity(model.tail.parity, random);
    model.magnet.head_area_m2        = 0.75e-6;
    model.magnet.tail_area_m2        = options.magnetic_tail ? Eigen::Vector2d(4.5e-6, 0.) : Eigen::Vector2d::Zero();
    model.magnet.tail_area_of_mode_m = Eigen::MatrixXd::Zero(2, model.tail.n_amplitudes());
    for (int k = 0; k < model.tail.n_amplitudes() && options.magnetic_tail; ++k)
      model.magnet.tail_area_of_mode_m(model.tail.parity[k] > 0 ? 0 : 1, k) = 1e-3 * random();
    model.area       = make_area(model.tail.parity, options.keeps_area, random);
    model.resistance = make_resistance(model.tail, options.depends_on_angle, options.has_mirror, random);
    if (options.depends_on_height)
      add_height(model.tail.parity, model.resistance);
    if (options.is_bent)
      bend(model, options.n_modes);
    if (options.has_inertia)
      add_inertia(model, options.has_mirror);
    model.range      = make_range();
    model.record     = make_record();
    model.scene_name = "example";
    model.scene_text = swimmer_toml;
    if (!options.has_inertia)
      model.scene_text = parse_scene(swimmer_toml, model.scene_name, {"fluid.inertia=none"}).text;
    return model;
  }

  InertialDensities example_densities(const ExampleOptions &options)
  {
    return options.has_inertia ? InertialDensities{1260., 1300., 7000.} : InertialDensities{};
  }

  Eigen::VectorXd random_shape(const ReducedModel &model, RandomNumbers &random, const double largest_radius)
  {
    const Eigen::VectorXd direction = random.vector(model.n_modes());
    const double          radius    = 0.5 * (1. + random()) * largest_radius;
    return radius / direction.norm() * direction.cwiseProduct(model.resistance.coordinate_scale_m);
  }

  RunRequest example_request(const ReducedModel &model)
  {
    RunRequest request;
    request.parameters         = {1e5, 1.52, 1e5, 0.};
    request.drive.field        = std::make_shared<SinusoidalField>();
    request.drive.parameters   = Eigen::Vector2d(5e-3, 5e-3);
    request.drive.frequency_Hz = 0.8;
    request.initial_state      = SwimmerState::Zero(model.n_modes() + 3);
    return request;
  }
} // namespace swimtwin
