#include <datasets/system/error.h>
#include <rom/swimmer/driving_field.h>
#include <tests/datasets/temporary_folder.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    void expect_slopes(const Drive &drive)
    {
      for (const double phase : {0., 0.03, 0.31, 0.77, 3.4})
      {
        const Eigen::Matrix2Xd slopes = drive.field->slopes(phase, drive.parameters);
        ASSERT_EQ(slopes.cols(), drive.parameters.size());
        ASSERT_EQ(drive.field->parameter_names().size(), static_cast<std::size_t>(slopes.cols()));
        // The fields are linear in their parameters.
        EXPECT_LE((slopes * drive.parameters - drive.field->value_T(phase, drive.parameters)).norm(), 1e-18);
      }
    }
  } // namespace

  TEST(Drives, PlayTheSinusoid)
  {
    const FieldProgram program = FieldProgram::sinusoidal(5e-3, 4e-3, 0.8);
    const Drive        drive   = make_drive(program);
    EXPECT_NEAR(drive.frequency_Hz, 0.8, 1e-15);
    for (const double time_s : {0., 0.2, 0.9, 2.1})
      EXPECT_NEAR(drive.field->value_T(0.8 * time_s, drive.parameters).y(), program(time_s)[1], 1e-16);
    expect_slopes(drive);
  }

  TEST(Drives, PlayASampledProgram)
  {
    std::vector<double>                time_s;
    std::vector<std::array<double, 3>> b_T;
    for (int i = 0; i < 5; ++i)
    {
      time_s.push_back(0.1 + 0.4 * i);
      b_T.push_back({1e-3 * i, 2e-3 * std::cos(i), 0.});
    }
    const FieldProgram program = FieldProgram::sampled(time_s, b_T, 2.);
    const Drive        drive   = make_drive(program);
    EXPECT_EQ(drive.frequency_Hz, 0.5);
    EXPECT_EQ(drive.field->kinks().size(), 5u);
    for (const double t : {0., 0.05, 0.1, 0.77, 1.7, 1.99, 5.3})
    {
      const auto            expected = program(t);
      const Eigen::Vector2d found    = drive.field->value_T(t / 2., drive.parameters);
      EXPECT_NEAR(found.x(), expected[0], 1e-16);
      EXPECT_NEAR(found.y(), expected[1], 1e-16);
    }
    expect_slopes(drive);
  }

  TEST(Drives, RefuseWhatLeavesThePlane)
  {
    expect_in(message_of<InputError>([] {
                make_drive(FieldProgram::sinusoidal(5e-3, 5e-3, 1., {1e-3, 0.}));
              }),
              "[field] of the scene has a component along z, and the reduced swimmer moves in the plane");
  }

  TEST(Drives, RefuseWhatIsNotPeriodic)
  {
    expect_in(message_of<InputError>([] { make_drive(FieldProgram::constant(1e-3, 0.)); }), "has no period");
    FieldProgram ramped = FieldProgram::sinusoidal(5e-3, 5e-3, 1.);
    ramped.ramp_s       = 2.;
    expect_in(message_of<InputError>([&] { make_drive(ramped); }), "ramp_s = 2");
  }
} // namespace swimtwin
