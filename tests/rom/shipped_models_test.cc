// The models that are shipped: their laws at many shapes, and their displacements against the full-order model's.
#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/text/csv_table.h>
#include <rom/sweep/sweep.h>
#include <rom/swimmer/resistance_surrogate.h>
#include <tests/places.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace swimtwin
{
  namespace
  {
    const std::filesystem::path datasets = std::filesystem::path(places::source) / "datasets";

    ReducedModel shipped_model(const std::string &name)
    {
      return read_reduced_model(datasets / "models" / (name + ".h5"));
    }

    class ShippedModels : public ::testing::TestWithParam<const char *>
    {
    protected:
      const ReducedModel        model = shipped_model(GetParam());
      const ResistanceSurrogate resistance =
          ResistanceSurrogate(model.resistance, model.tail.parity.head(model.n_modes()));
      RandomNumbers random = RandomNumbers(11);
    };

    /// Of R scaled by its diagonal at rest.
    double condition(const Eigen::MatrixXd &R, const Eigen::VectorXd &scale)
    {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * R * scale.asDiagonal(),
                                                                 Eigen::EigenvaluesOnly);
      return eigen.eigenvalues().minCoeff() > 0. ? eigen.eigenvalues().maxCoeff() / eigen.eigenvalues().minCoeff()
                                                 : std::numeric_limits<double>::infinity();
    }
  } // namespace

  TEST_P(ShippedModels, ResistanceIsSoundAtAMillionShapesAndOneAndAHalfTimesBeyond)
  {
    const Eigen::VectorXd scale =
        resistance.resistance(ShapeVector::Zero(model.n_modes()), 0.).diagonal().cwiseSqrt().cwiseInverse();
    double worst = 0.;
    for (int k = 0; k < 1'000'000; ++k)
    {
      const ShapeVector q     = random_shape(model, random, 1.5);
      const double      angle = 1.5 * model.resistance.angle_scale_rad * random();
      worst                   = std::max(worst, condition(resistance.resistance(q, angle), scale));
      if (!std::isfinite(worst))
        break;
    }
    EXPECT_LE(worst, 10. * model.record.largest_condition);
    std::printf("%s: condition at most %.0f; in training %.0f\n", GetParam(), worst, model.record.largest_condition);
  }

  TEST_P(ShippedModels, MirroredShapesHaveTheMirroredResistance)
  {
    Eigen::VectorXd mirror(model.n_modes() + 3);
    mirror << 1., -1., -1., model.tail.parity.head(model.n_modes()).cast<double>();
    for (int k = 0; k < 1000; ++k)
    {
      const ShapeVector     q     = random_shape(model, random, 1.5);
      const double          angle = model.resistance.angle_scale_rad * random();
      const Eigen::MatrixXd R = resistance.resistance(q, angle), S = resistance.resistance(-q, -angle);
      const Eigen::VectorXd d = R.diagonal().cwiseSqrt().cwiseInverse();
      EXPECT_LE(
          (d.asDiagonal() * (mirror.asDiagonal() * R * mirror.asDiagonal() - S) * d.asDiagonal()).cwiseAbs().maxCoeff(),
          1e-13);
    }
  }

  TEST_P(ShippedModels, HeldOutVelocitiesAreWithinOnePercent)
  {
    EXPECT_GT(model.record.n_held_out_samples, 20);
    EXPECT_LE(model.record.velocity_error_max, 0.01);
  }

  INSTANTIATE_TEST_SUITE_P(All, ShippedModels, ::testing::Values("reference-2d", "open-2d", "reference-3d", "open-3d"));

  namespace
  {
    struct FullOrderPoint
    {
      double young_modulus_Pa, magnetization_A_m, frequency_Hz, displacement_m, error_m;
    };

    /// Third-period displacements of the full-order model, from a table of datasets/reference.
    std::vector<FullOrderPoint> full_order_points(const char *name)
    {
      const CsvTable table = CsvTable::read(datasets / "reference" / name);
      const auto     E = table.column("young_modulus_Pa"), M = table.column("magnetization_A_m"),
                 f = table.column("frequency_Hz"), d = table.column("displacement_m"),
                 mesh = table.column("mesh_error_m"), step = table.column("step_error_m");
      std::vector<FullOrderPoint> points;
      for (std::size_t k = 0; k < table.n_rows(); ++k)
        points.push_back({E[k], M[k], f[k], d[k], mesh[k] + step[k]});
      return points;
    }

    /// Where each curve of the 60 points (bench/displacement-frequency) is highest, by modulus and magnetization.
    std::map<std::pair<double, double>, FullOrderPoint> peaks()
    {
      std::map<std::pair<double, double>, FullOrderPoint> result;
      for (const auto &p : full_order_points("displacement-frequency.csv"))
      {
        auto &peak = result.try_emplace({p.young_modulus_Pa, p.magnetization_A_m}, p).first->second;
        if (p.displacement_m > peak.displacement_m)
          peak = p;
      }
      return result;
    }

    double predicted(const ReducedModel &model, const FullOrderPoint &point)
    {
      SweepOptions options = sweep_options(parse_scene(model.scene_text, model.scene_name), model);
      options.periodic = options.indicator = false;
      return sweep(model, {{point.young_modulus_Pa}, {}, {point.magnetization_A_m}, {}, {}, {point.frequency_Hz}},
                   options)
          .front()
          .displacement_m;
    }
    /// Up to twice the frequency of its curve's peak the reduced model has to be within 1 % of the full-order one,
    /// above within 3 %, and so many times the full-order one's own error.
    void expect_agreement(const char *table, const double times_own_error)
    {
      const ReducedModel model   = shipped_model("reference-2d");
      const auto         points  = full_order_points(table);
      const auto         highest = peaks();
      double             squares = 0., worst_low = 0., worst_high = 0.;
      for (const auto &p : points)
      {
        const double peak  = highest.at({p.young_modulus_Pa, p.magnetization_A_m}).frequency_Hz;
        const double error = std::abs(predicted(model, p) / p.displacement_m - 1.);
        const bool   low   = p.frequency_Hz <= 2. * peak;
        EXPECT_LE(error, (low ? .01 : .03) + times_own_error * p.error_m / p.displacement_m)
            << p.young_modulus_Pa << " Pa, " << p.magnetization_A_m << " A/m, " << p.frequency_Hz << " Hz";
        (low ? worst_low : worst_high) = std::max(low ? worst_low : worst_high, error);
        squares += error * error;
      }
      std::printf(
          "reduced against full-order, %zu points: %.2f %% rms, worst %.2f %% up to twice the peak's frequency, "
          "%.2f %% above\n",
          points.size(), 100. * std::sqrt(squares / static_cast<double>(points.size())), 100. * worst_low,
          100. * worst_high);
    }
  } // namespace

  // Runs in space that it was not trained on, third period, where its range has them; in the periodic state the runs
  // are of a coarser mesh.
  TEST(ShippedSpatialModel, DisplacementsAreThoseOfTheFullOrderModel)
  {
    const ReducedModel model = shipped_model("reference-3d");
    EXPECT_EQ(model.dimension(), 3);
    const CsvTable table = CsvTable::read(datasets / "reference" / "displacement-frequency-3d.csv");
    const auto R = table.column("head_radius_m"), f = table.column("frequency_Hz"), d = table.column("displacement_m"),
               step = table.column("step_error_m");
    double squares = 0., worst = 0.;
    int    n = 0;
    for (std::size_t k = 0; k < table.n_rows(); ++k)
      if (R[k] == .75e-3 && model.range.frequency_Hz.contains(f[k]))
      {
        const double error = std::abs(predicted(model, {2e5, 1e5, f[k], d[k], 0.}) / d[k] - 1.);
        EXPECT_LE(error, .015 + step[k] / d[k]) << f[k] << " Hz";
        worst = std::max(worst, error);
        squares += error * error;
        ++n;
      }
    EXPECT_GE(n, 7);
    std::printf("in space, %d points: %.2f %% rms, worst %.2f %%\n", n, 100. * std::sqrt(squares / n), 100. * worst);
  }

  // None of the points was trained on.
  TEST(ShippedReferenceModel, DisplacementsAreThoseOfTheFullOrderModel)
  {
    expect_agreement("displacement-frequency.csv", 1.);
  }

  TEST(ShippedReferenceModel, DisplacementsAreThoseKnownToAThirdOfAPercent)
  {
    const auto points = full_order_points("accurate-points.csv");
    ASSERT_GE(points.size(), 15u);
    for (const auto &p : points)
      EXPECT_LE(p.error_m, 0.003 * p.displacement_m) << p.frequency_Hz << " Hz";
    expect_agreement("accurate-points.csv", 0.);
  }

  namespace
  {
    /// What is stated for a displacement with inertia, against the full-order model with and without it: the bound
    /// holds, beside the error that there is without inertia. Returns how much of a bound that matters is reached. Of
    /// a table with several steps per period the rows of 100 count.
    double expect_bounded_error_of_inertia(const std::string &name, const std::string &table_name, const int n_rows)
    {
      const ReducedModel model = shipped_model(name);
      const Scene        scene = parse_scene(model.scene_text, model.scene_name);
      const CsvTable     table = CsvTable::read(datasets / "reference" / table_name);
      const auto         M = table.column("magnetization_A_m"), mu = table.column("viscosity_Pa_s"),
                 f = table.column("frequency_Hz"), d = table.column("displacement_m");
      const auto E = table.has_column("young_modulus_Pa") ? table.column("young_modulus_Pa")
                                                          : std::vector(table.n_rows(), scene.tail->young_modulus_Pa);
      const auto steps =
          table.has_column("steps_per_period") ? table.column("steps_per_period") : std::vector(table.n_rows(), 100.);
      const std::size_t terms    = *table.find_column("terms");
      const auto        is_terms = [&](const std::size_t row, const char *what) {
        return steps[row] == 100. && table.cells(row)[terms] == what;
      };
      const auto error = [&](const std::size_t row, const InertialDensities &densities) {
        SweepOptions options = sweep_options(scene, model);
        options.densities    = densities;
        options.periodic = options.indicator = false;
        const auto result = sweep(model, {{E[row]}, {mu[row]}, {M[row]}, {}, {}, {f[row]}}, options).front();
        return std::abs(result.displacement_m / d[row] - 1.);
      };
      std::map<std::array<double, 4>, double> error_without;
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        if (is_terms(row, "none"))
          error_without[{E[row], M[row], mu[row], f[row]}] = error(row, {});
      const InertialDensities all         = inertial_densities(scene, all_inertia);
      constexpr double        integration = 5e-4, matters = 0.02;
      double                  nearest = 0.;
      int                     n       = 0;
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        if (is_terms(row, "full"))
        {
          const double bound = error_of_carried_inertia(inertia_shares(scene, f[row], mu[row], E[row]).together(),
                                                        unsteady_group_of_domain(scene, f[row], mu[row]));
          const double with  = error(row, all);
          EXPECT_LE(with, bound + error_without.at({E[row], M[row], mu[row], f[row]}) + integration)
              << E[row] << " Pa, " << mu[row] << " Pa s, " << f[row] << " Hz";
          if (bound > matters)
            nearest = std::max(nearest, with / bound);
          ++n;
        }
      EXPECT_GE(n, n_rows);
      return nearest;
    }
  } // namespace

  // From 0.1 to 3 Hz in glycerol and in a tenth of its viscosity; the bound is not loose where inertia matters most.
  TEST(ShippedReferenceModel, ErrorOfCarriedInertiaIsBounded)
  {
    const double nearest = expect_bounded_error_of_inertia("reference-2d", "inertia.csv", 36);
    EXPECT_GT(nearest, 0.25);
    std::printf("carried inertia: at least %.2f of the bound is reached\n", nearest);
  }

  // From 0.2 to 2 Hz in glycerol, and at a tenth of its viscosity.
  TEST(ShippedSpatialModel, ErrorOfCarriedInertiaIsBounded)
  {
    expect_bounded_error_of_inertia("reference-3d", "inertia-3d.csv", 7);
    expect_bounded_error_of_inertia("open-3d", "inertia-open-3d.csv", 1);
  }
} // namespace swimtwin
