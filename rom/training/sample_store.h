// Resistance samples on disk, so that an interrupted training goes on.
#pragma once

#include <Eigen/Dense>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// A shape and a pose at which the resistance is wanted.
  struct ShapePoint
  {
    Eigen::VectorXd q;
    double          angle_rad = 0.; ///< of the head
    double          drift_x_m = 0.; ///< of the body's middle along x
    double          drift_y_m = 0.; ///< of the head's centre above its usual height
    double          weight    = 1.; ///< in fits: shapes that no motion went through count less
  };

  /// How high the head's centre usually is in a domain that stays: a swing of the head and a bend of the tail push it
  /// sideways, always the same way. What is above that is a variable of its own between walls that are felt.
  struct UsualPlace
  {
    double          by_sine_m = 0.; ///< height per sine of the head's angle
    Eigen::VectorXd by_coordinate;  ///< height per coordinate q

    double height_m(const ShapePoint &point) const;
  };

  /// Remembers samples by the exact numbers of their points, failures too. Every rank reads, rank 0 writes.
  class SampleStore
  {
  public:
    /// `key` names what samples depend on beside their points: scene and basis. A file with another key, or none, is
    /// forgotten.
    SampleStore(std::filesystem::path file, std::string key);

    /// The sample of a point, or null. One of size zero stands for a shape that cannot be.
    const Eigen::MatrixXd *find(const ShapePoint &point) const;
    void                   add(const ShapePoint &point, const Eigen::MatrixXd &resistance);
    /// Write all of them.
    void save() const;

  private:
    std::filesystem::path        file_;
    std::string                  key_;
    std::vector<Eigen::VectorXd> points_; ///< q, angle, drift
    std::vector<Eigen::MatrixXd> resistances_;
  };
} // namespace swimtwin
