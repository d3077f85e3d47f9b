#include <rom/training/flow_reconstruction.h>

#include <fom/elastic/nodal_vector.h>
#include <datasets/system/error.h>
#include <fom/body/mesh_around.h>
#include <fom/resistance/motion_resistance.h>
#include <fom/run/field_output.h>
#include <rom/sweep/reconstruction.h>
#include <rom/training/shape_sampler.h>

namespace swimtwin
{
  namespace
  {
    /// Modes belong to nodes: the scene has to make the same ones again.
    void require_same_tail(const Swimmer<2> &swimmer, const ReducedTail &tail)
    {
      const auto &nodes   = swimmer.tail().mesh.nodes;
      bool        is_same = static_cast<Eigen::Index>(nodes.size()) == tail.nodes_m.rows();
      for (std::size_t a = 0; is_same && a < nodes.size(); ++a)
        for (int c = 0; c < 2; ++c)
          is_same = is_same && std::abs(nodes[a][c] - tail.nodes_m(static_cast<Eigen::Index>(a), c)) < 1e-9;
      if (!is_same)
        throw InputError("the mesh of the scene's tail is not the one that the reduced model was trained on (another "
                         "version of gmsh?): train the model on this machine");
    }

    Configuration<2> configuration_of(const Swimmer<2> &swimmer, const ReducedTail &tail, const SwimmerState &state)
    {
      Configuration<2> configuration = swimmer.configuration_at_rest();
      configuration.pose.center      = dealii::Point<2>(state[0], state[1]);
      configuration.pose.angle       = state[2];
      configuration.shape            = nodal_field<2>(tail_displacement(tail, state.tail(tail.n_coordinates())));
      return configuration;
    }

    Rates<2> rates_of(const ReducedTail &tail, const ReducedSnapshot &snapshot)
    {
      const int r = tail.n_coordinates();
      Rates<2>  rates;
      rates.velocity   = dealii::Tensor<1, 2>({snapshot.rate[0], snapshot.rate[1]});
      rates.omega[0]   = snapshot.rate[2];
      rates.shape_rate = nodal_field<2>(tail_velocity(tail, snapshot.state.tail(r), snapshot.rate.tail(r)));
      return rates;
    }

    FluidDomain<2> fluid_around(const Swimmer<2> &swimmer, const Configuration<2> &configuration)
    {
      return {swimmer.scene(), mesh_whole_around(swimmer, configuration, MPI_COMM_SELF), configuration.pose};
    }
  } // namespace

  void write_flow(const Scene &scene, const ReducedModel &model, const double frequency_Hz,
                  const std::vector<ReducedSnapshot> &snapshots, const std::filesystem::path &folder,
                  const std::function<void(int)> &on_progress)
  {
    const Swimmer<2> swimmer(scene, MPI_COMM_SELF);
    require_same_tail(swimmer, model.tail);
    FieldOutput fields(folder);
    for (std::size_t i = 0; i < snapshots.size(); ++i)
    {
      const ReducedSnapshot &snapshot      = snapshots[i];
      const auto             configuration = configuration_of(swimmer, model.tail, snapshot.state);
      const FluidDomain<2>   fluid         = fluid_around(swimmer, configuration);
      fields.write<2>({snapshot.phase / frequency_Hz, swimmer, configuration, &fluid,
                       compute_flow(swimmer, fluid, configuration, rates_of(model.tail, snapshot))},
                      static_cast<unsigned int>(i));
      if (on_progress)
        on_progress(static_cast<int>(i) + 1);
    }
  }
} // namespace swimtwin
