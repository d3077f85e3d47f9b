#include <datasets/files/hdf5_file.h>
#include <datasets/files/hdf5_provenance.h>

namespace swimtwin
{
  std::map<std::string, std::string> provenance_texts(const Provenance &provenance)
  {
    return {{"program_version", provenance.program_version},
            {"command_line", provenance.command_line},
            {"scene_text", provenance.scene_text},
            {"scene_hash", provenance.scene_hash},
            {"created", provenance.created}};
  }

  void write_provenance(Hdf5Writer &writer, const Provenance &provenance)
  {
    for (const auto &[name, text] : provenance_texts(provenance))
      writer.write_attribute("/", name, text);
    writer.write_attribute("/", "wall_time_s", provenance.wall_time_s);
  }
} // namespace swimtwin
