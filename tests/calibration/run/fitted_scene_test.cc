#include <calibration/run/fitted_scene.h>

#include <datasets/files/output_folder.h>
#include <datasets/scene/inertia_terms.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/places.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    class FittedScene : public ::testing::Test
    {
    protected:
      FittedScene()
      {
        swimmer.young_modulus_Pa  = 7e4;
        swimmer.viscosity_Pa_s    = 1.4;
        swimmer.magnetization_A_m = 1.2e5;
        swimmer.field_scale       = 1.25;
        data.name                 = "curve";
      }

      /// As `calibrate` leaves it and `simulate` reads it.
      Scene written()
      {
        write_text_atomically(folder.path / fitted_scene_name,
                              fitted_scene(model, swimmer, carried, data, folder.path).text);
        return read_scene(folder.path / fitted_scene_name);
      }

      const ReducedModel    model = read_reduced_model(std::string(places::models) + "/reference-2d.h5");
      const Scene           own   = parse_scene(model.scene_text, "own.toml");
      CalibratedSwimmer     swimmer;
      InertiaTerms          carried;
      ObservationSet        data;
      const TemporaryFolder folder;
    };
  } // namespace

  TEST_F(FittedScene, SwimsInTheDatasSinusoidTimesTheFittedScale)
  {
    data.field        = FieldProgram::sinusoidal(4e-3, 6e-3, 1.);
    const Scene scene = written();
    EXPECT_EQ(scene.tail->young_modulus_Pa, 7e4);
    EXPECT_EQ(scene.fluid->viscosity_Pa_s, 1.4);
    EXPECT_EQ(scene.head.magnetization_A_m, 1.2e5);
    EXPECT_DOUBLE_EQ(scene.field.bx_T(), 5e-3);
    EXPECT_DOUBLE_EQ(scene.field.by_T(), 7.5e-3);
    EXPECT_DOUBLE_EQ(scene.field.period_s(), own.field.period_s());
    EXPECT_FALSE(std::filesystem::exists(folder.path / fitted_field_name));
  }

  TEST_F(FittedScene, SwimsInTheDatasFieldProgramTimesTheFittedScale)
  {
    data.field        = FieldProgram::sampled({0., 0.1, 0.2, 0.3},
                                              {{1e-3, 0., 0.}, {2e-3, 1e-3, 0.}, {1e-3, 0., 0.}, {2e-3, -1e-3, 0.}}, 0.4);
    const Scene scene = written();
    ASSERT_EQ(scene.field.waveform(), FieldProgram::Waveform::sampled);
    EXPECT_DOUBLE_EQ(scene.field.period_s(), own.field.period_s());
    const FieldProgram at_its_frequency = field_at(data, 1. / own.field.period_s());
    for (const double phase : {0.1, 0.35, 0.8})
      for (const std::size_t i : {0u, 1u})
        EXPECT_NEAR(scene.field(phase * scene.field.period_s())[i],
                    1.25 * at_its_frequency(phase * own.field.period_s())[i], 1e-15);
    EXPECT_EQ(scene.tail->young_modulus_Pa, 7e4);
    EXPECT_EQ(FieldProgram::read_csv(folder.path / fitted_field_name).period_s(), scene.field.period_s());

    data.field = FieldProgram::sinusoidal(4e-3, 6e-3, 1.); // again, with other data: nothing old is left
    EXPECT_EQ(written().field.waveform(), FieldProgram::Waveform::sinusoidal);
    EXPECT_FALSE(std::filesystem::exists(folder.path / fitted_field_name));
    EXPECT_FALSE(std::filesystem::exists(folder.path / fitted_field_period_name));
  }

  TEST_F(FittedScene, HasTheInertiaThatTheFitCarried)
  {
    data.field = own.field;
    EXPECT_EQ(written().fluid->inertia, Inertia::none);
    carried = all_inertia;
    EXPECT_EQ(names_of(inertia_terms(written())).size(), 4u);
    const FieldProgram field = FieldProgram::sinusoidal(5e-3, 5e-3, 0.5);
    EXPECT_EQ(names_of(inertia_terms(scene_of_observation(model, swimmer, carried, field, 3))).size(), 4u);
    EXPECT_TRUE(names_of(inertia_terms(scene_of_observation(model, swimmer, {}, field, 3))).empty());
  }

  TEST_F(FittedScene, KnowsWhatFullOrderRunsCanRepeat)
  {
    data.field = FieldProgram::sinusoidal(5e-3, 5e-3, 0.5);
    EXPECT_NO_THROW(require_repeatable({data}));
    data.period.reset();
    EXPECT_THROW(require_repeatable({data}), InputError);
    data.period = 3;
    data.field  = FieldProgram::sampled({0., 0.5, 1., 1.5},
                                        {{1e-3, 0., 0.}, {0., 1e-3, 0.}, {-1e-3, 0., 0.}, {0., -1e-3, 0.}}, 2.);
    EXPECT_THROW(require_repeatable({data}), InputError);
  }

  TEST_F(FittedScene, ScalesEveryLength)
  {
    data.field             = own.field;
    swimmer.geometry_scale = 2.;
    const Scene scene      = written();
    EXPECT_DOUBLE_EQ(scene.body_length_m(), 2. * own.body_length_m());
    EXPECT_DOUBLE_EQ(scene.domain->size_m[1], 2. * own.domain->size_m[1]);
    EXPECT_DOUBLE_EQ(scene.numerics.mesh_size_m, 2. * own.numerics.mesh_size_m);
  }
} // namespace swimtwin
