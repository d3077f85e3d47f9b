// The models that are shipped: their laws at many shapes, and their displacements against the full-order model's.
#include <datasets/csv_table.h>
#include <rom/resistance_surrogate.h>
#include <rom/sweep.h>
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
    const std::filesystem::path datasets = std::filesystem::path(SWIMTWIN_SOURCE_DIR) / "datasets";

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

  INSTANTIATE_TEST_SUITE_P(All, ShippedModels, ::testing::Values("reference-2d", "open-2d"));

  namespace
  {
    struct FullOrderPoint
    {
      double young_modulus_Pa, magnetization_A_m, frequency_Hz, displacement_m;
    };

    /// Third-period displacements of the full-order model (bench/displacement-frequency).
    std::vector<FullOrderPoint> full_order_points()
    {
      const CsvTable table = CsvTable::read(datasets / "reference" / "displacement-frequency.csv");
      const auto     E = table.column("young_modulus_Pa"), M = table.column("magnetization_A_m"),
                 f = table.column("frequency_Hz"), d = table.column("displacement_m");
      std::vector<FullOrderPoint> points;
      for (std::size_t k = 0; k < table.n_rows(); ++k)
        points.push_back({E[k], M[k], f[k], d[k]});
      return points;
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
  } // namespace

  // 60 points, none of them trained on. Up to twice the frequency of its curve's peak the reduced model has to be
  // within 1 % of the full-order one, above within 3 %.
  TEST(ShippedReferenceModel, DisplacementsAreThoseOfTheFullOrderModel)
  {
    const ReducedModel                                  model  = shipped_model("reference-2d");
    const auto                                          points = full_order_points();
    std::map<std::pair<double, double>, FullOrderPoint> peaks;
    for (const auto &p : points)
    {
      auto &peak = peaks.try_emplace({p.young_modulus_Pa, p.magnetization_A_m}, p).first->second;
      if (p.displacement_m > peak.displacement_m)
        peak = p;
    }
    double squares = 0., worst = 0.;
    for (const auto &p : points)
    {
      const double peak  = peaks.at({p.young_modulus_Pa, p.magnetization_A_m}).frequency_Hz;
      const double error = std::abs(predicted(model, p) - p.displacement_m);
      EXPECT_LE(error, (p.frequency_Hz <= 2. * peak ? .01 : .03) * p.displacement_m)
          << p.young_modulus_Pa << " Pa, " << p.magnetization_A_m << " A/m, " << p.frequency_Hz << " Hz";
      worst = std::max(worst, error / p.displacement_m);
      squares += std::pow(error / p.displacement_m, 2);
    }
    std::printf("reduced against full-order: %.2f %% rms, %.2f %% worst of %zu points\n",
                100. * std::sqrt(squares / static_cast<double>(points.size())), 100. * worst, points.size());
  }
} // namespace swimtwin
