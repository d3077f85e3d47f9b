#include <rom/swimmer/carried_inertia.h>
#include <tests/twin/open_swimmer.h>
#include <twin/estimate/swimmer_twin.h>
#include <twin/lab/laboratory.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    constexpr double lab_frequency_Hz = 0.8;

    struct Trial
    {
      ReducedModel      model = open_model();
      ReducedSwimmer    swimmer{model};
      TailAxis          axis{model.tail};
      LaboratoryOptions lab;
      TwinOptions       twin;

      explicit Trial(const unsigned int seed)
      {
        twin       = default_twin_options(model, open_parameters(model), lab_frequency_Hz);
        twin.noise = {2.5e-8, 1e-4, 1e-4 * model.resistance.coordinate_scale_m.head(model.n_modes())};
        twin.parameters[TwinParameter::stiffness]     = {0., 0.1, 1e-4};
        twin.parameters[TwinParameter::magnetization] = {0., 0.1, 1e-4};
        lab.nominal                                   = twin.nominal;
        lab.noise                                     = twin.noise;
        lab.seed                                      = seed;
        lab.largest_step_s                            = twin.largest_step_s;
        lab.camera.position_sigma_m                   = 0.003 * swimmer.length_m();
        lab.camera.angle_sigma_rad                    = 0.0175;
        lab.truth                                     = twin.parameters;
        std::mt19937_64                  random(1000 + seed);
        std::normal_distribution<double> normal;
        for (DriftingParameter &p : lab.truth.list)
          p.value += p.standard_deviation * normal(random);
        lab.first_state = Eigen::VectorXd::Zero(swimmer.n_states());
        for (int i = 3; i < swimmer.n_states(); ++i)
          lab.first_state[i] = twin.start.shape_sd_m[i - 3] * normal(random);
      }
    };

    /// Chi-squared of the last belief; its size is the number of states.
    double last_error_squared(const Trial &trial, const int n_frames, Eigen::Index &n_states)
    {
      ReducedLaboratory imagined(trial.swimmer, trial.axis, trial.lab);
      Laboratory       &lab = imagined.lab;
      SwimmerTwin       twin(trial.model, trial.twin);
      for (FieldSignal *field : {&lab.command(), &twin.field()})
        field->play_sinusoid(0., 4e-3, 4e-3, lab_frequency_Hz);
      for (int i = 0; i < n_frames; ++i)
        if (const CapturedFrame frame = lab.next_frame(); !frame.observations.empty())
          twin.see(frame.stamp_s, frame.observations);
      Belief belief = twin.belief();
      belief.mean.head(trial.swimmer.n_states()) +=
          (lab.now_s() - twin.now_s()) * twin.process().rate(twin.now_s(), belief.mean);
      n_states = belief.size();
      return belief.distance_squared(imagined.swimmer.truth_in(twin.layout()));
    }

    // The sum of eight chi-squared with nine degrees of freedom lies between 44 and 105 with 99.9 %.
    TEST(SwimmerTwin, KnowsHowFarItIsOff)
    {
      double       sum = 0.;
      Eigen::Index n   = 0;
      for (unsigned int seed = 1; seed <= 8; ++seed)
        sum += last_error_squared(Trial(seed), 200, n);
      EXPECT_EQ(n, 9);
      EXPECT_GT(sum, 40.);
      EXPECT_LT(sum, 110.);
    }

    TEST(SwimmerTwin, KnowsItWithOutliersAndMissingFramesToo)
    {
      double       sum = 0., naive = 0.;
      Eigen::Index n = 0;
      for (unsigned int seed = 1; seed <= 4; ++seed)
      {
        Trial trial(seed);
        trial.lab.camera.missing_share = 0.2;
        trial.lab.camera.outlier_share = 0.05;
        trial.lab.camera.outlier_m     = 0.5 * trial.swimmer.length_m();
        trial.lab.camera.dark          = {{3., 4.}};
        sum += last_error_squared(trial, 200, n);
        trial.twin.filter.robustness = {1e9, 1e9};
        naive += last_error_squared(trial, 200, n);
      }
      EXPECT_LT(sum, 75.); // 36 are expected; 99.9 % lie below 68
      EXPECT_GT(naive, 1000.);
    }

    TEST(SwimmerTwin, FindsTheDelayOfTheCamera)
    {
      Trial trial(3);
      trial.lab.truth[TwinParameter::camera_delay]       = {0.183, 1., 0.};
      trial.twin.parameters[TwinParameter::camera_delay] = {0.125, 0.07, 1e-5};
      ReducedLaboratory imagined(trial.swimmer, trial.axis, trial.lab);
      Laboratory       &lab = imagined.lab;
      SwimmerTwin       twin(trial.model, trial.twin);
      for (FieldSignal *field : {&lab.command(), &twin.field()})
        field->play_sinusoid(0., 4e-3, 4e-3, lab_frequency_Hz);
      for (int i = 0; i < 200; ++i)
        if (const CapturedFrame frame = lab.next_frame(); !frame.observations.empty())
          twin.see(frame.stamp_s, frame.observations);
      EXPECT_FALSE(twin.is_searching_delay());
      EXPECT_NEAR(twin.belief().mean[twin.layout().place(TwinParameter::camera_delay)], 0.183, 0.002);
    }

    /// E/mu over its truth, and how many standard deviations it is off.
    std::pair<double, double> stiffness_found(const ReducedModel &model, const LaboratoryOptions &seen_in,
                                              const InertialDensities &densities)
    {
      const ReducedSwimmer swimmer(model, seen_in.densities);
      const TailAxis       axis(model.tail);
      ReducedLaboratory    imagined(swimmer, axis, seen_in);
      Laboratory          &lab                         = imagined.lab;
      TwinOptions          options                     = default_twin_options(model, seen_in.nominal, 1.);
      options.densities                                = densities;
      options.parameters[TwinParameter::stiffness]     = {0., 0.1, 1e-3};
      options.parameters[TwinParameter::magnetization] = {0., 0.1, 1e-3};
      SwimmerTwin twin(model, options);
      for (FieldSignal *field : {&lab.command(), &twin.field()})
        field->play_sinusoid(0., 5e-3, 5e-3, 1.);
      for (int i = 0; i < 600; ++i)
        if (const CapturedFrame frame = lab.next_frame(); !frame.observations.empty())
          twin.see(frame.stamp_s, frame.observations);
      const int    place = twin.layout().place(TwinParameter::stiffness);
      const double off   = twin.belief().mean[place] - seen_in.truth[TwinParameter::stiffness].value;
      return {std::exp(off), std::abs(off) / twin.belief().standard_deviation(place)};
    }

    // A head as dense as the reference's swings a little later, which a swimmer without inertia can only be stiffer
    // for.
    TEST(SwimmerTwin, KnowsASwimmerWithInertiaIfItHasIt)
    {
      const ReducedModel model = read_reduced_model(std::string(places::models) + "/reference-2d.h5");
      LaboratoryOptions  lab;
      lab.nominal   = open_parameters(model);
      lab.densities = inertial_densities(model, carried_inertia(model, "full", extreme_of(lab.nominal, 1.)));
      lab.truth[TwinParameter::stiffness]     = {0.1, 1., 0.};
      lab.truth[TwinParameter::magnetization] = {0.1, 1., 0.};
      lab.camera.position_sigma_m             = 2e-5;
      lab.camera.angle_sigma_rad              = 0.0175;
      lab.camera.tail_shares                  = {0.5};
      const auto [with, sigmas_with]          = stiffness_found(model, lab, lab.densities);
      const auto [without, sigmas_without]    = stiffness_found(model, lab, {});
      EXPECT_NEAR(with, 1., 0.03);
      EXPECT_LT(sigmas_with, 3.);
      EXPECT_GT(without, 1.08);
      EXPECT_GT(sigmas_without, 5.);
    }

    TEST(SwimmerTwin, EndsAlikeWhenFramesComeLateAndShuffled)
    {
      Trial             trial(5);
      ReducedLaboratory imagined(trial.swimmer, trial.axis, trial.lab);
      Laboratory       &lab = imagined.lab;
      lab.command().play_sinusoid(0., 4e-3, 4e-3, lab_frequency_Hz);
      std::vector<CapturedFrame> frames;
      for (int i = 0; i < 120; ++i)
        frames.push_back(lab.next_frame());
      SwimmerTwin ordered(trial.model, trial.twin), shuffled(trial.model, trial.twin);
      for (SwimmerTwin *twin : {&ordered, &shuffled})
        twin->field().play_sinusoid(0., 4e-3, 4e-3, lab_frequency_Hz);
      for (const CapturedFrame &frame : frames)
        ordered.see(frame.stamp_s, frame.observations);
      std::mt19937 engine(1);
      for (std::size_t i = 0; i + 8 < frames.size(); i += 8) // the first one, too
        std::shuffle(frames.begin() + static_cast<long>(i), frames.begin() + static_cast<long>(i) + 8, engine);
      for (const CapturedFrame &frame : frames)
        shuffled.see(frame.stamp_s, frame.observations);
      EXPECT_EQ(ordered.belief().mean, shuffled.belief().mean);
      EXPECT_EQ(ordered.belief().root, shuffled.belief().root);
    }
  } // namespace
} // namespace swimtwin
