#include <rom/training/shape_sampler.h>

#include <fom/elastic/nodal_vector.h>
#include <datasets/system/error.h>
#include <fom/resistance/motion_resistance.h>

#include <algorithm>

namespace swimtwin
{
  ShapeSampler::ShapeSampler(const Scene &scene, const TailBasis &basis, const UsualPlace &place, SampleStore &store,
                             const MPI_Comm communicator)
      : scene_(scene), basis_(basis), place_(place), store_(store), communicator_(communicator),
        swimmer_(scene, MPI_COMM_SELF)
  {
  }

  Configuration<2> ShapeSampler::configuration(const ShapePoint &point) const
  {
    Configuration<2> c      = swimmer_.configuration_at_rest();
    const auto       middle = c.pose.to_laboratory(swimmer_.arm_to_middle(c.shape));
    c.pose.angle            = point.angle_rad;
    c.shape                 = nodal_field<2>(basis_.displacement(point.q));
    // Along the channel nothing but the ends is felt, so that the middle stays where it was; the height is the head's.
    const double rest_m = c.pose.center[1];
    c.pose.center =
        middle + dealii::Tensor<1, 2>({point.drift_x_m, 0.}) - c.pose.rotation() * swimmer_.arm_to_middle(c.shape);
    c.pose.center[1] = rest_m + place_.height_m(point) + point.drift_y_m;
    return c;
  }

  std::optional<Eigen::MatrixXd> ShapeSampler::resistance(const ShapePoint &point) const
  {
    const Configuration<2> c = configuration(point);
    if (swimmer_.elasticity().is_inverted(c.shape))
      return {};
    const Eigen::MatrixXd      tangent = basis_.tangent(point.q);
    std::vector<NodalField<2>> modes;
    for (Eigen::Index k = 0; k < tangent.cols(); ++k)
      modes.push_back(nodal_field<2>(tangent.col(k)));
    try
    {
      const auto      R = compute_motion_resistance(swimmer_, c, modes, MPI_COMM_SELF).matrix;
      Eigen::MatrixXd result(R.m(), R.n());
      for (unsigned int i = 0; i < R.m(); ++i)
        for (unsigned int j = 0; j < R.n(); ++j)
          result(i, j) = R(i, j) / scene_.fluid->viscosity_Pa_s;
      return result;
    }
    catch (const ComputationError &) // the shape touches itself or a wall
    {
      return {};
    }
  }

  void ShapeSampler::compute(const std::vector<ShapePoint> &points)
  {
    int rank, n_ranks;
    MPI_Comm_rank(communicator_, &rank);
    MPI_Comm_size(communicator_, &n_ranks);
    const Eigen::Index n   = basis_.n_coordinates() + n_rigid<2>;
    Eigen::MatrixXd    all = Eigen::MatrixXd::Zero(n * n, static_cast<Eigen::Index>(points.size()));
    for (std::size_t k = rank; k < points.size(); k += n_ranks)
      if (const auto R = resistance(points[k]))
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
