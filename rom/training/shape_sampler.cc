#include <rom/training/shape_sampler.h>

#include <datasets/system/error.h>
#include <fom/elastic/nodal_vector.h>
#include <fom/resistance/motion_resistance.h>
#include <rom/training/posed_body.h>

#include <algorithm>

namespace swimtwin
{
  template <int dim>
  ShapeResistance<dim>::ShapeResistance(const Swimmer<dim> &swimmer, const TailBasis &basis, const UsualPlace &place)
      : swimmer_(swimmer), basis_(basis), place_(place), fluid_(swimmer)
  {
  }

  template <int dim>
  std::optional<Eigen::MatrixXd> ShapeResistance<dim>::at(const ShapePoint &point)
  {
    const Configuration<dim> c = posed(swimmer_, point, nodal_field<dim>(basis_.displacement(point.q)),
                                       place_.height_m(point) + point.drift_y_m);
    if (swimmer_.elasticity().is_inverted(c.shape))
      return {};
    const Eigen::MatrixXd        tangent = basis_.tangent(point.q);
    std::vector<NodalField<dim>> modes;
    for (Eigen::Index k = 0; k < tangent.cols(); ++k)
      modes.push_back(nodal_field<dim>(tangent.col(k)));
    try
    {
      const auto      R = fluid_.around(c, [&](const FluidDomain<dim> &fluid) {
        return compute_motion_resistance(swimmer_, fluid, c, modes).matrix;
      });
      Eigen::MatrixXd result(R.m(), R.n());
      for (unsigned int i = 0; i < R.m(); ++i)
        for (unsigned int j = 0; j < R.n(); ++j)
          result(i, j) = R(i, j) / swimmer_.scene().fluid->viscosity_Pa_s;
      return result;
    }
    catch (const ComputationError &) // the shape touches itself or a wall
    {
      return {};
    }
  }

  template class ShapeResistance<2>;
  template class ShapeResistance<3>;

  ShapeSampler::ShapeSampler(Resistance resistance, const int n_coordinates, SampleStore &store,
                             const MPI_Comm communicator)
      : resistance_(std::move(resistance)), n_coordinates_(n_coordinates), store_(store), communicator_(communicator)
  {
  }

  void ShapeSampler::compute(const std::vector<ShapePoint> &points)
  {
    int rank, n_ranks;
    MPI_Comm_rank(communicator_, &rank);
    MPI_Comm_size(communicator_, &n_ranks);
    const Eigen::Index n   = n_coordinates_ + n_rigid_in_plane;
    Eigen::MatrixXd    all = Eigen::MatrixXd::Zero(n * n, static_cast<Eigen::Index>(points.size()));
    for (std::size_t k = rank; k < points.size(); k += n_ranks)
      if (const auto R = resistance_(points[k]))
        all.col(k) = R->reshaped();
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, communicator_);
    for (std::size_t k = 0; k < points.size(); ++k)
      store_.add(points[k], all(0, k) > 0. ? Eigen::MatrixXd(all.col(k).reshaped(n, n)) : Eigen::MatrixXd());
    if (rank == 0)
      store_.save();
  }

  std::vector<ResistanceSample> ShapeSampler::sample(const std::vector<ShapePoint>       &points,
                                                     const std::function<void(int, int)> &on_progress)
  {
    constexpr std::size_t         batch = 16; // between two savings
    std::vector<ResistanceSample> samples;
    std::vector<ShapePoint>       missing;
    for (const auto &point : points)
      if (!store_.find(point))
        missing.push_back(point);
    for (std::size_t first = 0; first < missing.size(); first += batch)
    {
      const auto last = std::min(first + batch, missing.size());
      compute({missing.begin() + first, missing.begin() + last});
      if (on_progress)
        on_progress(static_cast<int>(points.size() - missing.size() + last), static_cast<int>(points.size()));
    }
    for (const auto &point : points)
      if (const Eigen::MatrixXd &R = *store_.find(point); R.size() > 0)
        samples.push_back({point, R});
    return samples;
  }
} // namespace swimtwin
