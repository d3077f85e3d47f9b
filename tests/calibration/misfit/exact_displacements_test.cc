#include <datasets/scene/inertia_terms.h>
#include <tests/calibration/central_difference.h>
#include <tests/calibration/synthetic_curve.h>
#include <tests/places.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    std::vector<SwimmingCondition> conditions(const std::optional<int> period)
    {
      return calibration_data({exact_curve(3, known_swimmer(), period)}).conditions;
    }

    CalibratedSwimmer changed(const MotionQuantity quantity, const double logarithm)
    {
      CalibratedSwimmer swimmer   = known_swimmer();
      double           *members[] = {&swimmer.young_modulus_Pa, &swimmer.viscosity_Pa_s, &swimmer.magnetization_A_m,
                                     &swimmer.field_scale};
      *members[quantity] *= std::exp(logarithm);
      return swimmer;
    }

    void expect_derivatives(const CalibrationModel &model, const std::optional<int> period, const double tolerance,
                            const double integration = 1e-11)
    {
      ExactDisplacements  exact(model, conditions(period), {.relative_tolerance = integration});
      const Displacements at = exact.evaluate(known_swimmer(), true);
      EXPECT_EQ(at.failure, "");
      const double h     = 1e-2;
      const double scale = at.value_m.cwiseAbs().maxCoeff();
      for (int q = 0; q < n_motion_quantities; ++q)
      {
        const auto            quantity   = static_cast<MotionQuantity>(q);
        const Eigen::VectorXd difference = central_difference(
            [&](const double step) { return Eigen::VectorXd(exact.evaluate(changed(quantity, step), false).value_m); },
            h);
        EXPECT_LT((difference - at.by_logarithm.col(q)).cwiseAbs().maxCoeff(), tolerance * scale) << q;
      }
    }

    const CalibrationModel &inertial_swimmer()
    {
      static const CalibrationModel model(reference_model(), all_inertia);
      return model;
    }

    /// The model's swimmer and fluid as many times as dense.
    ReducedModel denser(ReducedModel model, const double factor)
    {
      const Scene scene     = parse_scene(model.scene_text, "own.toml");
      const auto  by_factor = [&](const char *key, const double density_kg_m3) {
        return fmt::format("{}={:.17g}", key, factor * density_kg_m3);
      };
      model.scene_text = parse_scene(model.scene_text, "denser.toml",
                                     {by_factor("fluid.density_kg_m3", scene.fluid->density_kg_m3),
                                      by_factor("tail.density_kg_m3", scene.tail->density_kg_m3),
                                      by_factor("head.density_kg_m3", scene.head.density_kg_m3)})
                             .text;
      return model;
    }

    CalibratedSwimmer together(CalibratedSwimmer swimmer, const double factor)
    {
      swimmer.young_modulus_Pa *= factor;
      swimmer.viscosity_Pa_s *= factor;
      swimmer.magnetization_A_m *= factor;
      return swimmer;
    }

    /// Every length s times as long, for shapes that are sums of modes. Per unit depth areas grow with s^2, and so do
    /// torques and energies; of the resistances force to velocity keeps its size, couple to turning grows with s^2.
    ReducedModel similar(ReducedModel model, const double s)
    {
      const int n = model.n_modes() + 3, R = model.tail.n_amplitudes();
      model.tail.nodes_m *= s;
      model.tail.followers /= s;
      for (Eigen::MatrixXd *gram : {&model.elasticity.gram_lambda, &model.elasticity.gram_mu})
      {
        gram->rightCols(gram->cols() - R) /= s; // products of two amplitudes instead of one
        gram->bottomRows(gram->rows() - R) /= s;
      }
      model.magnet.head_area_m2 *= s * s;
      model.magnet.tail_area_m2 *= s * s;
      model.magnet.tail_area_of_mode_m *= s;
      model.area.linear_m *= s;
      Eigen::VectorXd row             = Eigen::VectorXd::Ones(n);
      row[2]                          = s;
      model.resistance.factor_at_rest = row.asDiagonal() * model.resistance.factor_at_rest;
      model.resistance.coordinate_scale_m *= s;
      return model;
    }
  } // namespace

  TEST(ExactDisplacements, DerivativesAgreeWithDifferencesInTheThirdPeriod)
  {
    expect_derivatives(reference_swimmer(), 3, 1e-6);
  }

  TEST(ExactDisplacements, DerivativesAgreeWithDifferencesInThePeriodicMotion)
  {
    expect_derivatives(reference_swimmer(), std::nullopt, 1e-5);
  }

  TEST(ExactDisplacements, ASimilarSwimmerSwimsFartherInProportionToItsLength)
  {
    const double       s = 1.7;
    const ReducedModel model =
        read_reduced_model(std::string(places::source) + "/tests/models/reference-2d-version-1.h5");
    const CalibrationModel swimmer(model), larger(similar(model, s));
    for (const std::optional<int> period : {std::optional<int>(3), std::optional<int>()})
    {
      const auto            same = conditions(period);
      const Eigen::VectorXd of_scene =
          ExactDisplacements(swimmer, same, {.relative_tolerance = 1e-9}).evaluate(known_swimmer(), false).value_m;
      const Eigen::VectorXd of_larger =
          ExactDisplacements(larger, same, {.relative_tolerance = 1e-9}).evaluate(known_swimmer(), false).value_m;
      EXPECT_LT((of_larger - s * of_scene).cwiseAbs().maxCoeff(), 1e-6 * of_larger.cwiseAbs().maxCoeff());
    }
  }

  TEST(ExactDisplacements, OnlyTheGroupsMatter)
  {
    ExactDisplacements    exact(reference_swimmer(), conditions(3), {.relative_tolerance = 1e-10});
    const Eigen::VectorXd D = exact.evaluate(known_swimmer(), false).value_m;
    EXPECT_LT((exact.evaluate(together(known_swimmer(), 1.3), false).value_m - D).cwiseAbs().maxCoeff(),
              1e-7 * D.maxCoeff());
    CalibratedSwimmer field = known_swimmer();
    field.field_scale       = 1.25;
    field.magnetization_A_m /= 1.25;
    EXPECT_LT((exact.evaluate(field, false).value_m - D).cwiseAbs().maxCoeff(), 1e-7 * D.maxCoeff());
  }

  // At this tolerance displacements are off by some 2e-7, their differences by a hundred times as much.
  TEST(ExactDisplacements, DerivativesAgreeWithDifferencesWithInertiaToo)
  {
    expect_derivatives(inertial_swimmer(), 3, 1e-4, 1e-9);
    expect_derivatives(inertial_swimmer(), std::nullopt, 1e-4, 1e-9);
  }

  // E, mu and M together change a motion with inertia, and do not if the densities go with them.
  TEST(ExactDisplacements, WithInertiaTheDensityOverTheViscosityMattersToo)
  {
    constexpr double      factor = 1.3;
    const Eigen::VectorXd D      = ExactDisplacements(inertial_swimmer(), conditions(3), {.relative_tolerance = 1e-10})
                                  .evaluate(known_swimmer(), false)
                                  .value_m;
    const CalibratedSwimmer all  = together(known_swimmer(), factor);
    const Eigen::VectorXd   less = ExactDisplacements(inertial_swimmer(), conditions(3), {.relative_tolerance = 1e-10})
                                     .evaluate(all, false)
                                     .value_m;
    EXPECT_GT((less - D).cwiseAbs().maxCoeff(), 1e-3 * D.maxCoeff());
    const CalibrationModel dense(denser(reference_model(), factor), all_inertia);
    const Eigen::VectorXd  same =
        ExactDisplacements(dense, conditions(3), {.relative_tolerance = 1e-10}).evaluate(all, false).value_m;
    EXPECT_LT((same - D).cwiseAbs().maxCoeff(), 1e-7 * D.maxCoeff());
  }

  TEST(ExactDisplacements, SaysWhereTheModelWasNotTrained)
  {
    const ExactDisplacements exact(reference_swimmer(), conditions(3), {});
    EXPECT_EQ(exact.trust(known_swimmer()).front(), "");
    CalibratedSwimmer stiff = known_swimmer();
    stiff.young_modulus_Pa  = 3e6;
    EXPECT_EQ(exact.trust(stiff).front().substr(0, 10), "E/(M by) =");
    stiff.viscosity_Pa_s *= 37.5; // the same swimmer again: all three together
    stiff.magnetization_A_m *= 37.5;
    EXPECT_EQ(exact.trust(stiff).front(), "");
    stiff.field_scale = 0.01; // a weaker field is a weaker magnet
    EXPECT_EQ(exact.trust(stiff).front().substr(0, 10), "E/(M by) =");
    stiff.magnetization_A_m *= 100.;
    EXPECT_EQ(exact.trust(stiff).front(), "");
  }

  TEST(ExactDisplacements, AreTrustedWhereATrainedFrequencyMakesUpForThem)
  {
    // All forces but the viscous one a fifth, the magnet weaker than any that was trained: as if swum at five times
    // the frequency.
    const ExactDisplacements slow(reference_swimmer(), {condition_of(exact_curve(2, known_swimmer()), 0.12)}, {});
    const ExactDisplacements fast(reference_swimmer(), {condition_of(exact_curve(2, known_swimmer()), 3.)}, {});
    CalibratedSwimmer        swimmer = known_swimmer();
    swimmer.young_modulus_Pa *= 0.2;
    swimmer.magnetization_A_m *= 0.2;
    EXPECT_EQ(slow.trust(swimmer).front(), "");
    EXPECT_NE(fast.trust(swimmer).front().find("M by/(mu f)"), std::string::npos);
  }

  TEST(ExactDisplacements, AreTheSameForAnyNumberOfThreads)
  {
    ExactDisplacements one(reference_swimmer(), conditions(3), {.n_threads = 1}),
        two(reference_swimmer(), conditions(3), {.n_threads = 2});
    EXPECT_EQ(one.evaluate(known_swimmer(), true).by_logarithm, two.evaluate(known_swimmer(), true).by_logarithm);
    EXPECT_EQ(two.n_runs(), 3);
  }

  TEST(DisplacementTable, AgreesWithExactDisplacementsAndTheirSensitivities)
  {
    const Setting      setting(two_ratios(), {exact_curve(6, known_swimmer())});
    const auto         table = setting.table();
    ExactDisplacements exact(reference_swimmer(), setting.data.conditions,
                             {.relative_tolerance = 1e-9, .n_threads = 2});
    CalibratedSwimmer  off = known_swimmer();
    off.young_modulus_Pa *= 1.17;
    off.magnetization_A_m *= 0.88;
    const Displacements a = exact.evaluate(off, true), b = table->evaluate(off, true);
    const double        scale = a.value_m.cwiseAbs().maxCoeff();
    EXPECT_LT((a.value_m - b.value_m).cwiseAbs().maxCoeff(), 1e-4 * scale);
    EXPECT_LT((a.by_logarithm - b.by_logarithm).cwiseAbs().maxCoeff(), 1e-3 * scale);
    EXPECT_LT(table->interpolation_error(), 1e-4);
    EXPECT_TRUE(table->covers(off));
  }

  TEST(DisplacementTable, WithInertiaKnowsTheViscosityByItself)
  {
    const CalibrationModel &model  = inertial_swimmer();
    const Eigen::VectorXd   centre = MotionGroups(model).values(known_swimmer());
    ASSERT_EQ(centre.size(), 3);
    std::string failure;
    const auto  table =
        DisplacementTable::make(model, conditions(3), {centre.array() - .1, centre.array() + .1},
                                {.relative_tolerance = 1e-8, .interpolation_error = 1e-4, .n_threads = 2}, failure);
    ASSERT_TRUE(table) << failure;
    CalibratedSwimmer off = known_swimmer();
    off.young_modulus_Pa *= 1.12;
    off.viscosity_Pa_s *= 1.05;
    ExactDisplacements  exact(model, conditions(3), {.relative_tolerance = 1e-9});
    const Displacements a = exact.evaluate(off, true), b = table->evaluate(off, true);
    const double        scale = a.value_m.cwiseAbs().maxCoeff();
    EXPECT_LT((a.value_m - b.value_m).cwiseAbs().maxCoeff(), 1e-4 * scale);
    EXPECT_LT((a.by_logarithm - b.by_logarithm).cwiseAbs().maxCoeff(), 2e-3 * scale);
  }

  TEST(DisplacementTable, IsNarrowedToWhereTheSwimmerCanBeComputed)
  {
    const CalibrationModel model(read_reduced_model(std::string(places::models) + "/reference-3d.h5"));
    const MotionGroups     groups(model);
    CalibratedSwimmer      softest = model.nominal, stiffest = model.nominal;
    softest.young_modulus_Pa /= 10.;
    softest.magnetization_A_m *= 2.;
    stiffest.young_modulus_Pa *= 2.;
    stiffest.magnetization_A_m /= 2.;
    softest.viscosity_Pa_s = stiffest.viscosity_Pa_s = 1.;
    const GroupBox box{groups.values(softest).cwiseMin(groups.values(stiffest)),
                       groups.values(softest).cwiseMax(groups.values(stiffest))};
    TableOptions   options{.relative_tolerance = 1e-5, .interpolation_error = 5e-2, .n_threads = 2};
    std::string    failure;
    EXPECT_EQ(DisplacementTable::make(model, conditions(3), box, options, failure), nullptr);
    EXPECT_NE(failure, "");
    options.narrow_around = groups.values(model.nominal);
    const auto table      = DisplacementTable::make(model, conditions(3), box, options, failure);
    ASSERT_TRUE(table) << failure;
    EXPECT_TRUE(table->covers(model.nominal));
    EXPECT_FALSE(table->covers(softest));
    ExactDisplacements  exact(model, conditions(3), {.relative_tolerance = 1e-5, .by = {}});
    const Displacements a = exact.evaluate(model.nominal, false), b = table->evaluate(model.nominal, false);
    EXPECT_LT((a.value_m - b.value_m).cwiseAbs().maxCoeff(), 5e-2 * a.value_m.cwiseAbs().maxCoeff());
  }

  TEST(DisplacementTable, GoesOnAsATangentPlane)
  {
    const Setting     setting(two_ratios(), {exact_curve(6, known_swimmer())});
    const auto        table = setting.table();
    CalibratedSwimmer edge = known_swimmer(), beyond = known_swimmer();
    edge.young_modulus_Pa *= std::exp(0.25);
    beyond.young_modulus_Pa *= std::exp(0.35);
    const Displacements at = table->evaluate(edge, true);
    EXPECT_FALSE(table->covers(beyond));
    EXPECT_LT((table->evaluate(beyond, false).value_m - at.value_m - 0.1 * at.by_logarithm.col(by_young_modulus))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-12);
  }
} // namespace swimtwin
