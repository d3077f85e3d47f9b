#include <rom/training/sample_store.h>

#include <datasets/files/hdf5_file.h>
#include <datasets/files/hdf5_open.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    Eigen::VectorXd numbers_of(const ShapePoint &point)
    {
      Eigen::VectorXd numbers(point.q.size() + 3);
      numbers << point.q, point.angle_rad, point.drift_x_m, point.drift_y_m;
      return numbers;
    }
  } // namespace

  double UsualPlace::height_m(const ShapePoint &point) const
  {
    return by_sine_m * std::sin(point.angle_rad) + by_coordinate.dot(point.q);
  }

  SampleStore::SampleStore(std::filesystem::path file, std::string key) : file_(std::move(file)), key_(std::move(key))
  {
    if (!std::filesystem::exists(file_))
      return;
    const Hdf5Reader reader(file_);
    require_seal(file_, "remove it, and --resume computes the samples again");
    if (reader.read_text_attribute("/", "key") != key_)
      return;
    const Eigen::MatrixXd points = reader.read_matrix("/points"), resistances = reader.read_matrix("/resistances");
    const auto            n = static_cast<Eigen::Index>(std::lround(std::sqrt(resistances.cols())));
    for (Eigen::Index k = 0; k < points.rows(); ++k)
    {
      points_.push_back(points.row(k).transpose());
      const bool failed = resistances(k, 0) == 0.;
      resistances_.push_back(failed ? Eigen::MatrixXd() : Eigen::MatrixXd(resistances.row(k).reshaped(n, n)));
    }
  }

  const Eigen::MatrixXd *SampleStore::find(const ShapePoint &point) const
  {
    const Eigen::VectorXd wanted = numbers_of(point);
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (points_[k] == wanted)
        return &resistances_[k];
    return nullptr;
  }

  void SampleStore::add(const ShapePoint &point, const Eigen::MatrixXd &resistance)
  {
    points_.push_back(numbers_of(point));
    resistances_.push_back(resistance);
  }

  void SampleStore::save() const
  {
    if (points_.empty())
      return;
    const Eigen::Index m = points_.front().size(), n          = m; // r + 3 of both
    Eigen::MatrixXd    points(points_.size(), m), resistances = Eigen::MatrixXd::Zero(points_.size(), n * n);
    for (std::size_t k = 0; k < points_.size(); ++k)
    {
      points.row(k) = points_[k].transpose();
      if (resistances_[k].size() > 0)
        resistances.row(k) = resistances_[k].reshaped().transpose();
    }
    Hdf5Writer writer;
    writer.write_matrix("/points", points, {"m, rad, m", "coordinates; angle of the head; drift of the body's middle"});
    writer.write_matrix("/resistances", resistances,
                        {"1, m, m^2",
                         "resistance for unit viscosity, per unit depth, one matrix per row; zero where the "
                         "shape cannot be"});
    writer.write_attribute("/", "key", key_);
    writer.save(file_, Seal::appended);
  }
} // namespace swimtwin
