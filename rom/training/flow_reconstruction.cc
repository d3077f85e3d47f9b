#include <rom/training/flow_reconstruction.h>

#include <datasets/system/error.h>
#include <fom/body/mesh_around.h>
#include <fom/elastic/nodal_vector.h>
#include <fom/resistance/motion_resistance.h>
#include <fom/run/flow_in_plane.h>
#include <rom/sweep/reconstruction.h>
#include <rom/training/shape_sampler.h>

namespace swimtwin
{
  namespace
  {
    /// Modes belong to nodes: the scene has to make the same ones again.
    template <int dim>
    void require_same_tail(const Swimmer<dim> &swimmer, const ReducedTail &tail)
    {
      const auto &nodes = swimmer.tail().mesh.nodes;
      bool is_same      = static_cast<Eigen::Index>(nodes.size()) == tail.nodes_m.rows() && tail.nodes_m.cols() == dim;
      for (std::size_t a = 0; is_same && a < nodes.size(); ++a)
        for (int c = 0; c < dim; ++c)
          is_same = is_same && std::abs(nodes[a][c] - tail.nodes_m(static_cast<Eigen::Index>(a), c)) < 1e-9;
      if (!is_same)
        throw InputError("the mesh of the scene's tail is not the one that the reduced model was trained on (another "
                         "version of gmsh?): train the model on this machine");
    }

    template <int dim>
    Configuration<dim> configuration_of(const Swimmer<dim> &swimmer, const ReducedTail &tail, const SwimmerState &state)
    {
      Configuration<dim> configuration = swimmer.configuration_at_rest();
      configuration.pose.center[0]     = state[0];
      configuration.pose.center[1]     = state[1];
      configuration.pose.set_attitude(Attitude<dim>::about_z(state[2]));
      configuration.shape = nodal_field<dim>(tail_displacement(tail, state.segment(3, tail.n_coordinates())));
      return configuration;
    }

    template <int dim>
    Rates<dim> rates_of(const ReducedTail &tail, const ReducedSnapshot &snapshot)
    {
      const int  r = tail.n_coordinates();
      Rates<dim> rates;
      rates.velocity[0]                  = snapshot.rate[0];
      rates.velocity[1]                  = snapshot.rate[1];
      rates.omega[rotation_about_z<dim>] = snapshot.rate[2];
      rates.shape_rate =
          nodal_field<dim>(tail_velocity(tail, snapshot.state.segment(3, r), snapshot.rate.segment(3, r)));
      return rates;
    }

    template <int dim>
    std::vector<PlaneFlow> write_flow_around(const Swimmer<dim> &swimmer, const ReducedTail &tail,
                                             const RunRequest &request, const std::vector<ReducedSnapshot> &snapshots,
                                             const std::filesystem::path    &folder,
                                             const std::function<void(int)> &on_progress)
    {
      require_same_tail(swimmer, tail);
      FieldOutput            fields(folder);
      std::vector<PlaneFlow> flows;
      const int              n_steps = static_cast<int>(snapshots.size()) - 1;
      for (int step = 0; step <= n_steps; ++step)
      {
        const ReducedSnapshot  &snapshot      = snapshots[step];
        const auto              configuration = configuration_of(swimmer, tail, snapshot.state);
        const auto              rates         = rates_of<dim>(tail, snapshot);
        const FluidDomain<dim>  fluid(swimmer.scene(), mesh_for_given_motions(swimmer, configuration, MPI_COMM_SELF),
                                      configuration.pose);
        const FieldInstant<dim> instant{
            snapshot.phase / request.drive.frequency_Hz,       swimmer, configuration, rates, &fluid,
            compute_flow(swimmer, fluid, configuration, rates)};
        fields.write(instant, static_cast<unsigned int>(step));
        if (is_flow_instant(n_steps, request.samples_per_period, step))
          flows.push_back(flow_in_plane(instant));
        if (on_progress)
          on_progress(step + 1);
      }
      return flows;
    }
  } // namespace

  std::vector<PlaneFlow> write_flow(const Scene &scene, const ReducedModel &model, const RunRequest &request,
                                    const std::vector<ReducedSnapshot> &snapshots, const std::filesystem::path &folder,
                                    const std::function<void(int)> &on_progress)
  {
    const auto write = [&]<int dim>(const Swimmer<dim> &swimmer) {
      return write_flow_around(swimmer, model.tail, request, snapshots, folder, on_progress);
    };
    return scene.dimension == 3 ? write(Swimmer<3>(scene, MPI_COMM_SELF)) : write(Swimmer<2>(scene, MPI_COMM_SELF));
  }
} // namespace swimtwin
