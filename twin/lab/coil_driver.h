// Coils of a laboratory: what they are told, and what they play of it.
#pragma once

#include <twin/lab/laboratory_options.h>
#include <twin/motion/field_signal.h>

namespace swimtwin
{
  class CoilDriver
  {
  public:
    explicit CoilDriver(const LaboratoryCoils &coils) : coils_(coils) {}
    CoilDriver(const CoilDriver &)            = delete;
    CoilDriver &operator=(const CoilDriver &) = delete;

    /// What they are told.
    FieldSignal &command() { return command_; }
    /// What they play, with their lag and their steps; known up to where `play_until` went.
    const FieldSignal &played() const { return is_ideal() ? command_ : played_; }
    /// What was played a second before `now_s` is forgotten.
    void play_until(double time_s, double now_s);

  private:
    bool is_ideal() const { return coils_.lag_s <= 0. && coils_.quantisation_T <= 0.; }

    LaboratoryCoils coils_;
    FieldSignal     command_, played_;
    Eigen::Vector2d current_T_     = Eigen::Vector2d::Zero();
    double          known_until_s_ = 0.;
  };
} // namespace swimtwin
