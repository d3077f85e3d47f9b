#include <tests/twin/steering/steered_lab.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace swimtwin
{
  namespace
  {
    const ReducedModel &steered_model()
    {
      static const ReducedModel read = open_model();
      return read;
    }

    constexpr double body_m = 7.75e-3;

    /// What the coils play in the end: every line replaces what was to come.
    FieldSignal played(const std::vector<PlayRecord> &decisions)
    {
      FieldSignal signal;
      for (const PlayRecord &record : decisions)
        signal.replace(record.samples);
      return signal;
    }

    TEST(Pilot, LeadsASwimmerThatIsSeenLateAlongItsPath)
    {
      SteeredLab steered(steered_model(), steered_goal, "", steered_lab);
      steered.run(steered_model());
      ASSERT_EQ(steered.of_type("path").size(), 1U);
      EXPECT_TRUE(steered.of_type("error").empty());
      double     sum       = 0.;
      const auto distances = steered.distances_m();
      for (const double d : distances)
        sum += d * d / static_cast<double>(distances.size());
      std::printf("mean position %.3f %% of a body length off its path (rms)\n", 100. * std::sqrt(sum) / body_m);
      EXPECT_LE(std::sqrt(sum), 5e-3 * body_m);
      EXPECT_EQ(steered.decisions.back().phase, SteeringPhase::following);
    }

    TEST(Pilot, PlaysNoGapAndNoJumpFromOneDecisionToTheNext)
    {
      SteeredLab steered(steered_model(), steered_goal, "", steered_lab);
      steered.lab.duration_s = 8.;
      steered.run(steered_model());
      const FieldSignal signal = played(steered.decisions);
      // A carrier of 4 mT at 0.9 Hz changes by less than 2 pi f B, and so does the turning plan by little more.
      double largest = 0.;
      for (double t = 1.; t < 7.5; t += 1e-3)
        largest = std::max(largest, (signal.value_T(t + 1e-3) - signal.value_T(t)).norm() / 1e-3);
      EXPECT_LT(largest, 1.5 * 2. * 3.14159265 * 0.9 * 5e-3 * std::sqrt(2.));
      for (std::size_t i = 1; i < steered.decisions.size(); ++i)
        EXPECT_LE(steered.decisions[i].time_s, steered.decisions[i - 1].until_s);
    }

    TEST(Pilot, KeepsTheLimitsOfTheCoilsAlways)
    {
      const std::string limits = "[limits]\nslew_rate_T_s = 0.06\nbx_T = 7.1e-3\n";
      SteeredLab        steered(steered_model(), std::string(steered_goal) + limits, "safe_T = [2e-3, -1e-3]\n",
                                std::string(steered_lab) + "dark_1_s = [5.0, 7.0]\n");
      steered.lab.duration_s = 9.;
      steered.run(steered_model());
      const FieldSignal signal = played(steered.decisions);
      for (double t = 0.2; t < 10.; t += 2e-3)
        EXPECT_LE((signal.value_T(t + 2e-3) - signal.value_T(t)).norm(), 0.06 * 2e-3 * (1. + 1e-9)) << t;
    }

    TEST(Pilot, PlaysTheSafeFieldWithoutSightAndGoesOnAlongTheSamePath)
    {
      SteeredLab steered(steered_model(), steered_goal, "safe_T = [1e-3, 5e-4]\n",
                         std::string(steered_lab) + "dark_1_s = [6.0, 8.0]\n");
      steered.lab.duration_s = 11.;
      steered.run(steered_model());
      const FieldSignal signal = played(steered.decisions);
      EXPECT_EQ(signal.value_T(7.5), Eigen::Vector2d(1e-3, 5e-4));
      bool was_blind = false;
      for (const PlayRecord &d : steered.decisions)
        was_blind = was_blind || (d.decided_s > 6. && d.phase == SteeringPhase::blind);
      EXPECT_TRUE(was_blind);
      EXPECT_EQ(steered.decisions.back().phase, SteeringPhase::following);
      EXPECT_EQ(steered.of_type("path").size(), 1U);
    }

    TEST(Pilot, LeadsToTheSafeFieldWhenNothingMoreIsSaid)
    {
      SteeredLab steered(steered_model(), steered_goal, "safe_T = [1e-3, 0.0]\n", steered_lab);
      steered.lab.duration_s = 5.;
      steered.run(steered_model());
      const PlayRecord &last = steered.decisions.back();
      EXPECT_GT(last.samples.back().time_s, last.until_s);
      EXPECT_EQ(played(steered.decisions).value_T(last.until_s + 60.), Eigen::Vector2d(1e-3, 0.));
    }

    TEST(Pilot, GoesOnWithTheLastPlanWhenDecisionsAreLateAndGivesUpAfterItsHorizon)
    {
      const std::string late = "kind = \"closed-loop\"\n[path]\nshape = \"circle\"\nsize_m = 7.75e-3\n"
                               "[loop]\nplant = \"external\"\ndeadline_s = 1e-9\ndecisions_per_second = 10\n";
      SteeredLab        steered(steered_model(), late, "", steered_lab);
      steered.lab.duration_s = 9.;
      steered.run(steered_model());
      int n_late = 0, n_blind = 0;
      for (const PlayRecord &d : steered.decisions)
      {
        n_late += d.is_late;
        n_blind += d.is_late && d.phase == SteeringPhase::blind;
        if (d.is_late && d.phase == SteeringPhase::following)
        {
          EXPECT_GT(d.samples[5].field_T.norm(), 1e-3);
        }
      }
      EXPECT_GT(n_late, 20);
      EXPECT_GE(n_blind, 1);
    }

    TEST(Pilot, DoesNotDependOnTheCamerasRate)
    {
      for (const char *rate : {"frames_per_second = 12\n", "frames_per_second = 70\n"})
      {
        SteeredLab steered(steered_model(), steered_goal, "", std::string(steered_lab) + rate);
        steered.lab.duration_s = 3.;
        steered.run(steered_model());
        EXPECT_NEAR(static_cast<double>(steered.decisions.size()), 30., 1.) << rate;
      }
    }

    TEST(Pilot, GoesOnAlongTheSamePathFromAMemory)
    {
      SteeredLab  steered(steered_model(), steered_goal, "", steered_lab);
      KeptSession first(steered_model(), steered.config), second(steered_model(), steered.config);
      steered.lab.duration_s  = 6.;
      std::size_t n_heard     = 0;
      const auto  new_answers = [&](double) {
        std::vector<PlayMessage> plays;
        for (; n_heard < first.answers.size(); ++n_heard)
          if (first.answers[n_heard]["type"] == "play")
            plays.push_back(std::get<PlayMessage>(parse_message(first.answers[n_heard].dump(), {})));
        return plays;
      };
      run_laboratory(steered_model(), steered.lab,
                     {[&](double, const std::string &line) {
                        first.session.take(line);
                        return true;
                      },
                      [](const LabTruth &) {}, new_answers});
      ASSERT_TRUE(first.session.pilot()->has_path());
      second.session.restore(nlohmann::ordered_json::parse(first.session.memory().dump()));
      ASSERT_TRUE(second.session.pilot()->has_path());
      EXPECT_EQ(second.session.pilot()->path().points_m(), first.session.pilot()->path().points_m());
      EXPECT_EQ(second.session.twin().field().samples().size(), first.session.twin().field().samples().size());
      second.session.take(R"({"type":"clock","time_s":6.05})");
      EXPECT_EQ(second.session.pilot()->phase(), SteeringPhase::following);
      // In the carrier's phase: a new beginning of it would shift the mean position by the head's swing.
      const double periods = (second.session.pilot()->carrier_start_s() - first.session.pilot()->carrier_start_s()) *
                             steered.config.steering->goal.carrier.frequency_Hz;
      EXPECT_GT(periods, 0.5);
      EXPECT_NEAR(periods, std::round(periods), 1e-9);
    }

    TEST(Pilot, AnswersEveryClockLineAndRefusesOneThatRunsBack)
    {
      SteeredLab  steered(steered_model(), steered_goal, "", steered_lab);
      KeptSession kept(steered_model(), steered.config);
      for (const char *time : {"0", "0.01", "0.02"})
        kept.session.take(std::string(R"({"type":"clock","time_s":)") + time + "}");
      EXPECT_EQ(kept.of_type("clock").size(), 3U);
      EXPECT_EQ(kept.of_type("play").size(), 1U);
      EXPECT_EQ(kept.of_type("play")[0]["phase"], "blind");
      kept.session.take(R"({"type":"clock","time_s":0.01})");
      ASSERT_EQ(kept.answers.back()["type"], "error");
      EXPECT_NE(kept.answers.back()["message"].get<std::string>().find("came already"), std::string::npos);
    }

    std::string refusal(const std::string &goal, const std::string &twin)
    {
      try
      {
        SteeredLab steered(steered_model(), goal, twin, steered_lab);
        Pilot      pilot(*std::make_unique<SwimmerTwin>(steered_model(), steered.config.options), steered_model(),
                         *steered.config.steering);
      }
      catch (const InputError &error)
      {
        return error.what();
      }
      return "";
    }

    TEST(SteeringConfig, RefusesWhatCannotBeSteered)
    {
      const std::string reduced = "kind = \"closed-loop\"\n[path]\nshape = \"circle\"\nsize_m = 7.75e-3\n";
      const std::vector<std::array<std::string, 3>> wrong = {
          {reduced, "", "plant = \"external\""},
          {"kind = \"path\"\n[path]\nshape = \"line\"\nsize_m = 1e-2\n[loop]\nplant = \"external\"\n", "",
           "change kind"},
          {std::string(steered_goal) + "[swimmer]\nyoung_modulus_Pa = 8e4\n", "", "has no [swimmer]"},
          {std::string(steered_goal) + "position_gain = 0.5\n", "", "leave it out"},
          {std::string(steered_goal) + "[follower]\ndistance = 1\n", "", "not a known entry"},
          {steered_goal, "safe_T = [9e-3, 0.0]\n", "weaken it"},
          {steered_goal, "valid_s = 0.05\n", "raise it"},
          {steered_goal, "sample_rate_Hz = 9000.0\n", "lower one of them"},
          {steered_goal, "sample_rate_Hz = 10.0\n", "less than 20 samples"},
          {steered_goal, "[field]\nbx_T = 4e-3\nby_T = 4e-3\nfrequency_Hz = 0.8\n", "leave [field] out"},
          {steered_goal, "[filter]\nwindow_s = 0.5\n", "raise it"},
          {"kind = \"closed-loop\"\n[path]\nshape = \"circle\"\nsize_m = 2e-3\n[loop]\nplant = \"external\"\n", "",
           "cannot"}};
      for (const auto &[goal, twin, message] : wrong)
        EXPECT_NE(refusal(goal, twin).find(message), std::string::npos) << message << ": " << refusal(goal, twin);
      EXPECT_EQ(refusal(steered_goal, ""), "");
    }
  } // namespace
} // namespace swimtwin
