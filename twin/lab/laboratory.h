// An imagined laboratory on the reduced model: the other end of the twin's pipe.
#pragma once

#include <twin/lab/laboratory_options.h>
#include <twin/measurement/camera_sensor.h>

#include <optional>
#include <random>

namespace swimtwin
{
  /// A frame as it is sent.
  struct CapturedFrame
  {
    double                stamp_s = 0., arrives_s = 0.;
    std::vector<Sighting> observations; ///< empty: the camera sent nothing
  };

  /// The same for a seed, to the last digit.
  class Laboratory
  {
  public:
    /// `swimmer` and `axis` must live as long.
    Laboratory(const ReducedSwimmer &swimmer, const TailAxis &axis, const LaboratoryOptions &options);
    Laboratory(const Laboratory &)            = delete;
    Laboratory &operator=(const Laboratory &) = delete;

    /// What the coils are told; they play it with their lag and their steps.
    FieldSignal &command() { return command_; }

    /// To the next frame's instant. Throws ComputationError if the swimmer's motion is lost.
    CapturedFrame next_frame();
    double next_frame_s() const { return static_cast<double>(n_frames_ + 1) / options_.camera.frames_per_second; }

    double                 now_s() const { return now_s_; }
    const Eigen::VectorXd &truth() const { return state_; } ///< swimmer and all parameters, as in layout()
    const TwinLayout      &layout() const { return process_.layout(); }
    /// The truth as a state of another layout.
    Eigen::VectorXd truth_in(const TwinLayout &layout) const;

  private:
    void     advance(double to_s);
    void     apply_changes(double from_s, double to_s);
    void     play_coils(double to_s);
    Sighting noisy(int kind, double place, double sigma);

    LaboratoryOptions options_;
    FieldSignal       command_, played_;
    TwinProcess       process_;
    CameraSensor      camera_;
    Eigen::VectorXd   state_;
    Eigen::MatrixXd   transition_, noise_;
    Eigen::Vector2d   coil_T_ = Eigen::Vector2d::Zero();
    double            now_s_ = 0., coils_s_ = 0.;
    long              n_frames_ = 0;

    std::mt19937_64                  random_;
    std::normal_distribution<double> normal_;
    std::vector<Sighting>            last_seen_;
  };
} // namespace swimtwin
