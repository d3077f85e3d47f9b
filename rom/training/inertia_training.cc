#include <rom/training/inertia_training.h>

#include <datasets/reduced/held_out_error.h>
#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/scene/mirror_plane.h>
#include <datasets/system/error.h>
#include <rom/swimmer/carried_inertia.h>
#include <rom/swimmer/dense_algebra.h>
#include <rom/training/economy.h>
#include <rom/training/explored_shapes.h>
#include <rom/training/factor_entries.h>
#include <rom/training/monomial_features.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    SampledRegion region_of(const ReducedResistance &resistance, const bool has_mirror)
    {
      return {resistance.coordinate_scale_m, resistance.depends_on_angle, resistance.angle_scale_rad,
              resistance.depends_on_height,  resistance.height_scale_m,   has_mirror};
    }

    std::vector<ShapePoint> points_to_sample(const std::vector<ExploredPoint> &seen, const SampledRegion &region,
                                             const ShapePoint &rest, const int n)
    {
      constexpr double        nearer = .3;
      std::vector<ShapePoint> points = axis_points(region, rest);
      const auto              along =
          spread_out(shapes_of(seen), points, region, Eigen::VectorXd::Ones(region.n_variables()), n / 3);
      points.insert(points.end(), along.begin(), along.end());
      for (auto point : along) // what small strokes do is told by slopes at rest
      {
        point.q *= nearer;
        point.angle_rad *= nearer;
        point.drift_y_m *= nearer;
        points.push_back(point);
      }
      for (const auto &point : filling_points(region, rest, n / 3))
        points.push_back(point);
      return points;
    }

    /// What each entry of quadratic forces, in units in which L L^T is the identity, is worth: the power per value at
    /// the swimmer's own velocities (root mean square).
    Eigen::VectorXd usual_powers(const std::vector<ExploredPoint> &seen, const Eigen::MatrixXd &L)
    {
      const Eigen::Index n       = L.rows();
      Eigen::ArrayXd     squares = Eigen::ArrayXd::Zero(n);
      for (const ExploredPoint &point : seen)
        squares += (L.transpose() * point.velocity).array().square();
      const Eigen::ArrayXd velocity = (squares / static_cast<double>(seen.size())).sqrt();
      Eigen::VectorXd      powers(n * n * (n + 1) / 2);
      for (Eigen::Index i = 0, column = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
          for (Eigen::Index k = 0; k <= j; ++k)
            powers(column++) = velocity(i) * velocity(j) * velocity(k);
      return powers;
    }

    /// Samples as a table: a row of values each, the entries of M's factor first, and for each column whether it is
    /// odd; empty where no mirror tells parities.
    struct InertiaTable
    {
      Eigen::MatrixXd   z, values;
      Eigen::VectorXd   weight;
      std::vector<char> is_odd;
      Eigen::Index      n_mass = 0; ///< columns of the factor

      InertiaTable rows(const std::vector<int> &which) const
      {
        return {z(which, Eigen::all), values(which, Eigen::all), weight(which), is_odd, n_mass};
      }
    };

    /// Forces N_i (rows; coefficients of xi_j xi_k, k <= j) in other units: those in which L L^T is the identity.
    Eigen::MatrixXd in_units_of(const Eigen::MatrixXd &L, const Eigen::MatrixXd &quadratic)
    {
      const Eigen::Index n = L.rows();
      Eigen::MatrixXd    forms(n * n, n); // column i: N_i in new velocities
      for (Eigen::Index i = 0; i < n; ++i)
      {
        Eigen::MatrixXd N(n, n);
        for (Eigen::Index j = 0, pair = 0; j < n; ++j)
          for (Eigen::Index k = 0; k <= j; ++k, ++pair)
            N(j, k) = N(k, j) = (j == k ? 1. : .5) * quadratic(i, pair);
        forms.col(i) = seen_from(L, N).reshaped();
      }
      forms = solve_lower<Eigen::MatrixXd>(L, forms.transpose()).transpose().eval();
      Eigen::MatrixXd scaled(n, n * (n + 1) / 2);
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0, pair = 0; j < n; ++j)
          for (Eigen::Index k = 0; k <= j; ++k, ++pair)
            scaled(i, pair) = (j == k ? 1. : 2.) * forms(j * n + k, i);
      return scaled;
    }

    Eigen::VectorXd by_rows(const Eigen::MatrixXd &A)
    {
      return Eigen::MatrixXd(A.transpose()).reshaped();
    }

    InertiaTable table_of(const InertiaSamples &samples, const std::vector<InertiaSample> &material,
                          const SampledRegion &region, const Eigen::MatrixXd &L)
    {
      const Eigen::MatrixXd L_mass = factor_at_rest(material.front().mass, region.has_mirror);
      const auto            m      = static_cast<Eigen::Index>(samples.points.size());
      const Eigen::Index    n = L.rows(), n_pairs = n * (n + 1) / 2;
      InertiaTable          table{Eigen::MatrixXd(m, region.n_variables()),
                         Eigen::MatrixXd(m, (1 + n) * n_pairs),
                         Eigen::VectorXd(m),
                         {},
                         n_pairs};
      for (Eigen::Index k = 0; k < m; ++k)
      {
        const auto at   = static_cast<std::size_t>(k);
        table.z.row(k)  = region.variables(samples.points[at]).transpose();
        table.weight(k) = samples.points[at].weight / (.2 + table.z.row(k).norm()); // near ones by their own size
        table.values.row(k) << factor_entries(L_mass, material[at].mass).transpose(),
            by_rows(in_units_of(L, material[at].quadratic)).transpose();
      }
      for (int i = -1; i < n && region.has_mirror; ++i)
        for (int j = 0; j < n; ++j)
          for (int k = 0; k <= j; ++k)
            table.is_odd.push_back((i < 0 ? 1 : velocity_parity(i)) * velocity_parity(j) * velocity_parity(k) < 0);
      return table;
    }

    Eigen::MatrixXd fit(const Eigen::MatrixXi &exponents, const InertiaTable &table)
    {
      const Eigen::MatrixXd A            = table.weight.asDiagonal() * design(exponents, table.z);
      Eigen::MatrixXd       c            = Eigen::MatrixXd::Zero(exponents.rows(), table.values.cols());
      const auto            fit_together = [&](const std::vector<int> &features, const std::vector<int> &columns) {
        const Eigen::MatrixXd rows = with_ridge(A(Eigen::all, features), table.weight);
        Eigen::MatrixXd       data = Eigen::MatrixXd::Zero(rows.rows(), static_cast<Eigen::Index>(columns.size()));
        data.topRows(A.rows()) = table.weight.asDiagonal() * table.values(Eigen::all, columns);
        c(features, columns)   = solve_by_plain_qr(rows, data);
      };
      if (table.is_odd.empty())
        fit_together(counted(exponents.rows()), counted(table.values.cols()));
      for (int odd = 0; odd < 2 && !table.is_odd.empty(); ++odd)
      {
        std::vector<int> columns;
        for (int k = 0; k < static_cast<int>(table.is_odd.size()); ++k)
          if (table.is_odd[static_cast<std::size_t>(k)] == odd)
            columns.push_back(k);
        fit_together(of_parity(exponents, odd), columns);
      }
      return c;
    }

    struct InertiaFitQuality
    {
      double mass = 0., quadratic = 0.; ///< root mean square over held-back samples, relative: of M's factor, of power

      double worse() const { return std::max(mass, quadratic); }
    };

    InertiaFitQuality cross_validate(const Eigen::MatrixXi &exponents, const InertiaTable &table,
                                     const Eigen::VectorXd &power)
    {
      Eigen::VectorXd off = Eigen::VectorXd::Zero(2), all = off;
      for (const auto &[kept, held] : five_folds(table.z.rows()))
      {
        const InertiaTable    test = table.rows(held);
        const Eigen::MatrixXd wrong =
            test.weight.asDiagonal() * (design(exponents, test.z) * fit(exponents, table.rows(kept)) - test.values);
        const Eigen::MatrixXd truth    = test.weight.asDiagonal() * test.values;
        const auto            in_power = [&power](const Eigen::MatrixXd &values) {
          return (values.rightCols(power.size()) * power.asDiagonal()).squaredNorm();
        };
        off += Eigen::Vector2d(wrong.leftCols(table.n_mass).squaredNorm(), in_power(wrong));
        all += Eigen::Vector2d(test.weight.squaredNorm(), in_power(truth));
      }
      return {std::sqrt(off(0) / all(0)), all(1) > 0. ? std::sqrt(off(1) / all(1)) : 0.};
    }

    InertiaPolynomials polynomials_of(const Eigen::MatrixXi &exponents, const InertiaTable &table,
                                      const Eigen::MatrixXd &mass_at_rest, const Eigen::MatrixXd &L,
                                      const bool has_mirror)
    {
      const Eigen::MatrixXd c = fit(exponents, table);
      const Eigen::Index    n = L.rows(), n_pairs = n * (n + 1) / 2;
      const Eigen::MatrixXd out_of_L = solve_lower<Eigen::MatrixXd>(L, Eigen::MatrixXd::Identity(n, n));
      InertiaPolynomials    result{factor_at_rest(mass_at_rest, has_mirror), c.leftCols(n_pairs),
                                Eigen::MatrixXd(c.rows(), n * n_pairs)};
      for (Eigen::Index f = 0; f < c.rows(); ++f) // a row of coefficients is linear in the samples like a sample
      {
        const Eigen::VectorXd row = c.row(f).tail(n * n_pairs).transpose();
        result.quadratic.row(f)   = by_rows(in_units_of(out_of_L, row.reshaped(n_pairs, n).transpose())).transpose();
      }
      return result;
    }

    struct ChosenFeatures
    {
      Eigen::MatrixXi   exponents;
      InertiaFitQuality quality;
    };

    /// The smallest set that is nearly as good as the best, or moves the swimmer like it. `ways`: with a set's inertia.
    ChosenFeatures choose_features(const std::vector<Eigen::MatrixXi> &sets, const InertiaTable &table,
                                   const Eigen::VectorXd &power, const double target,
                                   const std::function<Eigen::Matrix2Xd(const Eigen::MatrixXi &)> &ways)
    {
      std::vector<InertiaFitQuality> qualities;
      for (const auto &set : sets)
        qualities.push_back(cross_validate(set, table, power));
      const auto best = static_cast<std::size_t>(
          std::min_element(qualities.begin(), qualities.end(),
                           [](const auto &a, const auto &b) { return a.worse() < b.worse(); }) -
          qualities.begin());
      const Eigen::Matrix2Xd best_ways = ways(sets[best]);
      std::size_t            chosen    = 0;
      const auto             will_do   = [&](const std::size_t k) {
        const double worse = qualities[k].worse() / qualities[best].worse();
        return worse <= nearly_as_good || (worse <= no_rival && are_alike(ways(sets[k]), best_ways, target));
      };
      while (chosen < best && !will_do(chosen))
        ++chosen;
      return {sets[chosen], qualities[chosen]};
    }
  } // namespace

  TrainedInertia train_inertia(const ReducedModel &model, const Scene &scene, const int n_samples,
                               const MPI_Comm communicator, const std::function<void(int, int)> &on_progress)
  {
    const SampledRegion          region = region_of(model.resistance, domain_is_mirrored(scene));
    const ShapePoint             rest{Eigen::VectorXd::Zero(model.n_modes()), 0., 0., 0.};
    const auto                   seen    = explore(model, scene, spread_members(model.range, 40, 400), rest);
    const auto                   points  = points_to_sample(seen, region, rest, n_samples);
    const InertiaSamples         samples = scene.dimension == 3
                                               ? sample_inertia<3>(model, scene, points, communicator, on_progress)
                                               : sample_inertia<2>(model, scene, points, communicator, on_progress);
    const Eigen::MatrixXd       &L       = model.resistance.factor_at_rest;
    std::vector<Eigen::MatrixXd> edge;
    for (int k = 1; k <= region.n_variables(); ++k)
      edge.push_back(samples.fluid.at(static_cast<std::size_t>(k)).mass);
    const Eigen::VectorXd effects = variable_effects(samples.fluid.front().mass, edge, region.has_mirror);
    const InertiaTable    fluid   = table_of(samples, samples.fluid, region, L),
                       tail       = table_of(samples, samples.tail, region, L);
    const auto inertia_of         = [&](const Eigen::MatrixXi &exponents) {
      return ReducedInertia{exponents,
                            polynomials_of(exponents, fluid, samples.fluid.front().mass, L, region.has_mirror),
                            polynomials_of(exponents, tail, samples.tail.front().mass, L, region.has_mirror),
                            scene.head.volume(scene.dimension), scene.head.second_moment(scene.dimension)};
    };
    const InertialDensities densities = inertial_densities(scene, all_inertia);
    const auto              ways      = [&](const Eigen::MatrixXi &exponents) {
      ReducedModel carried = model;
      carried.inertia      = inertia_of(exponents);
      return third_ways(carried, scene, densities);
    };
    const auto [exponents, quality] = choose_features(feature_sets(effects, fluid.z.rows(), region.has_mirror), fluid,
                                                      usual_powers(seen, L), target_of(model.record), ways);

    TrainedInertia result;
    result.n_samples       = static_cast<int>(samples.points.size());
    result.mass_error      = quality.mass;
    result.quadratic_error = quality.quadratic;
    result.power_defect    = samples.largest_power_defect;
    result.inertia         = inertia_of(exponents);
    return result;
  }

  namespace
  {
    /// Where inertia matters most in the model's range.
    InertiaShares largest_shares(const Scene &scene, const TrainedRange &range)
    {
      return inertia_shares(scene, range.frequency_Hz.high, range.viscosity_Pa_s.low, range.young_modulus_Pa.high);
    }

    /// Up to which frequency displacements with inertia are given, with the stiffest tail in the thinnest fluid.
    double highest_frequency_with_inertia_Hz(const Scene &scene, const TrainedRange &range)
    {
      double     low = range.frequency_Hz.low, high = range.frequency_Hz.high;
      const auto is_given = [&](const double frequency_Hz) {
        return InertialExtreme{frequency_Hz, range.viscosity_Pa_s.low, range.young_modulus_Pa.high}.error_if_carried(
                   scene) <= largest_inertial_error;
      };
      if (is_given(high))
        return high;
      for (int halving = 0; halving < 30; ++halving)
        (is_given(std::sqrt(low * high)) ? low : high) = std::sqrt(low * high);
      return low;
    }
  } // namespace

  void add_inertia(ReducedModel &model, const Scene &scene, const MPI_Comm communicator,
                   const std::function<void(int, int)> &on_progress)
  {
    const int share     = domain_is_mirrored(scene) ? 4 : 2; // twice as many coefficients of each without a mirror
    const int n_samples = std::clamp(model.record.n_resistance_samples / share, 40, 400);
    if (inertia_terms(scene, largest_shares(scene, model.range)).any())
      model.inertia = train_inertia(model, scene, n_samples, communicator, on_progress).inertia;
  }

  std::string neglected_inertia(const ReducedModel &model, const Scene &scene)
  {
    const TrainedRange &range = model.range;
    const double        group = unsteady_group(scene, range.frequency_Hz.high, range.viscosity_Pa_s.low);
    if (!model.inertia.is_given())
      return fmt::format("Inertia of fluid and solid: the unsteady group 2 pi rho f L^2 / mu is up to {:.2g}; with the "
                         "stiffest tail {} is missing there.",
                         group, share_of_displacement(largest_shares(scene, range).together()));
    const double      known = highest_frequency_with_inertia_Hz(scene, range);
    const std::string limit = known < range.frequency_Hz.high
                                  ? fmt::format("; with the stiffest tail the rest is known to {:g} % up to {:.2g} Hz",
                                                100. * largest_inertial_error, known)
                                  : "";
    return fmt::format("Of the fluid's inertia what is not of first order in its density: the unsteady group 2 pi "
                       "rho f L^2 / mu is up to {:.2g}{}.",
                       group, limit);
  }
} // namespace swimtwin
