#include <datasets/run/plane_flow.h>

#include <datasets/files/hdf5_file.h>
#include <datasets/files/hdf5_provenance.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    const std::string group_of_instants = "/instants";

    std::string numbered(const std::string &parent, const std::size_t number)
    {
      return fmt::format("{}/{}", parent, number);
    }

    void require_samples(const Hdf5Reader &reader, const std::string &group, const PlaneFlow &flow)
    {
      const auto n       = static_cast<Eigen::Index>(flow.x_m.size() * flow.y_m.size());
      const auto n_rates = flow.velocity_m_s.cols();
      if (flow.x_m.size() < 2 || flow.y_m.size() < 2)
        reader.refuse(group, "has no grid: x_m and y_m need two values or more.");
      if (flow.velocity_m_s.rows() != n || (n_rates != 2 && n_rates != 3) || flow.part.size() != n)
        reader.refuse(group, fmt::format("has {} x {} velocities and {} parts of {} samples.", flow.velocity_m_s.rows(),
                                         n_rates, flow.part.size(), n));
      if (flow.part.minCoeff() < 0 || flow.part.maxCoeff() > static_cast<int>(SampledPart::tail))
        reader.refuse(group + "/part", "has other numbers than 0, 1, 2 and 3.");
    }

    Eigen::MatrixXd read_chords(const Hdf5Reader &reader, const std::string &path)
    {
      Eigen::MatrixXd chords = reader.read_matrix(path);
      if (chords.rows() > 0 && chords.cols() != 4)
        reader.refuse(path, fmt::format("has {} columns; 4 are needed.", chords.cols()));
      return chords;
    }

    void write_plane_flow(Hdf5Writer &writer, const std::string &group, const PlaneFlow &flow)
    {
      writer.write_vector(group + "/x_m", std::span<const double>(flow.x_m), {"m", "x of the samples, evenly"});
      writer.write_vector(group + "/y_m", std::span<const double>(flow.y_m), {"m", "y of the samples, evenly"});
      writer.write_matrix(group + "/velocity_m_s", flow.velocity_m_s,
                          {"m/s", "velocity of fluid and swimmer at z = 0, laboratory, one sample per row, x fastest"});
      writer.write_vector(group + "/part", flow.part, {"1", "of each sample: 0 nothing, 1 fluid, 2 head, 3 tail"});
      const ArrayMeaning chords{"m",
                                "section of the surface at z = 0 by chords: x and y of one end, then of the other"};
      writer.write_matrix(group + "/head_outline_m", flow.head_outline_m, chords);
      writer.write_matrix(group + "/tail_outline_m", flow.tail_outline_m, chords);
      writer.write_attribute(group, "time_s", flow.time_s);
    }

    PlaneFlow read_plane_flow(const Hdf5Reader &reader, const std::string &group)
    {
      PlaneFlow flow;
      flow.time_s                 = reader.read_number_attribute(group, "time_s");
      flow.x_m                    = reader.read_vector(group + "/x_m");
      flow.y_m                    = reader.read_vector(group + "/y_m");
      flow.velocity_m_s           = reader.read_matrix(group + "/velocity_m_s");
      const std::vector<int> part = reader.read_int_vector(group + "/part");
      flow.part                   = Eigen::VectorXi::Map(part.data(), static_cast<Eigen::Index>(part.size()));
      flow.head_outline_m         = read_chords(reader, group + "/head_outline_m");
      flow.tail_outline_m         = read_chords(reader, group + "/tail_outline_m");
      require_samples(reader, group, flow);
      return flow;
    }
  } // namespace

  void write_plane_flows(Hdf5Writer &writer, const std::string &parent, const std::vector<PlaneFlow> &flows)
  {
    for (std::size_t k = 0; k < flows.size(); ++k)
      write_plane_flow(writer, numbered(parent, k), flows[k]);
  }

  std::vector<PlaneFlow> read_plane_flows(const Hdf5Reader &reader, const std::string &parent)
  {
    std::vector<PlaneFlow> flows;
    while (reader.contains(parent) && reader.contains(numbered(parent, flows.size())))
      flows.push_back(read_plane_flow(reader, numbered(parent, flows.size())));
    return flows;
  }

  void write_plane_flows(const std::filesystem::path &file, const std::vector<PlaneFlow> &flows,
                         const Provenance &provenance)
  {
    Hdf5Writer writer;
    write_plane_flows(writer, group_of_instants, flows);
    write_provenance(writer, provenance);
    writer.save(file);
  }

  std::vector<PlaneFlow> read_plane_flows(const std::filesystem::path &file)
  {
    const Hdf5Reader reader(file);
    if (!reader.contains(group_of_instants))
      reader.refuse(group_of_instants, "is missing.");
    return read_plane_flows(reader, group_of_instants);
  }
} // namespace swimtwin
