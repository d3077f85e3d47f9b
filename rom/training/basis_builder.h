// The reduced tail's shapes from snapshots, from the elastic tail alone, or from both.
#pragma once

#include <datasets/run/snapshot_set.h>
#include <rom/training/pod.h>
#include <rom/training/tail_stiffness.h>

#include <string>

namespace swimtwin
{
  /// Collects snapshots, from one file after another, with their mirror images: modes then have exact parity.
  class BasisBuilder
  {
  public:
    /// Both must outlive this. Collective.
    BasisBuilder(const TailSpace &space, const TailStiffness &stiffness, MPI_Comm communicator);
    /// Throws InputError naming `origin` if the set has another tail mesh. Collective.
    void add(const SnapshotSet &set, const std::string &origin);
    int  n_snapshots() const { return odd_.n_snapshots(); }

    /// Coordinates are the bending modes of the snapshots, then those of the elastic tail that are missing; without
    /// snapshots all are elastic. Followers and their amplitudes are those that fit the snapshots, and where the
    /// snapshots do not tell, the shortening of the elastic tail. Collective.
    TailBasis compute(int n_coordinates, int n_followers) const;

  private:
    Eigen::MatrixXd snapshots() const;
    void            choose_coordinates(TailBasis &basis, int n) const;
    Eigen::VectorXd coordinate_sizes(const Eigen::MatrixXd &q) const;
    Eigen::MatrixXd shortenings(const TailBasis &basis) const;
    void            choose_followers(TailBasis &basis, const Eigen::MatrixXd &X, int n) const;
    void            record_quality(TailBasis &basis, const Eigen::MatrixXd &X) const;

    const TailSpace             &space_;
    const TailStiffness         &stiffness_;
    MPI_Comm                     communicator_;
    PodBuilder                   odd_, even_;
    std::vector<Eigen::MatrixXd> snapshots_; ///< of each set, one snapshot per column
  };
} // namespace swimtwin
