#include <control/steering/steered_field.h>
#include <tests/twin/run/imagined_stream.h>
#include <twin/estimate/model_bias.h>
#include <twin/telling/telling_search.h>

#include <gtest/gtest.h>

#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr const char *lab_of_16_s =
        "seed = 4\nduration_s = 16\n[coils]\nbx_T = 4e-3\nby_T = 3e-3\nfrequency_Hz = 0.8\n";
    constexpr const char *twin_toml = "[field]\nbx_T = 4e-3\nby_T = 3e-3\nfrequency_Hz = 0.8\n";

    const Drive carrier{std::make_shared<SinusoidalField>(), Eigen::Vector2d(4e-3, 3e-3), 0.8};

    /// A twin that has seen some periods of the carrier.
    struct Watching
    {
      ReducedModel model  = open_model();
      TwinConfig   config = twin_config(model, twin_toml);
      KeptSession  kept{model, config};

      explicit Watching(const double until_s = 6.)
      {
        for (const std::string &line : lab_lines(model, lab_of_16_s))
          if (nlohmann::json::parse(line).value("time_s", 0.) <= until_s)
            kept.session.take(line);
      }
      const SwimmerTwin &twin() const { return kept.session.twin(); }
      int                place(const TwinParameter p) const { return twin().layout().place(p); }
    };

    SwimmerParameters believed(const SwimmerTwin &twin)
    {
      SwimmerParameters parameters = twin.options().nominal;
      parameters.young_modulus_Pa *= std::exp(twin.belief().mean[twin.layout().place(TwinParameter::stiffness)]);
      parameters.magnetization_A_m *= std::exp(twin.belief().mean[twin.layout().place(TwinParameter::magnetization)]);
      return parameters;
    }

    TellingField search(TellingSearch &telling, const SwimmerTwin &twin)
    {
      telling.begin(twin, carrier, 0.);
      std::optional<TellingField> found;
      for (int i = 0; i < 20 && telling.is_searching() && !found; ++i)
        found = telling.go_on();
      EXPECT_TRUE(found.has_value());
      EXPECT_FALSE(telling.is_searching());
      return found.value_or(TellingField{});
    }

    TellingOptions options(const TwinParameter parameter)
    {
      TellingOptions options;
      options.parameter  = parameter;
      options.largest_T  = 7e-3;
      options.lowest_Hz  = 0.4;
      options.highest_Hz = 1.6;
      return options;
    }
  } // namespace

  TEST(CarrierChange, MultipliesComponentsAndFrequency)
  {
    const Drive drive = changed(carrier, {2., 0.5, 1.25});
    EXPECT_DOUBLE_EQ(drive.parameters[0], 8e-3);
    EXPECT_DOUBLE_EQ(drive.parameters[1], 1.5e-3);
    EXPECT_DOUBLE_EQ(drive.frequency_Hz, 1.);
    EXPECT_NEAR(largest_T(carrier), 5e-3, 1e-12);
  }

  // What is foreseen is what comes: the laboratory goes on with the same field, and the filter's own deviation is read.
  TEST(FieldTrial, ForeseesWhatTheFilterWillKnow)
  {
    const Watching before(6.), after(6. + 2. / 0.8);
    FieldTrial     trial(before.model, before.config.options);
    trial.begin(before.twin(), carrier, 0.);
    for (const TwinParameter p : {TwinParameter::stiffness, TwinParameter::magnetization})
    {
      const auto foreseen = trial.run({}, p, after.twin().now_s() - before.twin().now_s());
      ASSERT_TRUE(foreseen.has_value());
      const double then = after.twin().belief().standard_deviation(after.place(p)),
                   now  = before.twin().belief().standard_deviation(before.place(p));
      EXPECT_NEAR(foreseen->standard_deviation, then, 0.05 * then);
      EXPECT_LT(then, 0.95 * now);
    }
  }

  // Newton's method finds the periodic motion that the trial swims into.
  TEST(FieldTrial, SpeedIsThatOfThePeriodicMotion)
  {
    const Watching watching(10.);
    FieldTrial     trial(watching.model, watching.config.options);
    trial.begin(watching.twin(), carrier, 0.);
    const ReducedSwimmer swimmer(watching.model, watching.config.options.densities);
    for (const FieldChange &change : {FieldChange{}, FieldChange{1., 0.6, 1.3}})
    {
      const Drive drive = changed(carrier, change);
      const auto  found = trial.run(change, TwinParameter::stiffness, 12. / drive.frequency_Hz);
      ASSERT_TRUE(found.has_value());
      const PeriodicMotion motion   = periodic_motion(swimmer, believed(watching.twin()), drive);
      const double         expected = drive.frequency_Hz * motion.displacement_m;
      EXPECT_NEAR(found->speed_m_s, expected, 0.02 * expected);
    }
  }

  TEST(TellingSearch, ProposesWithinTheLimitsWhatShortensTheInterval)
  {
    const Watching watching;
    for (const TwinParameter p : {TwinParameter::stiffness, TwinParameter::magnetization})
    {
      TellingSearch      telling(watching.model, watching.config.options, options(p));
      const TellingField found = search(telling, watching.twin());
      ASSERT_TRUE(found.is_better);
      EXPECT_LT(found.of_proposed.standard_deviation, 0.99 * found.of_as_is.standard_deviation);
      EXPECT_LE(largest_T(found.proposed), 7e-3 * (1. + 1e-9));
      EXPECT_GE(found.proposed.frequency_Hz, 0.4);
      EXPECT_LE(found.proposed.frequency_Hz, 1.6);
    }
  }

  // A carrier that is too large already may stay as large, and one frequency alone leaves no other; the components'
  // shares are what is left.
  TEST(TellingSearch, GoesNoFurtherThanItsRoom)
  {
    const Watching watching;
    TellingOptions narrow = options(TwinParameter::stiffness);
    narrow.largest_T      = 1e-9;
    narrow.lowest_Hz = narrow.highest_Hz = carrier.frequency_Hz;
    TellingSearch      telling(watching.model, watching.config.options, narrow);
    const TellingField found = search(telling, watching.twin());
    ASSERT_TRUE(found.is_better);
    EXPECT_NEAR(largest_T(found.proposed), 5e-3, 1e-9);
    EXPECT_DOUBLE_EQ(found.proposed.frequency_Hz, carrier.frequency_Hz);
  }

  TEST(TellingSearch, KeepsTheSpeedThatAGoalNeeds)
  {
    const Watching watching;
    TellingOptions kept = options(TwinParameter::magnetization);
    kept.keeps_speed    = true;
    TellingSearch      telling(watching.model, watching.config.options, kept);
    const TellingField found = search(telling, watching.twin());
    ASSERT_TRUE(found.is_better);
    EXPECT_GE(found.of_proposed.speed_m_s, 0.95 * found.of_as_is.speed_m_s);
  }

  // However the carrier is turned: a bound on each component is one on its size, and a slow coil bounds the frequency.
  TEST(TellingSearch, KeepsTheCoilsLimits)
  {
    const Watching watching;
    TellingOptions weak      = options(TwinParameter::stiffness);
    weak.coils.component_T   = {5.5e-3, 6e-3};
    weak.coils.slew_rate_T_s = 0.02;
    TellingSearch      telling(watching.model, watching.config.options, weak);
    const TellingField found = search(telling, watching.twin());
    EXPECT_LE(largest_T(found.proposed), 5.5e-3 * 1.01);
    const double fastest_T_s = 2. * std::numbers::pi * found.proposed.frequency_Hz * found.proposed.parameters[1];
    EXPECT_LE(fastest_T_s, 0.02 * 1.01);
  }

  TEST(CarrierChange, TurnsTheField)
  {
    const Drive           drive = turned(carrier, 0.7);
    const Eigen::Vector2d was   = carrier.field->value_T(0.1, carrier.parameters);
    EXPECT_LT((drive.field->value_T(0.1, drive.parameters) - Eigen::Rotation2Dd(0.7) * was).norm(), 1e-15);
    EXPECT_NEAR(largest_T(drive), largest_T(carrier), 1e-15);
    EXPECT_DOUBLE_EQ(changed(drive, {2., 1., 1.}).parameters[0], 8e-3);
  }

  // The laboratory plays what was proposed, and the interval is shorter than with the field as it was, as foreseen.
  TEST(TellingSearch, WhatIsProposedDoesTellMore)
  {
    const Watching     watching;
    TellingSearch      telling(watching.model, watching.config.options, options(TwinParameter::stiffness));
    const TellingField found = search(telling, watching.twin());
    ASSERT_TRUE(found.is_better);
    const auto deviation_after = [&](const Drive &drive) {
      const std::string coils = fmt::format("bx_T = {}\nby_T = {}\nfrequency_Hz = {}\n", drive.parameters[0],
                                            drive.parameters[1], drive.frequency_Hz);
      KeptSession       kept(watching.model, twin_config(watching.model, "[field]\n" + coils));
      for (const std::string &line : lab_lines(watching.model, "seed = 4\nduration_s = 12\n[coils]\n" + coils))
        kept.session.take(line);
      const SwimmerTwin &twin = kept.session.twin();
      return twin.belief().standard_deviation(twin.layout().place(TwinParameter::stiffness));
    };
    EXPECT_LT(deviation_after(found.proposed), 0.97 * deviation_after(carrier));
  }

  TEST(TwinSession, ProposesAFieldNowAndThen)
  {
    const ReducedModel model = open_model();
    KeptSession        kept(model, twin_config(model, std::string(twin_toml) +
                                                          "[telling]\nparameter = \"young_modulus_over_viscosity_log\"\n"
                                                                 "every_periods = 5\nlargest_T = 7e-3\n"));
    for (const std::string &line : lab_lines(model, lab_of_16_s))
      kept.session.take(line);
    const auto proposals = lines_of_type(kept.answers, "proposal");
    ASSERT_EQ(proposals.size(), 2);
    EXPECT_EQ(proposals[0]["parameter"], "young_modulus_over_viscosity_log");
    EXPECT_LT(proposals[0]["proposed"]["sd"].get<double>(), proposals[0]["as_is"]["sd"].get<double>());
    EXPECT_LE(proposals[0]["proposed"]["largest_T"].get<double>(), 7e-3 * (1. + 1e-9));
    EXPECT_TRUE(proposals[0]["proposed"].contains("bx_T"));
  }

  TEST(TwinConfig, TellingNeedsAParameterThatIsEstimatedAndAField)
  {
    const ReducedModel model   = open_model();
    const auto         refusal = [&](const std::string &toml) {
      try
      {
        twin_config(model, toml);
      }
      catch (const InputError &error)
      {
        return std::string(error.what());
      }
      return std::string();
    };
    const auto expect_in_refusal = [&](const std::string &toml, const std::string &part) {
      EXPECT_NE(refusal(toml).find(part), std::string::npos) << refusal(toml);
    };
    expect_in_refusal("[telling]\nparameter = \"young_modulus_over_viscosity_log\"\n", "needs a field that plays");
    expect_in_refusal(std::string(twin_toml) + "[telling]\nparameter = \"background_bx_T\"\n",
                      "young_modulus_over_viscosity_log");
    expect_in_refusal(std::string(twin_toml) + "[telling]\n", "parameter");
    expect_in_refusal(std::string(twin_toml) +
                          "[telling]\nparameter = \"young_modulus_over_viscosity_log\"\nlowest_Hz = 3\n",
                      "is above highest_Hz");
  }
} // namespace swimtwin
