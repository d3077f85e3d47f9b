#include <datasets/files/hdf5_file.h>
#include <datasets/files/hdf5_provenance.h>

namespace swimtwin
{
  void write_provenance(Hdf5Writer &writer, const Provenance &provenance)
  {
    writer.write_attribute("/", "program_version", provenance.program_version);
    writer.write_attribute("/", "command_line", provenance.command_line);
    writer.write_attribute("/", "scene_text", provenance.scene_text);
    writer.write_attribute("/", "scene_hash", provenance.scene_hash);
    writer.write_attribute("/", "created", provenance.created);
    writer.write_attribute("/", "wall_time_s", provenance.wall_time_s);
  }
} // namespace swimtwin
