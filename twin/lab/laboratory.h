// An imagined laboratory: the other end of the twin's pipe.
#pragma once

#include <twin/lab/coil_driver.h>
#include <twin/lab/laboratory_options.h>
#include <twin/lab/laboratory_swimmer.h>
#include <twin/lab/reduced_laboratory_swimmer.h>
#include <twin/measurement/camera_sensor.h>

namespace swimtwin
{
  /// A frame as it is sent.
  struct CapturedFrame
  {
    double                stamp_s = 0., arrives_s = 0.;
    std::vector<Sighting> observations; ///< empty: the camera sent nothing
  };

  /// Its camera films a swimmer in the field of its coils. The same for a seed, to the last digit.
  class Laboratory
  {
  public:
    /// Coils and swimmer must live as long.
    Laboratory(CoilDriver &coils, LaboratorySwimmer &swimmer, const LaboratoryCamera &camera, unsigned int seed);
    Laboratory(const Laboratory &)            = delete;
    Laboratory &operator=(const Laboratory &) = delete;

    /// What the coils are told.
    FieldSignal             &command() { return coils_.command(); }
    const LaboratorySwimmer &swimmer() const { return swimmer_; }

    /// To the next frame's instant. Throws ComputationError if the swimmer's motion is lost.
    CapturedFrame next_frame();
    double        next_frame_s() const { return static_cast<double>(n_frames_ + 1) / camera_.frames_per_second; }
    double        now_s() const { return now_s_; }

  private:
    Sighting noisy(int kind, double place, double sigma);

    CoilDriver           &coils_;
    LaboratorySwimmer    &swimmer_;
    LaboratoryCamera      camera_;
    Chance                chance_;
    double                now_s_    = 0.;
    long                  n_frames_ = 0;
    std::vector<Sighting> last_seen_;
  };

  /// One with a reduced swimmer.
  struct ReducedLaboratory
  {
    CoilDriver               coils;
    ReducedLaboratorySwimmer swimmer;
    Laboratory               lab;

    /// `reduced` and `axis` must live as long.
    ReducedLaboratory(const ReducedSwimmer &reduced, const TailAxis &axis, const LaboratoryOptions &options)
        : coils(options.coils), swimmer(reduced, axis, coils.played(), options),
          lab(coils, swimmer, options.camera, options.seed)
    {
    }
  };
} // namespace swimtwin
