#include <rom/training/training_options.h>

#include <datasets/scene/mirror_plane.h>
#include <datasets/system/error.h>
#include <rom/training/run_parameters.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    void require(const Scene &scene, const bool condition, const char *reason, const char *remedy)
    {
      if (!condition)
        throw InputError(fmt::format("{} cannot be trained: {}; {}", scene.name, reason, remedy));
    }

    bool walls_are_still(const Domain &domain)
    {
      for (const auto &[name, wall] : domain.walls)
        if (wall.condition == WallCondition::moving_wall || wall.condition == WallCondition::inflow ||
            wall.condition == WallCondition::shear_flow)
          return false;
      return true;
    }
  } // namespace

  namespace
  {
    void require_motion_in_plane(const Scene &scene)
    {
      require(scene, !scene.has_surfaces(),
              "it has walls or a body from surface files, which a model cannot carry along",
              "run it with simulate, or use a domain and a head that are known by their shapes");
      require(scene, scene.head.magnetization_direction == (std::array{1., 0., 0.}),
              "its [head] magnetization_direction is not the body's +x, along which the reduced swimmer's head is "
              "magnetised",
              "run it with simulate, or take the direction out");
      require(scene, !scene.field.leaves_plane(),
              "the field leaves the plane of x and y, and the reduced swimmer moves in it", "set bz_T to zero");
      require(scene, moves_in_plane(scene), "half of it is not solved by itself, and the reduced swimmer is",
              "leave [numerics] symmetric_half at \"auto\"");
    }
  } // namespace

  TrainingOptions options_to_refine(const ReducedModel &model)
  {
    TrainingOptions options;
    options.range         = model.range;
    options.n_coordinates = model.n_modes();
    if (model.record.n_resistance_samples > 0)
      options.n_samples = model.record.n_resistance_samples;
    options.added_runs = model.record.added_runs;
    options.known_runs = model.record.held_out_runs;
    options.n_held_out = static_cast<int>(options.known_runs.size());
    if (model.record.target > 0.)
      options.target = model.record.target;
    return options;
  }

  void require_trainable(const Scene &scene)
  {
    require(scene, scene.tail.has_value(), "it has no [tail], so that there is no shape to reduce",
            "run it with simulate, which is fast for a rigid body");
    require(scene, scene.fluid.has_value(), "it has no [fluid], and the reduced swimmer is driven by resistance",
            "add [fluid] and [domain]");
    require(scene, scene.head.is_free(), "[head] motion that is not \"free\", and the reduced swimmer swims",
            "set it to \"free\"");
    require(scene, scene.tail->is_elastic(),
            "[tail] law is \"rigid\" or \"prescribed\", and its shape does not follow from forces",
            "run it with simulate, or give it an elastic law");
    require(scene, scene.numerics.tail_order == 2, "[numerics] tail_order = 1, and a linear tail locks in bending",
            "use 2");
    require(scene, scene.gravity.acceleration_m_s2 == (std::array{0., 0., 0.}),
            "gravity acts, which the reduced swimmer does not know", "take [gravity] out");
    require(scene, walls_are_still(*scene.domain),
            "a wall moves or fluid flows in, which the reduced swimmer does not know",
            "use no-slip and traction-free walls");
    require(scene, scene.field.waveform() == FieldProgram::Waveform::sinusoidal,
            "[field] is not the sinusoid bx_T, by_T, frequency_Hz that training runs are made with",
            "give these three; the trained model then takes any field");
    require(scene, scene.field.ramp_s == 0.,
            "[field] ramp_s makes the field differ from period to period, which no run of a reduced swimmer repeats",
            "take it out");
    if (scene.dimension == 3)
      require_motion_in_plane(scene);
  }

  TrainedRange default_range(const Scene &scene)
  {
    require_trainable(scene);
    const RunParameters p      = parameters_of(scene);
    const auto          around = [](const double value, const double low, const double high) {
      return value >= 0. ? Interval{low * value, high * value} : Interval{high * value, low * value};
    };
    return {around(p.young_modulus_Pa, .5, 4.),
            {p.viscosity_Pa_s, p.viscosity_Pa_s},
            around(p.magnetization_A_m, .5, 2.),
            around(p.frequency_Hz, .125, 4.),
            {p.bx_T, p.bx_T},
            {p.by_T, p.by_T}};
  }
} // namespace swimtwin
