// Where a reduced swimmer's error comes from: the full-order model's ingredients put in one after the other.
//
//   bench_shares SCENE TRAINED_FOLDER WORK_FOLDER [n held-out members (2)] [steps per period (100)]
//
// for the scene's own run, then members of the range that no training run had. Two minutes of CPU time each, in space
// an hour.
#include <bench/battery/exact_motion.h>

#include <datasets/run/run_summary_json.h>
#include <datasets/system/error.h>
#include <fom/elastic/nodal_vector.h>
#include <fom/run/run_recorder.h>
#include <rom/swimmer/dense_algebra.h>
#include <rom/training/bent_tail.h>
#include <rom/training/explored_shapes.h>
#include <rom/training/held_out_runs.h>
#include <rom/training/sampled_shapes.h>
#include <rom/training/training_runs.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace swimtwin
{
  namespace
  {
    std::string text_of_file(const std::filesystem::path &file)
    {
      std::ostringstream text;
      text << std::ifstream(file).rdbuf();
      return text.str();
    }

    template <int dim>
    TailBasis basis_of(const Swimmer<dim> &swimmer, const ReducedModel &model, const Eigen::MatrixXd &snapshots)
    {
      TailBasis basis;
      if (model.tail.amplitudes.are_given())
      {
        BendingCoordinates coordinates(swimmer);
        coordinates.choose_modes(snapshots, model.n_modes());
        basis.bent = std::make_shared<const BentTail>(
            BentTail{coordinates, model.tail.modes, model.tail.parity, model.tail.amplitudes, model.elasticity.energy,
                     CoordinatePolynomials(model.tail.amplitudes, model.tail.coordinate_parity())});
        return basis;
      }
      basis.coordinates = model.tail.modes.leftCols(model.n_modes());
      basis.followers   = model.tail.modes.rightCols(model.tail.followers.rows());
      basis.quadratic   = model.tail.followers;
      return basis;
    }

    std::vector<SnapshotSet> training_sets(const std::filesystem::path &trained)
    {
      std::vector<SnapshotSet> sets;
      for (int k = 1; k <= 9; ++k)
        sets.push_back(read_snapshots(trained / "runs" / fmt::format("run-{:02}", k) / "snapshots.h5"));
      return sets;
    }

    struct Shares
    {
      double displaced = 0., velocity = 0.; ///< relative, what the modes leave of displacements and rates
      double energy = 0.;                   ///< of the shape on the modes over that of the shape, at most
      double fit = 0., place = 0.;          ///< relative error of velocities under the loads, rms
      double radius = 0.;                   ///< largest of the region's
      double full = 0., modes = 0., height = 0., usual = 0., surrogate = 0., model = 0.; ///< displacements, m
    };

    template <int dim>
    class Measurement
    {
    public:
      Measurement(const Scene &scene, const std::filesystem::path &trained, const std::filesystem::path &work,
                  const int steps)
          : scene_(scene), work_(work), steps_(steps), swimmer_(scene_, MPI_COMM_SELF),
            model_(read_reduced_model(trained / "model.h5")),
            space_(make_tail_space<dim>(RunRecorder<dim>(scene_).snapshots(swimmer_), swimmer_.tail().mesh))
      {
        const auto sets = training_sets(trained);
        basis_          = basis_of(swimmer_, model_, space_.displacements(sets));
        if (scene_.domain->moves_with_swimmer)
          place_ = {0., Eigen::VectorXd::Zero(basis_.n_coordinates())};
        else
        {
          auto points = trajectory_points(sets, basis_, space_);
          place_      = wandering(sets, swimmer_, points).usual;
        }
      }

      std::vector<RunParameters> members(const int n_held_out) const
      {
        std::vector<RunParameters> all{parameters_of(scene_)};
        for (const auto &member : spread_members(model_.range, n_held_out, 200))
          all.push_back(member);
        return all;
      }

      Shares shares(const RunParameters &member, const int index) const
      {
        Shares             shares;
        TrainingRunOptions options{work_ / fmt::format("member-{}", index), "bench_shares", {}, {}};
        options.overrides = {"time.periods=3", fmt::format("time.steps_per_period={}", steps_),
                             "output.snapshots_per_period=50", "output.fields_per_period=0"};
        const auto folder = run_full_order(scene_, {member}, options, MPI_COMM_SELF).front();
        const auto set    = read_snapshots(folder / "snapshots.h5");
        shares.full       = *read_run_summary_json(folder / "summary.json").summary.net_displacement_m;
        look_at_snapshots(set, member, shares);
        ExactMotion<dim> motion(swimmer_, model_, basis_, place_);
        using Source            = ResistanceSource;
        const auto displacement = [&](const Source source) {
          try
          {
            return motion.displacement_m(member, source, 3, steps_);
          }
          catch (const ComputationError &error) // the shape may be one that cannot be
          {
            fmt::print(stderr, "with resistance {}: {}\n", static_cast<int>(source), error.what());
            return std::nan("");
          }
        };
        shares.surrogate = displacement(Source::surrogate);
        shares.modes     = displacement(Source::full_order_in_place);
        if (dim == 3 || model_.resistance.depends_on_height || scene_.domain->moves_with_swimmer)
          shares.height = shares.usual = shares.modes; // the model follows; in space too dear, and little (its card)
        else
        {
          shares.height = displacement(Source::full_order_at_usual_height);
          shares.usual  = displacement(Source::full_order_in_usual_place);
        }
        shares.model = predict(model_, scene_, member).displacement_m;
        return shares;
      }

    private:
      /// Of the coordinates, when the tail deforms at this rate.
      Eigen::VectorXd rate_of(const Eigen::VectorXd &shape, const Eigen::VectorXd &rate) const
      {
        const double    step = 1e-6 * swimmer_.scene().body_length_m() / rate.cwiseAbs().maxCoeff();
        Eigen::MatrixXd both(shape.size(), 2);
        both << shape - step * rate, shape + step * rate;
        const Eigen::MatrixXd q = basis_.coordinates_of(space_, both);
        return (q.col(1) - q.col(0)) / (2. * step);
      }

      void look_at_snapshots(const SnapshotSet &set, const RunParameters &member, Shares &shares) const
      {
        ExactMotion<dim>      motion(swimmer_, model_, basis_, place_);
        const Eigen::MatrixXd D = set.tail_displacement_m.transpose(), V = set.tail_velocity_m_s.transpose();
        const Eigen::MatrixXd q  = basis_.coordinates_of(space_, D);
        double                d2 = 0., e2 = 0., v2 = 0., w2 = 0., n = 0.;
        for (Eigen::Index k = 1; k < D.cols(); ++k)
        {
          const Eigen::VectorXd shape = basis_.displacement(q.col(k));
          d2 += std::pow(space_.norm(D.col(k)), 2);
          e2 += std::pow(space_.norm(D.col(k) - shape), 2);
          v2 += std::pow(space_.norm(V.col(k)), 2);
          w2 += std::pow(space_.norm(V.col(k) - basis_.tangent(q.col(k)) * rate_of(D.col(k), V.col(k))), 2);
          shares.radius       = std::max(shares.radius, motion.reduced().resistance().shape_radius(q.col(k)));
          const auto &elastic = swimmer_.elasticity();
          if (k > D.cols() / 2)
            shares.energy =
                std::max(shares.energy, scene_.tail->young_modulus_Pa * motion.reduced().energy().value(q.col(k)) /
                                            elastic.energy(nodal_field<dim>(D.col(k))));
          if (k % 7 == 3)
            add_resistance_errors(motion, set, k, q.col(k), member, shares), n += 1.;
        }
        shares.displaced = std::sqrt(e2 / d2);
        shares.velocity  = std::sqrt(w2 / v2);
        shares.fit       = std::sqrt(shares.fit / n);
        shares.place     = std::sqrt(shares.place / n);
      }

      /// Velocities under the loads of the moment, with three resistances.
      void add_resistance_errors(ExactMotion<dim> &motion, const SnapshotSet &set, const Eigen::Index k,
                                 const Eigen::VectorXd &q, const RunParameters &p, Shares &shares) const
      {
        Eigen::VectorXd state(3 + q.size());
        state << set.pose.row(k).transpose(), q;
        const double    by = set.field_T(k, 1);
        Eigen::VectorXd f  = Eigen::VectorXd::Zero(state.size());
        f[2] =
            p.magnetization_A_m * model_.magnet.head_area_m2 * (std::cos(state[2]) * by - std::sin(state[2]) * p.bx_T);
        f.tail(q.size())           = -p.young_modulus_Pa * motion.reduced().energy().gradient(q);
        using Source               = ResistanceSource;
        const Eigen::MatrixXd here = motion.resistance(state, Source::full_order_in_place);
        const Eigen::MatrixXd usual =
            model_.resistance.depends_on_height ? here : motion.resistance(state, Source::full_order_in_usual_place);
        const Eigen::MatrixXd fitted = motion.resistance(state, Source::surrogate);
        const auto            off    = [&](const Eigen::MatrixXd &a, const Eigen::MatrixXd &b) {
          const Eigen::VectorXd va = a.llt().solve(f), d = b.llt().solve(f) - va;
          return d.dot(a * d) / va.dot(a * va);
        };
        shares.place += off(here, usual);
        shares.fit += off(usual, fitted);
      }

      const Scene          &scene_;
      std::filesystem::path work_;
      int                   steps_;
      Swimmer<dim>          swimmer_;
      ReducedModel          model_;
      TailBasis             basis_;
      TailSpace             space_;
      UsualPlace            place_;
    };

    void print(const RunParameters &p, const Shares &s)
    {
      const auto percent = [&](const double to, const double from) { return 100. * (to - from) / s.full; };
      fmt::print(
          "| {:.4g} | {:.4g} | {:.4g} | {:.4f} | {:+.2f} | {:+.2f} | {:+.2f} | {:+.2f} | {:+.2f} | {:+.2f} | {:.2f} | "
          "{:.2f} | {:.3f} | "
          "{:.2f} | {:.2f} | {:.2f} |\n",
          1e-3 * p.young_modulus_Pa, p.frequency_Hz, 1e-3 * p.magnetization_A_m, 1e3 * s.full, percent(s.model, s.full),
          percent(s.modes, s.full), percent(s.height, s.modes), percent(s.usual, s.height),
          percent(s.surrogate, s.usual), percent(s.model, s.surrogate), 100. * s.displaced, 100. * s.velocity, s.energy,
          100. * s.place, 100. * s.fit, s.radius);
      std::fflush(stdout);
    }

    template <int dim>
    void measure(const Scene &scene, const std::vector<std::string> &words)
    {
      const int n = words.size() > 4 ? std::stoi(words[4]) : 2, steps = words.size() > 5 ? std::stoi(words[5]) : 100;
      const Measurement<dim> measurement(scene, words[2], words[3], steps);
      fmt::print("| E (kPa) | f (Hz) | M (kA/m) | full order (mm) | all (%) | modes (%) | height (%) | way (%) | fit "
                 "(%) | steps "
                 "(%) | shapes left "
                 "(%) | rates left (%) | energy ratio | velocities: place (%) | fit (%) | radius |\n");
      int index = 0;
      for (const auto &member : measurement.members(n))
        print(member, measurement.shares(member, index++));
    }
  } // namespace
} // namespace swimtwin

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::vector<std::string>           words(argv, argv + argc);
  if (words.size() < 4)
  {
    std::fputs("bench_shares SCENE TRAINED_FOLDER WORK_FOLDER [n held-out members (2)] [steps per period (100)]\n",
               stderr);
    return 2;
  }
  try
  {
    const swimtwin::Scene scene =
        swimtwin::parse_scene(swimtwin::text_of_file(words[1]), words[1], {"fluid.inertia=none"});
    scene.dimension == 2 ? swimtwin::measure<2>(scene, words) : swimtwin::measure<3>(scene, words);
    return 0;
  }
  catch (const std::exception &error)
  {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
