#include <rom/training/aim.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    Attempt first(const double error, const double fit)
    {
      return {{}, error, fit, false};
    }
  } // namespace

  TEST(Aim, MendsTheFitWhereTheFitIsTheError)
  {
    EXPECT_EQ(next_remedy({first(.03, .02)}), Remedy::finer_fit);
    EXPECT_EQ(next_remedy({first(.03, .02), {Remedy::finer_fit, .02, .015}}), Remedy::more_samples);
    EXPECT_EQ(next_remedy({first(.03, .02), {Remedy::finer_fit, .04, .03}}), Remedy::more_samples); // it costs nothing
  }

  TEST(Aim, AddsAModeWhereTheFitIsNotOnceItIsFinest)
  {
    std::vector<Attempt> attempts{first(.03, .005)};
    EXPECT_EQ(next_remedy(attempts), Remedy::finer_fit);
    attempts.push_back({Remedy::finer_fit, .029, .004});
    EXPECT_EQ(next_remedy(attempts), Remedy::another_mode);
    attempts.push_back({Remedy::another_mode, .015, .002});
    EXPECT_EQ(next_remedy(attempts), Remedy::finer_fit);
    attempts.push_back({Remedy::finer_fit, .015, .002});
    EXPECT_EQ(next_remedy(attempts), Remedy::another_mode);
  }

  TEST(Aim, GivesWayToTheOtherRemedyWhereOneDoesNotHelp)
  {
    EXPECT_EQ(next_remedy({first(.03, .005), {Remedy::another_mode, .029, .005}}), Remedy::finer_fit);
    EXPECT_EQ(next_remedy({first(.03, .02), {Remedy::finer_fit, .03, .02}, {Remedy::more_samples, .03, .02}}),
              Remedy::another_mode);
  }

  TEST(Aim, AddsRunsWhereNeitherHelpsAndEndsWhereTheyDoNotEither)
  {
    for (std::vector<Attempt> attempts : {std::vector<Attempt>{first(.03, .02),
                                                               {Remedy::finer_fit, .03, .02},
                                                               {Remedy::more_samples, .03, .02},
                                                               {Remedy::another_mode, .03, .02}},
                                          std::vector<Attempt>{first(.03, .005),
                                                               {Remedy::another_mode, .03, .005},
                                                               {Remedy::finer_fit, .03, .005},
                                                               {Remedy::more_samples, .03, .005}}})
    {
      EXPECT_EQ(next_remedy(attempts), Remedy::more_runs);
      attempts.push_back({Remedy::more_runs, .03, .005});
      EXPECT_FALSE(next_remedy(attempts));
    }
  }

  TEST(Aim, AddsRunsFirstWhereHeldOutOnesLeaveTheShapes)
  {
    std::vector<Attempt> attempts{first(.03, .02), {Remedy::finer_fit, .03, .02, true}};
    EXPECT_EQ(next_remedy(attempts), Remedy::more_runs);
    attempts.push_back({Remedy::more_runs, .02, .015, true});
    EXPECT_EQ(next_remedy(attempts), Remedy::finer_fit); // of the new shapes' samples
    attempts.push_back({Remedy::finer_fit, .02, .015, true});
    EXPECT_EQ(next_remedy(attempts), Remedy::more_runs); // which have helped
    attempts.push_back({Remedy::more_runs, .0199, .015, true});
    attempts.push_back({Remedy::finer_fit, .0199, .015, true});
    EXPECT_EQ(next_remedy(attempts), Remedy::more_samples);
  }

  TEST(Aim, WhatCannotBeHadGivesWay)
  {
    const std::vector<Attempt> attempts{first(.03, .005), {Remedy::finer_fit, .03, .005, true}};
    EXPECT_EQ(next_remedy(attempts, [](const Remedy r) { return r != Remedy::more_runs; }), Remedy::another_mode);
    EXPECT_EQ(next_remedy(attempts, [](const Remedy r) { return r == Remedy::more_samples; }), Remedy::more_samples);
    EXPECT_FALSE(next_remedy(attempts, [](Remedy) { return false; }));
    EXPECT_EQ(next_remedy({first(.03, .005), {Remedy::finer_fit, .03, .005}, {Remedy::more_samples, .03, .005}},
                          [](const Remedy r) { return r != Remedy::another_mode; }),
              Remedy::more_runs);
  }

  TEST(Aim, AModeMayHelpOnceRunsHave)
  {
    std::vector<Attempt> attempts{first(.03, .005),
                                  {Remedy::finer_fit, .03, .005},
                                  {Remedy::another_mode, .03, .005},
                                  {Remedy::more_samples, .03, .005},
                                  {Remedy::more_runs, .02, .005},
                                  {Remedy::finer_fit, .02, .005}};
    EXPECT_EQ(next_remedy(attempts), Remedy::another_mode);
    attempts[4].error = attempts[5].error = .04; // taken back
    EXPECT_FALSE(next_remedy(attempts));
  }

  TEST(Aim, DoesNotGoRoundInCircles)
  {
    std::vector<Attempt> attempts{first(.017, .003), {Remedy::another_mode, .020, .003}};
    EXPECT_EQ(next_remedy(attempts), Remedy::finer_fit); // of the modes before: the fifth was taken back
    attempts.push_back({Remedy::finer_fit, .017, .003});
    EXPECT_EQ(next_remedy(attempts), Remedy::more_samples);
    attempts.push_back({Remedy::more_samples, .014, .003});
    EXPECT_EQ(next_remedy(attempts), Remedy::more_samples); // which help; the mode would be the same one
    attempts.push_back({Remedy::more_samples, .0139, .003});
    EXPECT_EQ(next_remedy(attempts), Remedy::more_runs);
    attempts.push_back({Remedy::more_runs, .0139, .003});
    EXPECT_FALSE(next_remedy(attempts));
  }

  TEST(Aim, ASecondModeStartsFromTheUsualFit)
  {
    EXPECT_EQ(next_remedy({first(.03, .02), {Remedy::finer_fit, .02, .005}, {Remedy::another_mode, .015, .012}}),
              Remedy::finer_fit);
  }

  TEST(Aim, SaysWhatTheFitMakes)
  {
    TrainingRecord record;
    HeldOutRun     run;
    run.displacement_m         = 1e-4;
    run.reduced_displacement_m = 1.04e-4;
    run.fit_change_m           = 3e-6;
    record.held_out_runs       = {run};
    EXPECT_NEAR(fit_share(record), .03, 1e-12);
    EXPECT_NE(cause_of(record, {.05, .05}).find("makes 3 % of 4 % (rms); more --samples"), std::string::npos);
    record.held_out_runs[0].fit_change_m = 1e-7;
    EXPECT_NE(cause_of(record, {.03, .01})
                  .find("the place along the domain, which no variable of the model knows, is worth up "
                        "to 3 %: a longer domain would help"),
              std::string::npos);
    record.velocity_error_rms = .005;
    EXPECT_NE(cause_of(record, {.03, .025})
                  .find("velocities at shapes not trained on are off by 0.5 %, worth up to 2.5 % "
                        "of the displacement: more --samples"),
              std::string::npos);
    EXPECT_NE(cause_of(record, {.003, .003}).find("the rest comes from the modes"), std::string::npos);
  }
} // namespace swimtwin
