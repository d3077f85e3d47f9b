// A Kalman filter whose observations may be late: a window of the past is kept and gone through again.
#pragma once

#include <twin/filter/jump_test.h>
#include <twin/filter/noise_level.h>
#include <twin/filter/robustness.h>
#include <twin/filter/square_root_filter.h>
#include <twin/filter/system.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace swimtwin
{
  struct FilterOptions
  {
    double     window_s   = 2.; ///< how late an observation may be
    Robustness robustness = {};
    /// An update whose innovation is farther off than this (standard deviations) is iterated: Gauss and Newton's steps
    /// on the nonlinear expectation.
    double iterate_beyond = 2.;
    int    max_iterations = 4;
    bool   learns_jumps   = true;
  };

  /// An instant of the window.
  struct FilterNode
  {
    double                                        time_s = 0.;
    Belief                                        predicted, filtered;
    Eigen::MatrixXd                               transition, noise; ///< from the instant before
    std::vector<Sighting>                         observations;      ///< in an order of their own
    std::vector<Innovation>                       innovations;       ///< of each of them
    std::array<NoiseLevel, max_observation_kinds> noise_levels;
    JumpTest                                      jumps;
    double                                        log_likelihood = 0.; ///< of the observations here
  };

  enum class Insertion {
    in_order,
    replayed, ///< it was late: what came after it was gone through again
    too_old,  ///< before the window
    failed    ///< the process found no way on
  };

  /// The result depends on what was seen when, not on the order in which it came: to the last digit where nothing left
  /// the window in between.
  class WindowFilter
  {
  public:
    /// Both must live as long.
    WindowFilter(Process &process, Sensor &sensor, const FilterOptions &options);

    /// `levels` null: noise is learned from the sensor's first guesses.
    void start(double time_s, const Belief &belief, const JumpTest &jumps = {},
               const std::array<NoiseLevel, max_observation_kinds> *levels = nullptr);
    bool has_started() const { return n_nodes_ > 0; }
    void stop() { n_nodes_ = 0; }

    Insertion add(const Frame &frame);
    /// Go through the whole window again with frames at other times: `new_time_s(old)`. For a sensor whose reference
    /// has moved.
    template <typename Function>
    bool retime(const Function &new_time_s)
    {
      gather_frames(0);
      for (Frame &frame : frames_in_use())
        frame.time_s = new_time_s(frame.time_s);
      for (Widening &widening : widenings_)
        widening.time_s = new_time_s(widening.time_s);
      return replay_from_start();
    }
    /// Go through all after an instant again: the process has learned something about that time.
    bool revisit(double time_s);
    /// Something changed between two instants: let the belief be wider in one direction at a few instants seen there,
    /// and go through all since then again. The test for jumps forgets what was before.
    bool widen(double from_s, double to_s, const Eigen::VectorXd &direction);

    int               n_nodes() const { return n_nodes_; }
    const FilterNode &node(const int i) const { return *nodes_[static_cast<std::size_t>(i)]; }
    const FilterNode &latest() const { return node(n_nodes_ - 1); }
    /// The belief carried to a later instant; nothing is kept. False if there is no way on.
    bool predict(double time_s, Belief &belief);
    bool predict(double from_s, double to_s, Belief &belief);

    FilterOptions options;
    /// Before this instant little is known of the parameters: an outlier is what is beyond the sensor's largest
    /// residual, not what is beyond the gate.
    double gated_from_s = -1e300;

  private:
    FilterNode &latest_node() { return *nodes_[static_cast<std::size_t>(n_nodes_ - 1)]; }
    struct Widening
    {
      double          time_s = 0.;
      Eigen::VectorXd direction;
    };

    void             apply(const Widening &widening, FilterNode &node);
    void             gather_frames(int first);
    void             gather(double time_s, const std::vector<Sighting> &observations);
    std::span<Frame> frames_in_use() { return {frames_.data(), n_frames_}; }
    bool             replay_from_start();
    void             go_back_before(double time_s);
    bool             go_through_frames();
    FilterNode      &append(double time_s);
    bool             go_to(double time_s);
    void             observe(FilterNode &node);
    void             take_in(const Sighting &observation, Innovation &innovation, FilterNode &node);
    void             trim();

    Process         &process_;
    Sensor          &sensor_;
    SquareRootFilter algebra_;
    UpdateRecord     record_;
    Belief           trial_;
    Eigen::MatrixXd  slopes_, transition_, noise_;
    Eigen::VectorXd  residual_, shift_;

    std::vector<std::unique_ptr<FilterNode>> nodes_; ///< the first n_nodes_ are in use, others keep their memory
    int                                      n_nodes_ = 0;
    std::vector<Frame>                       frames_; ///< gathered for a replay
    std::size_t                              n_frames_ = 0;
    std::vector<Widening>                    widenings_; ///< within the window
  };
} // namespace swimtwin
