#include <tests/twin/run/imagined_stream.h>
#include <twin/stream/line_reader.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    const ReducedModel &model()
    {
      static const ReducedModel read = open_model();
      return read;
    }

    std::string frame(const double time_s, const std::string &rest = R"("x_m":0,"y_m":0,"angle_rad":0)")
    {
      return fmt::format(R"({{"type":"frame","time_s":{},{}}})", time_s, rest);
    }

    bool contains(const std::vector<std::string> &names, const std::string &start)
    {
      return std::any_of(names.begin(), names.end(), [&](const std::string &n) { return n.starts_with(start); });
    }

    TEST(TwinSession, AnswersEachFrameWithAnEstimateAndLearns)
    {
      KeptSession kept(model(), twin_config(model(), plain_twin));
      kept.session.greet();
      kept.take_all(lab_lines(model(), std::string(short_lab) + "[swimmer]\nmagnetization_A_m = 1.9e5\n"));
      kept.session.finish();
      EXPECT_EQ(kept.of_type("estimate").size(), 180U);
      EXPECT_TRUE(kept.of_type("error").empty());
      EXPECT_GE(kept.of_type("forecast").size(), 4U);
      EXPECT_EQ(kept.answers.front()["type"], "twin");
      EXPECT_EQ(kept.answers.back()["frames"], 180);
      const auto parameters = kept.of_type("estimate").back()["parameters"];
      const auto magnet     = parameters["magnetization_over_viscosity_A_m_Pa_s"];
      EXPECT_NEAR(magnet["value"].get<double>() / (1.9e5 / 1.52), 1., 0.03);
      EXPECT_TRUE(kept.alarms().empty());
      for (const auto &answer : kept.answers)
        EXPECT_EQ(answer["version"], stream_version);
    }

    struct Hostile
    {
      std::string line, message;
    };

    TEST(TwinSession, AnswersHostileLinesWithTheirNumberAndARemedyAndGoesOn)
    {
      const std::vector<Hostile> lines = {
          {R"({"type":"frame","time_s":0.5,"x_m":0)", "cut short"},
          {R"({"type":"frame","time_s":0.5,"x_m":NaN,"y_m":0})", "not JSON"},
          {R"({"type":"frame","time_s":0.5,"x_m":1e999,"y_m":0})", "not JSON"},
          {R"({"type":"frame","time_s":0.5,"x_m":1e200,"y_m":0})", "check its unit"},
          {R"({"type":"frame","time_s":0.5,"x_m":"0","y_m":0})", "not a number"},
          {R"({"type":"frame","time_s":0.5,"x_m":true,"y_m":0})", "not a number"},
          {R"({"type":"frame","time_s":0.5,"x_m":[0],"y_m":0})", "not a number"},
          {R"({"type":"frame","x_m":0,"y_m":0})", "lacks time_s"},
          {R"({"type":"frame","time_s":0.5,"x_m":0})", "x_m without y_m"},
          {R"({"type":"frame","time_s":0.5})", "shows nothing"},
          {R"({"type":"frame","time_s":0.5,"x_m":0,"y_m":0,"angel_rad":0})", "did you mean angle_rad"},
          {R"({"type":"frame","time_s":0.5,"x_m":0,"y_m":0,"position_sigma_m":-1})", "not positive"},
          {R"({"type":"frame","time_s":0.5,"points":[{"name":"fin","x_m":0,"y_m":0}]})", "[camera.points]"},
          {R"({"type":"frame","time_s":0.5,"points":{"x_m":0}})", "no array"},
          {R"({"type":"frame","time_s":0.5,"points":[3]})", "no object"},
          {R"({"type":"frames","time_s":0.5})", "did you mean frame"},
          {R"({"time_s":0.5})", "lacks its type"},
          {R"({"type":"field","time_s":0.5,"bx_T":5})", "lacks by_T"},
          {R"({"type":"drive","time_s":0.5,"bx_T":0,"by_T":0,"frequency_Hz":0})", "not positive"},
          {R"({"type":"frame","version":2,"time_s":0.5,"x_m":0,"y_m":0})", "speaks version 1"},
          {R"({"type":"clock"})", "lacks time_s"},
          {R"({"type":"play","time_s":0,"until_s":1})", "lacks samples"},
          {R"({"type":"play","time_s":0,"until_s":1,"samples":[[0,0]]})", "three numbers"},
          {R"({"type":"play","time_s":0,"until_s":1,"samples":[[0,0,"1"]]})", "three numbers"},
          {R"({"type":"play","time_s":0,"until_s":1,"samples":[[0,50,0]]})", "out of bounds"},
          {R"({"type":"play","time_s":0,"until_s":1,"samples":[[1,0,0],[0.5,0,0]]})", "not in order"},
          {R"([1,2,3])", "no object"},
          {"null", "no object"},
          {"\x01\x02\xff", "not JSON"},
          {std::string(5000, '['), "cut short"},
          {frame(1e9), "largest_gap_s"},
          {frame(-3.), "before the window"},
          {R"({"type":"frame","time_s":0.5,"x_m":0,"y_m":0} trailing)", "not JSON"}};
      KeptSession kept(model(), twin_config(model(), plain_twin));
      kept.session.take(frame(0.1));
      long number = 1;
      for (const Hostile &hostile : lines)
      {
        const std::size_t before = kept.answers.size();
        kept.session.take(hostile.line);
        ++number;
        ASSERT_EQ(kept.answers.size(), before + 1) << hostile.line;
        EXPECT_EQ(kept.answers.back()["type"], "error") << hostile.line;
        EXPECT_EQ(kept.answers.back()["line"], number);
        EXPECT_NE(kept.answers.back()["message"].get<std::string>().find(hostile.message), std::string::npos)
            << kept.answers.back()["message"];
      }
      kept.session.refuse_line(LineReader::too_long_sentence());
      EXPECT_EQ(kept.answers.back()["line"], number + 1);
      kept.session.take(frame(0.2));
      EXPECT_EQ(kept.answers.back()["type"], "estimate");
    }

    TEST(TwinSession, GoesOnFromItsMemoryAsIfNothingHadHappened)
    {
      const auto  lines  = lab_lines(model(), short_lab);
      const auto  config = twin_config(model(), std::string(plain_twin) + "[parameters.background_bx_T]\nsd = 1e-4\n");
      KeptSession whole(model(), config), first(model(), config), second(model(), config);
      whole.take_all(lines);
      first.take_all({lines.begin(), lines.begin() + 120});
      second.session.restore(nlohmann::ordered_json::parse(first.session.memory().dump()));
      second.take_all({lines.begin() + 120, lines.end()});
      EXPECT_EQ(whole.estimates.back().belief.mean, second.estimates.back().belief.mean);
      EXPECT_EQ(whole.estimates.back().belief.root, second.estimates.back().belief.root);
      EXPECT_EQ(whole.session.counts().n_lines, second.session.counts().n_lines);
    }

    TEST(TwinSession, RefusesAMemoryOfAnotherConfiguration)
    {
      KeptSession first(model(), twin_config(model(), plain_twin));
      first.take_all(lab_lines(model(), "duration_s = 0.5\n"));
      KeptSession other(model(),
                        twin_config(model(), std::string(plain_twin) + "[parameters.flow_x_m_s]\nsd = 1e-5\n"));
      EXPECT_THROW(other.session.restore(first.session.memory()), InputError);
      EXPECT_THROW(other.session.restore({{"counts", 3}}), InputError);
    }

    TEST(TwinSession, SmoothsWithoutForecasts)
    {
      KeptSession kept(model(), twin_config(model(), std::string(plain_twin) +
                                                         "[output]\nforecast_periods = 0.0\nsmoothing_lag_s = 0.5\n"));
      kept.take_all(lab_lines(model(), short_lab));
      EXPECT_TRUE(kept.of_type("forecast").empty());
      EXPECT_GE(kept.of_type("smoothed").size(), 3U);
    }

    TEST(TwinSession, ForgetsDrivesThatNoFrameCanBeAboutAnyMore)
    {
      KeptSession kept(model(), twin_config(model(), plain_twin));
      for (int i = 0; i < 400; ++i)
      {
        kept.session.take(
            fmt::format(R"({{"type":"drive","time_s":{},"bx_T":4e-3,"by_T":4e-3,"frequency_Hz":0.8}})", 0.05 * i));
        kept.session.take(frame(0.05 * (i + 1)));
      }
      // The window is two and a half seconds, and a period before it is kept.
      EXPECT_LT(kept.session.twin().field().programs().size(), 100U);
    }

    TEST(TwinSession, SaysWhatTheMotionCannotTell)
    {
      // Where nothing but the field prefers a place, a camera's offset is one with the swimmer's position.
      KeptSession kept(model(),
                       twin_config(model(), std::string(plain_twin) + "[parameters.camera_offset_x_m]\nsd = 1e-3\n"));
      kept.take_all(lab_lines(model(), short_lab));
      kept.session.finish();
      const auto open = kept.of_type("open").back()["keeps_its_prior"];
      ASSERT_EQ(open.size(), 1U);
      EXPECT_TRUE(open[0]["direction"].contains("camera_offset_x_m"));
      EXPECT_GT(open[0]["variance_left"].get<double>(), 0.98);
    }

    TEST(TwinSession, BarksWhenSightIsLostAndWhenItIsBack)
    {
      KeptSession kept(model(), twin_config(model(), plain_twin));
      kept.take_all(lab_lines(model(), std::string(short_lab) + "[camera]\ndark_1_s = [3.0, 4.5]\n"));
      ASSERT_EQ(kept.of_type("alarm").size(), 2U);
      EXPECT_EQ(kept.of_type("alarm")[0]["name"], "sight-lost");
      EXPECT_NEAR(kept.of_type("alarm")[0]["since_s"].get<double>(), 3., 0.05);
      EXPECT_TRUE(kept.of_type("alarm")[1]["over"]);
    }

    // A laboratory that is slower than the wall clock, as one with a full-order swimmer: its clock counts.
    TEST(TwinSession, DoesNotTakeASlowClockForDarkness)
    {
      for (const bool has_clock : {false, true})
      {
        KeptSession kept(model(), twin_config(model(), plain_twin));
        for (const std::string &line : lab_lines(model(), "duration_s = 2\n[coils]\nbx_T = 4e-3\nby_T = 4e-3\n"
                                                          "frequency_Hz = 0.8\n"))
        {
          kept.session.take(line);
          if (const double time_s = nlohmann::json::parse(line).value("time_s", 0.); has_clock && time_s > 0.)
            kept.session.take(fmt::format(R"({{"type":"clock","time_s":{}}})", time_s));
          kept.session.wait(5.);
        }
        EXPECT_EQ(contains(kept.alarms(), "sight-lost"), !has_clock);
      }
    }

    // The next client may have no clock, and darkness is darkness again.
    TEST(TwinSession, ForgetsTheClockOfAClientThatWent)
    {
      KeptSession kept(model(), twin_config(model(), plain_twin));
      kept.take_all(lab_lines(model(), short_lab));
      kept.session.take(R"({"type":"clock","time_s":6})");
      kept.session.wait(5.);
      EXPECT_FALSE(contains(kept.alarms(), "sight-lost"));
      kept.session.greet();
      kept.session.wait(5.);
      EXPECT_TRUE(contains(kept.alarms(), "sight-lost"));
    }

    TEST(TwinSession, BarksAtAFrozenPicture)
    {
      KeptSession kept(model(), twin_config(model(), plain_twin));
      auto        lines = lab_lines(model(), short_lab);
      kept.take_all({lines.begin(), lines.begin() + 100});
      auto still = nlohmann::json::parse(lines[99]);
      for (int i = 0; i < 25; ++i)
      {
        still["time_s"] = still["time_s"].get<double>() + 1. / 30.;
        kept.session.take(still.dump());
      }
      EXPECT_TRUE(contains(kept.alarms(), "frozen"));
    }

    TEST(TwinSession, NamesWhatJumped)
    {
      std::string lab = "duration_s = 20\n[coils]\nbx_T = 4e-3\nby_T = 4e-3\nfrequency_Hz = 0.8\n"
                        "[change]\ntime_s = 14\nstiffness_factor = 0.5\n";
      std::string precise =
          "[model_error]\nposition_per_root_s = 1e-5\nangle_rad_per_root_s = 1e-4\nshape_factor = 0.02\n";
      KeptSession kept(model(), twin_config(model(), plain_twin + precise));
      kept.take_all(lab_lines(model(), lab));
      EXPECT_TRUE(contains(kept.alarms(), "jump: stiffness"));
    }

    TEST(TwinSession, FindsThePoseAgainAfterAClockThatBeganAnew)
    {
      KeptSession kept(model(), twin_config(model(), plain_twin));
      for (int i = 0; i < 100; ++i)
        kept.session.take(frame(1000. + i / 30.));
      for (int i = 0; i < 40; ++i)
        kept.session.take(frame(i / 30.));
      EXPECT_EQ(kept.of_type("error").size(), 29U);
      EXPECT_TRUE(contains(kept.alarms(), "clock-jumped"));
      EXPECT_NEAR(kept.of_type("estimate").back()["time_s"].get<double>(), 39. / 30., 1e-9);
    }

    TEST(TwinSession, FindsThePoseAgainWhenTheSwimmerWasMoved)
    {
      KeptSession kept(model(), twin_config(model(), plain_twin));
      auto        lines = lab_lines(model(), short_lab);
      for (std::size_t i = 0; i < lines.size(); ++i)
      {
        auto json = nlohmann::json::parse(lines[i]);
        if (i > 90)
          json["x_m"] = json["x_m"].get<double>() + 0.03;
        kept.session.take(json.dump());
      }
      EXPECT_TRUE(contains(kept.alarms(), "sight-lost"));
      EXPECT_NEAR(kept.of_type("estimate").back()["x_m"].get<double>(),
                  nlohmann::json::parse(lines.back())["x_m"].get<double>() + 0.03, 2e-4);
    }

    TEST(TwinSession, IsNotLedAstrayByOutliersAtTheStart)
    {
      KeptSession kept(model(), twin_config(model(), plain_twin));
      auto        lines = lab_lines(model(), short_lab);
      for (const std::size_t i : {3U, 5U, 8U, 11U})
      {
        auto json         = nlohmann::json::parse(lines[i]);
        json["x_m"]       = json["x_m"].get<double>() + 0.004;
        json["angle_rad"] = json["angle_rad"].get<double>() + 2.;
        lines[i]          = json.dump();
      }
      kept.take_all(lines);
      const auto magnet = kept.of_type("estimate").back()["parameters"]["magnetization_over_viscosity_A_m_Pa_s"];
      const auto truth  = open_parameters(model());
      EXPECT_NEAR(magnet["value"].get<double>() / (truth.magnetization_A_m / truth.viscosity_Pa_s), 1., 0.02);
      EXPECT_TRUE(kept.alarms().empty());
    }

    TEST(TwinSession, TakesAFieldThatWasMeasured)
    {
      KeptSession kept(model(), twin_config(model(), "[filter]\nlargest_step_s = 0.03\n"));
      const auto  lines = lab_lines(model(), short_lab);
      FieldSignal field;
      field.play_sinusoid(0., 4e-3, 4e-3, 0.8);
      double told_s = 0.;
      for (const std::string &line : lines)
      {
        const auto json = nlohmann::json::parse(line);
        if (json["type"] != "frame")
          continue;
        for (; told_s <= json["time_s"].get<double>() + 0.01; told_s += 0.005)
          kept.session.take(nlohmann::json{
              {"type", "field"},
              {"time_s", told_s},
              {"bx_T", field.value_T(told_s).x()},
              {"by_T", field.value_T(told_s).y()},
              {"sigma_T", 1e-5}}.dump());
        kept.session.take(line);
      }
      EXPECT_TRUE(kept.of_type("error").empty());
      EXPECT_TRUE(kept.alarms().empty());
      EXPECT_LT(std::abs(kept.estimates.back().belief.mean[2]), 1.);
    }
  } // namespace
} // namespace swimtwin
