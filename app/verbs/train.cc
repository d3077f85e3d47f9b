// Verb train: a reduced swimmer from a scene.
#include <app/full_order/training_report.h>

#include <app/frame/value_list.h>
#include <datasets/run/snapshot_set.h>
#include <datasets/scene/dimensionless_groups.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>

namespace swimtwin
{
  namespace
  {
    constexpr double largest_unsteady_group = 2.;

    /// "4e4:3e5" or one value.
    Interval parse_interval(const std::string &option, const std::string &text, const ValueRule rule)
    {
      const bool is_range = std::count(text.begin(), text.end(), ':') == 1;
      const auto values   = parse_values(option, is_range ? text + ":2" : text, rule);
      return {*std::min_element(values.begin(), values.end()), *std::max_element(values.begin(), values.end())};
    }

    TrainedRange range_of(const TrainCommand &command, const Scene &scene)
    {
      TrainedRange range = default_range(scene);
      const auto   set   = [](const char *option, const std::string &text, const ValueRule rule, Interval &interval) {
        if (!text.empty())
          interval = parse_interval(option, text, rule);
      };
      set("--young-modulus", command.young_modulus, ValueRule::positive, range.young_modulus_Pa);
      set("--viscosity", command.viscosity, ValueRule::positive, range.viscosity_Pa_s);
      set("--magnetization", command.magnetization, ValueRule::finite, range.magnetization_A_m);
      set("--frequency", command.frequency, ValueRule::positive, range.frequency_Hz);
      set("--bx", command.bx, ValueRule::finite, range.bx_T);
      set("--by", command.by, ValueRule::finite, range.by_T);
      return range;
    }

    void require_law_of_basis(const Scene &scene, const BasisChoice basis)
    {
      if (basis != BasisChoice::bending && scene.dimension == 3)
        throw InputError(
            fmt::format("{} is in three dimensions, where the shape's coordinates are bending angles: leave "
                        "--basis out",
                        scene.name));
      if (basis != BasisChoice::bending && scene.tail->law != MaterialModel::st_venant_kirchhoff)
        throw InputError(
            fmt::format("{} cannot be trained with this --basis: [tail] law is not \"st-venant-kirchhoff\", "
                        "the only one whose energy is a polynomial of displacement modes; leave --basis out, "
                        "or change the law",
                        scene.name));
    }

    void require_followers_of_basis(const BasisChoice basis, const bool are_given)
    {
      if (are_given && basis == BasisChoice::bending)
        throw InputError("--followers has no meaning with --basis bending, where all but the bending angles relaxes; "
                         "leave it out, or choose --basis pod or elastic");
    }

    void require_small_inertia(const TrainCommand &command, const Scene &scene, const TrainedRange &range)
    {
      const double group = unsteady_group(scene, range.frequency_Hz.high, range.viscosity_Pa_s.low);
      if (group > largest_unsteady_group && scene.fluid->inertia == Inertia::none && !command.allow_inertia)
        throw InputError(fmt::format(
            "the unsteady group 2 pi rho f L^2 / mu is {:.3g} at {:.4g} Hz and {:.4g} Pa s, and [fluid] "
            "inertia = \"none\": the reduced swimmer would not be right above {:g}; let it carry inertia "
            "(\"auto\"), lower --frequency, raise --viscosity, or train it all the same with --allow-inertia",
            group, range.frequency_Hz.high, range.viscosity_Pa_s.low, largest_unsteady_group));
    }

    /// "90s", "30min" or "2h", in seconds.
    double parse_duration(const std::string &option, const std::string &text)
    {
      constexpr std::array units{std::pair{"min", 60.}, std::pair{"s", 1.}, std::pair{"h", 3600.}};
      for (const auto &[unit, seconds] : units)
        if (text.ends_with(unit))
          return seconds *
                 parse_values(option, text.substr(0, text.size() - std::string(unit).size()), ValueRule::positive)
                     .front();
      throw InputError(fmt::format("{} = {} has no unit of time; say s, min or h, as in 30min", option, text));
    }

    /// Throws InputError.
    void complete_options(TrainCommand &command, const Scene &scene)
    {
      auto &own        = command.training;
      own.range        = range_of(command, scene);
      own.basis        = command.basis == "elastic" ? BasisChoice::elastic
                         : command.basis == "pod"   ? BasisChoice::pod
                                                    : BasisChoice::bending;
      own.folder       = command.common.output;
      own.command_line = command.common.command_line;
      own.target       = parse_share("--target", command.target);
      own.budget_s     = parse_duration("--budget", command.budget);
      own.snapshots    = {command.snapshots.begin(), command.snapshots.end()};
      require_law_of_basis(scene, own.basis);
      require_followers_of_basis(own.basis, command.has_followers);
      require_small_inertia(command, scene, own.range);
      for (const auto &file : own.snapshots)
        read_snapshots(file); // refused now rather than after the runs
    }
  } // namespace

  Work add_train(CLI::App &tool, const std::string &command_line)
  {
    auto  own  = std::make_shared<TrainCommand>();
    auto *verb = tool.add_subcommand("train", "Train a reduced swimmer on full-order runs of a scene");
    verb->add_option("scene", own->common.scene, "Scene file, or name of a shipped scene")->required();
    add_common_options(*verb, own->common, OutputFolder::required);
    verb->add_option("--young-modulus", own->young_modulus, "Range low:high in Pa (half to four times the scene's)");
    verb->add_option("--frequency", own->frequency, "Range low:high in Hz (an eighth to four times the scene's)");
    verb->add_option("--magnetization", own->magnetization, "Range low:high in A/m (half to twice the scene's)");
    verb->add_option("--viscosity", own->viscosity, "Range low:high in Pa s (the scene's)");
    verb->add_option("--bx", own->bx, "Range low:high in T (the scene's)");
    verb->add_option("--by", own->by, "Range low:high in T (the scene's)");
    verb->add_option("--modes", own->training.n_coordinates, "Bending modes, the model's coordinates")
        ->check(CLI::Range(1, 10))
        ->capture_default_str();
    const auto *followers = verb->add_option("--followers", own->training.n_followers,
                                             "Modes that follow them (--basis pod, elastic): shortening by bending")
                                ->check(CLI::Range(1, 12))
                                ->capture_default_str();
    verb->add_option("--samples", own->training.n_samples, "Shapes at which the resistance is computed")
        ->check(CLI::Range(60, 100000))
        ->capture_default_str();
    verb->add_option("--steps", own->training.steps_per_period,
                     "Steps per period of the runs that shapes are taken from")
        ->check(CLI::Range(20, 10000))
        ->capture_default_str();
    verb->add_option("--held-out", own->training.n_held_out, "Full-order runs kept for comparison")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    verb->add_option("--target", own->target,
                     "Error of held-out displacements to be met, rms (twice as much at worst), such as 1% or 0.01")
        ->capture_default_str();
    verb->add_option("--budget", own->budget,
                     "CPU time of all processes, such as 30min, for modes, samples and runs until the target is met")
        ->capture_default_str();
    verb->add_option("--basis", own->basis,
                     "bending: angles, all else relaxed; pod: displacements of the runs; elastic: of the tail alone, "
                     "without data")
        ->check(CLI::IsMember({"bending", "pod", "elastic"}))
        ->capture_default_str();
    verb->add_option("--snapshots", own->snapshots, "More snapshots.h5 files of the same swimmer");
    verb->add_flag("--allow-inertia", own->allow_inertia, "Train although inertia is not small");
    verb->add_flag("--resume", own->resume, "Go on with an interrupted training");
    own->common.command_line = command_line;
    return [own, followers] {
      const Scene scene  = load_scene(own->common);
      own->has_followers = followers->count() > 0;
      complete_options(*own, scene);
      train_and_report(scene, *own);
    };
  }
} // namespace swimtwin
