// The flow in the swimmer's plane of motion at a few instants: what its picture is made from.
#pragma once

#include <Eigen/Dense>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  class Hdf5Reader;
  class Hdf5Writer;
  struct Provenance;

  /// What a sample lies in.
  enum class SampledPart { nothing, fluid, head, tail };

  /// One instant, on a grid around the swimmer in the plane z = 0 (laboratory). Sample i of x and j of y is row j n_x +
  /// i.
  struct PlaneFlow
  {
    double              time_s = 0.;
    std::vector<double> x_m, y_m;     ///< evenly spaced
    Eigen::MatrixXd     velocity_m_s; ///< n_samples x dim, of fluid and swimmer; zero where there is nothing
    Eigen::VectorXi     part;         ///< n_samples, SampledPart
    Eigen::MatrixXd head_outline_m, tail_outline_m; ///< chords of the section: x and y of one end, then of the other
  };

  /// Groups /instants/0, /instants/1, ... (docs/file-formats.md), provenance as attributes of the root. Written to a
  /// temporary name, then renamed. Reading throws InputError that names file and dataset.
  void                   write_plane_flows(const std::filesystem::path &file, const std::vector<PlaneFlow> &flows,
                                           const Provenance &provenance);
  std::vector<PlaneFlow> read_plane_flows(const std::filesystem::path &file);

  /// The groups of a file that are numbered from 0 below `parent`, in their order.
  std::vector<PlaneFlow> read_plane_flows(const Hdf5Reader &reader, const std::string &parent);
  void write_plane_flows(Hdf5Writer &writer, const std::string &parent, const std::vector<PlaneFlow> &flows);
} // namespace swimtwin
