#include <rom/training/inertia_samples.h>

#include <datasets/system/error.h>
#include <fom/elastic/nodal_vector.h>
#include <rom/swimmer/shape_amplitudes.h>
#include <rom/training/posed_body.h>
#include <rom/training/posed_fluid.h>

#include <optional>

namespace swimtwin
{
  namespace
  {
    /// A reduced swimmer's shapes as the full-order model has them.
    template <int dim>
    class ModelBody
    {
    public:
      ModelBody(const ReducedModel &model, const Scene &scene)
          : model_(model), amplitudes_(model.tail), swimmer_(scene, MPI_COMM_SELF)
      {
      }

      const Swimmer<dim> &swimmer() const { return swimmer_; }

      Configuration<dim> configuration(const ShapePoint &point) const
      {
        const auto           &resistance = model_.resistance;
        std::optional<double> height_m;
        if (resistance.depends_on_height)
          height_m =
              point.drift_y_m + UsualPlace{resistance.usual_by_sine_m, resistance.usual_by_coordinate}.height_m(point);
        return posed(swimmer_, point, nodal_field<dim>(model_.tail.modes * amplitudes_.value(point.q)), height_m);
      }

      BodyMotions<dim> motions(const Eigen::VectorXd &q) const
      {
        constexpr double      share = 1e-4; // of a coordinate's scale: slopes are polynomials
        const Eigen::MatrixXd J     = amplitudes_.slopes(q);
        BodyMotions<dim>      result;
        result.slopes.resize(static_cast<std::size_t>(q.size()));
        for (Eigen::Index j = 0; j < q.size(); ++j)
          result.modes.push_back(nodal_field<dim>(model_.tail.modes * J.col(j)));
        for (Eigen::Index k = 0; k < q.size(); ++k)
        {
          const double    step = share * model_.resistance.coordinate_scale_m(k);
          Eigen::VectorXd up = q, down = q;
          up(k) += step;
          down(k) -= step;
          const Eigen::MatrixXd change = (amplitudes_.slopes(up) - amplitudes_.slopes(down)) / (2. * step);
          for (Eigen::Index j = 0; j < q.size(); ++j)
            result.slopes[static_cast<std::size_t>(j)].push_back(nodal_field<dim>(model_.tail.modes * change.col(j)));
        }
        return result;
      }

    private:
      const ReducedModel &model_;
      ShapeAmplitudes     amplitudes_;
      Swimmer<dim>        swimmer_;
    };

    template <int dim>
    InertiaSample sample_of(const MotionInertia<dim> &inertia)
    {
      const auto    n = static_cast<int>(inertia.mass.m());
      InertiaSample sample{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, n * (n + 1) / 2)};
      const auto    powerless = inertia.powerless();
      for (int i = 0; i < n; ++i)
        for (int j = 0, pair = 0; j < n; ++j)
        {
          sample.mass(i, j) = .5 * (inertia.mass(i, j) + inertia.mass(j, i));
          for (int k = 0; k <= j; ++k, ++pair)
            sample.quadratic(i, pair) = (j == k ? 1. : 2.) * powerless[static_cast<std::size_t>(i)](j, k);
        }
      return sample;
    }

    struct InertiaAtShape
    {
      InertiaSample fluid, tail;
      double        power_defect = 0.;
    };

    template <int dim>
    std::optional<InertiaAtShape> inertia_at(const ModelBody<dim> &body, PosedFluid<dim> &fluid,
                                             const ShapePoint &point)
    {
      const Configuration<dim> c = body.configuration(point);
      if (body.swimmer().elasticity().is_inverted(c.shape))
        return {};
      const BodyMotions<dim> motions = body.motions(point.q);
      try
      {
        const auto of_fluid = fluid.around(c, [&](const FluidDomain<dim> &around) {
          return compute_fluid_inertia(body.swimmer(), around, c, motions);
        });
        return InertiaAtShape{sample_of(of_fluid), sample_of(compute_tail_inertia(body.swimmer(), c, motions)),
                              of_fluid.power_defect()};
      }
      catch (const ComputationError &) // the shape touches itself or a wall
      {
        return {};
      }
    }

    Eigen::VectorXd numbers_of(const InertiaAtShape &at)
    {
      const Eigen::Index n = at.fluid.mass.size(), m = at.fluid.quadratic.size();
      Eigen::VectorXd    numbers(2 * (n + m) + 1);
      numbers << at.fluid.mass.reshaped(), at.fluid.quadratic.reshaped(), at.tail.mass.reshaped(),
          at.tail.quadratic.reshaped(), at.power_defect;
      return numbers;
    }

    InertiaSample sample_from(const Eigen::Ref<const Eigen::VectorXd> &numbers, const Eigen::Index n)
    {
      const Eigen::Index n_pairs = n * (n + 1) / 2;
      return {numbers.head(n * n).reshaped(n, n), numbers.segment(n * n, n * n_pairs).reshaped(n, n_pairs)};
    }
  } // namespace

  template <int dim>
  InertiaSamples sample_inertia(const ReducedModel &model, const Scene &scene, const std::vector<ShapePoint> &points,
                                const MPI_Comm communicator, const std::function<void(int, int)> &on_progress)
  {
    int rank, n_ranks;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &n_ranks);
    const ModelBody<dim> body(model, scene);
    PosedFluid<dim>      fluid(body.swimmer());
    const Eigen::Index   n = model.n_modes() + n_rigid_in_plane, of_material = n * n + n * n * (n + 1) / 2;
    Eigen::MatrixXd      all = Eigen::MatrixXd::Zero(2 * of_material + 1, static_cast<Eigen::Index>(points.size()));
    for (std::size_t k = static_cast<std::size_t>(rank); k < points.size(); k += static_cast<std::size_t>(n_ranks))
    {
      if (const auto at = inertia_at(body, fluid, points[k]))
        all.col(static_cast<Eigen::Index>(k)) = numbers_of(*at);
      if (on_progress)
        on_progress(static_cast<int>(k) + 1, static_cast<int>(points.size()));
    }
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, communicator);

    InertiaSamples samples;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (const auto numbers = all.col(static_cast<Eigen::Index>(k)); numbers(0) > 0.)
      {
        samples.points.push_back(points[k]);
        samples.fluid.push_back(sample_from(numbers.head(of_material), n));
        samples.tail.push_back(sample_from(numbers.segment(of_material, of_material), n));
        samples.largest_power_defect = std::max(samples.largest_power_defect, numbers(numbers.size() - 1));
      }
    return samples;
  }

  template InertiaSamples sample_inertia<2>(const ReducedModel &, const Scene &, const std::vector<ShapePoint> &,
                                            MPI_Comm, const std::function<void(int, int)> &);
  template InertiaSamples sample_inertia<3>(const ReducedModel &, const Scene &, const std::vector<ShapePoint> &,
                                            MPI_Comm, const std::function<void(int, int)> &);
} // namespace swimtwin
