// From a scene to one reduced swimmer: runs, modes, elasticity, resistance, and what they are worth.
#pragma once

#include <fom/body/swimmer.h>
#include <rom/training/aim.h>
#include <rom/training/cpu_budget.h>
#include <rom/training/pose_dependence.h>
#include <rom/training/resistance_fit.h>
#include <rom/training/sampled_shapes.h>
#include <rom/training/shape_sampler.h>
#include <rom/training/tail_basis.h>
#include <rom/training/training_options.h>
#include <rom/training/training_runs.h>

#include <mpi.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace swimtwin
{
  struct SampleFiles
  {
    std::string of_runs, with_given;
  };

  /// A model with a given number of coordinates, and all that it was made from, so that it can be made better. Scene,
  /// options and budget must live as long. Every member that does work is collective, and leaves the model with the
  /// record of what it is worth. In the dimensions of the scene; in space motions keep to the plane of x and y.
  template <int dim>
  class Training
  {
  public:
    /// The samples of the resistance are kept in a file of the folder, in another one if modes or region of the runs'
    /// shapes do not do for those given too.
    Training(const Scene &scene, const TrainingOptions &options, int n_coordinates, const SampleFiles &files,
             CpuBudget &budget, MPI_Comm communicator);

    /// Throws InputError for snapshots of another swimmer, ComputationError where no resistance can be had.
    void make_model();
    /// With the set of monomials that is best, without economy.
    void fit_finely();
    /// What comes after is fitted as usual.
    void give_up_fine_fits() { is_fine_ = false; }
    bool is_fine() const { return is_fine_; }
    /// Of the resistance, where the reduced swimmer goes and the fit is least sure.
    void add_samples(int n);

    const ReducedModel &model() const { return model_; }
    int                 n_coordinates() const { return basis_.n_coordinates(); }
    int                 n_samples() const { return static_cast<int>(samples_.size()); }
    KnownShares         known_shares() const;

  private:
    void                     take_snapshots();
    std::vector<SnapshotSet> read_sets(const std::vector<std::filesystem::path> &files) const;
    TrainingRunOptions       run_options(const std::string &folder, const std::string &stage) const;
    void                     choose_shapes();
    bool                     do_for_given();
    void                     keep_variables(ShapePoint &point) const;
    void                     choose_basis();
    void                     choose_modes();
    void                     choose_bending();
    void                     follow_head();
    void                     forget_heights();
    std::string              key_of_samples() const;
    void                     choose_region(ShapeSampler &sampler);
    double                   share_of_displacement(double change) const;
    void                     sample_resistance(ShapeSampler &sampler);
    std::vector<ShapePoint>  sample_edge(ShapeSampler &sampler);
    void                     favour_use();
    void                     explore_and_fit(int n, bool is_last);
    FitEconomy               economy(bool is_last) const;
    void fit(ShapeSampler &sampler, const std::vector<ShapePoint> &points, const FitEconomy &economy);
    void hold_out_samples(ShapeSampler &sampler);
    void judge();
    void record_velocity_errors();
    void record();
    void compare();
    void book(const std::string &purpose) { budget_.book(purpose); }
    void report(const std::string &stage, int done, int total) const;

    const Scene                                              &scene_;
    const TrainingOptions                                    &options_;
    int                                                       n_coordinates_;
    SampleFiles                                               files_;
    CpuBudget                                                &budget_;
    MPI_Comm                                                  communicator_;
    Swimmer<dim>                                              swimmer_;
    SnapshotSet                                               tail_; ///< its mesh alone
    TailSpace                                                 space_;
    std::vector<std::filesystem::path>                        sources_;
    std::vector<SnapshotSet>                                  sets_, given_;
    int                                                       n_snapshots_ = 0;
    TailBasis                                                 basis_;
    ShapePoint                                                rest_;
    std::vector<ShapePoint>                                   shapes_seen_, used_;
    Wandering                                                 wandering_;
    SampledRegion                                             region_;
    PoseDependence                                            pose_;
    Eigen::VectorXd                                           effects_;
    std::unique_ptr<SampleStore>                              store_;
    std::unique_ptr<ShapeResistance<dim>>                     resistance_;
    std::unique_ptr<ShapeSampler>                             sampler_;
    std::vector<ShapePoint>                                   points_;           ///< where samples are wanted
    int                                                       explored_ = 1;     ///< of the range's members, the next
    bool                                                      is_fine_  = false; ///< the fit
    std::vector<ResistanceSample>                             samples_;
    std::unique_ptr<ResistanceFit>                            fit_;
    std::vector<std::pair<ResistanceSample, Eigen::VectorXd>> held_out_samples_; ///< and velocities
    ReducedModel                                              model_;
  };
} // namespace swimtwin
