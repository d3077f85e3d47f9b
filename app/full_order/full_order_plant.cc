#include <app/full_order/full_order_plant.h>
#include <app/full_order/steered_swimmer.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/system/provenance.h>
#include <fom/run/run_recorder.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr int shapes_per_period = 30; // of the carrier

    Scene plant_scene(const Scene &scene, const FullOrderPlantOptions &options)
    {
      Scene steered = steered_scene(scene, 1., static_cast<int>(std::lround(options.steps_per_second)));
      steered.output.snapshots_per_period = steered.time.steps_per_period; // whatever is noted
      return steered;
    }

    template <int dim>
    class SteeredPlant : public FullOrderPlant
    {
    public:
      SteeredPlant(const Scene &scene, const FullOrderPlantOptions &options)
          : options_(options), swimmer_(plant_scene(scene, options)), recorder_(swimmer_.scene())
      {
      }

      void advance(const SteeringPlan &plan, double /*from*/, const double to) override
      {
        swimmer_.advance(to / options_.frequency_Hz,
                         [&](const double time_s) { return plan.field_T(time_s * options_.frequency_Hz); });
        if (!options_.remembers_shapes || to < next_note_periods_)
          return;
        recorder_.note(swimmer_.model(), 0);
        next_note_periods_ = to + 0.999 / shapes_per_period;
      }

      Pose pose() const override { return {{swimmer_.center()[0], swimmer_.center()[1]}, swimmer_.angle_rad()}; }

      void write_snapshots(const std::filesystem::path &file) const override
      {
        const Scene &scene = swimmer_.scene();
        swimtwin::write_snapshots(file, recorder_.snapshots(swimmer_.model().swimmer()),
                                  {current_program_version, "", scene.text, scene.hash, utc_time_now(), 0.});
      }

    private:
      FullOrderPlantOptions options_;
      SteeredSwimmer<dim>   swimmer_;
      RunRecorder<dim>      recorder_;
      double                next_note_periods_ = 0.;
    };
  } // namespace

  std::unique_ptr<FullOrderPlant> make_full_order_plant(const ReducedModel &model, const FullOrderPlantOptions &options)
  {
    const Scene scene =
        parse_scene(model.scene_text, model.scene_name + ".toml", {inertia_override(names_of(options.inertia))});
    if (scene.dimension == 3)
      return std::make_unique<SteeredPlant<3>>(scene, options);
    return std::make_unique<SteeredPlant<2>>(scene, options);
  }
} // namespace swimtwin
