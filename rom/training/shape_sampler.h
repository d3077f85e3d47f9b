// Resistance of the reduced swimmer at many shapes, shared out over ranks.
#pragma once

#include <fom/body/swimmer.h>
#include <rom/training/sample_store.h>
#include <rom/training/tail_basis.h>

#include <functional>
#include <optional>

namespace swimtwin
{
  struct ResistanceSample
  {
    ShapePoint      point;
    Eigen::MatrixXd resistance; ///< unit viscosity, per unit depth, (r + 3) x (r + 3): R^T dx/dt, omega, dq/dt
  };

  class ShapeSampler
  {
  public:
    /// Every rank keeps a swimmer of its own. What the store has is not computed again, and it grows as samples come.
    /// All must outlive this. Collective.
    ShapeSampler(const Scene &scene, const TailBasis &basis, const UsualPlace &place, SampleStore &store,
                 MPI_Comm communicator);

    /// Samples in the order of the points; without those shapes that turn the tail inside out or cannot be meshed.
    /// Collective.
    std::vector<ResistanceSample> sample(const std::vector<ShapePoint>       &points,
                                         const std::function<void(int, int)> &on_progress = {});

    const Swimmer<2> &swimmer() const { return swimmer_; }

  private:
    Configuration<2>               configuration(const ShapePoint &point) const;
    std::optional<Eigen::MatrixXd> resistance(const ShapePoint &point) const;
    void                           compute(const std::vector<ShapePoint> &points);

    const Scene     &scene_;
    const TailBasis &basis_;
    UsualPlace       place_;
    SampleStore     &store_;
    MPI_Comm         communicator_;
    Swimmer<2>       swimmer_;
  };

} // namespace swimtwin
