#include <datasets/error.h>
#include <datasets/field_program_writer.h>
#include <datasets/output_folder.h>

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace swimtwin
{
  namespace
  {
    std::string commented(const std::string &text)
    {
      std::istringstream lines(text);
      std::string        result, line;
      while (std::getline(lines, line))
        result += "# " + line + "\n";
      return result;
    }
  } // namespace

  void write_field_program(const std::filesystem::path &file, const FieldProgram &program, const std::string &comment)
  {
    if (program.waveform() != FieldProgram::Waveform::sampled)
      throw InputError(fmt::format("{}: only a sampled field can be written as a field program.", file.string()));
    const auto &b        = program.b_T();
    const bool  is_plane = std::all_of(b.begin(), b.end(), [](const auto &v) { return v[2] == 0.; });
    std::string text     = commented(comment);
    text += fmt::format("# period_s = {:.17g}\n", program.period_s());
    text += is_plane ? "time_s,bx_T,by_T\n" : "time_s,bx_T,by_T,bz_T\n";
    for (std::size_t i = 0; i < b.size(); ++i)
    {
      text += fmt::format("{:.17g},{:.17g},{:.17g}", program.time_s()[i], b[i][0], b[i][1]);
      text += is_plane ? "\n" : fmt::format(",{:.17g}\n", b[i][2]);
    }
    write_text_atomically(file, text);
  }
} // namespace swimtwin
