#include <datasets/files/json_entries.h>
#include <datasets/scene/field_period.h>
#include <datasets/scene/field_program_writer.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <datasets/text/csv_writer.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  void write_field_samples(const std::filesystem::path &file, const FieldSamples &samples,
                           const std::string &description)
  {
    const auto &b        = samples.b_T;
    const bool  is_plane = std::all_of(b.begin(), b.end(), [](const auto &v) { return v[2] == 0.; });
    CsvWriter   table(is_plane ? std::vector<std::string>{"time_s", "bx_T", "by_T"}
                               : std::vector<std::string>{"time_s", "bx_T", "by_T", "bz_T"});
    for (std::size_t i = 0; i < b.size(); ++i)
    {
      table.cell(samples.time_s[i]).cell(b[i][0]).cell(b[i][1]);
      if (!is_plane)
        table.cell(b[i][2]);
      table.end_row();
    }
    table.save(file);
    write_json_file(
        period_file(file),
        {{"period_s", samples.period_s}, {"description", description}, {"table_sha256", digest(table.text())}});
  }

  void write_field_program(const std::filesystem::path &file, const FieldProgram &program,
                           const std::string &description)
  {
    if (program.waveform() != FieldProgram::Waveform::sampled)
      throw InputError(fmt::format("{}: only a sampled field can be written as a field program.", file.string()));
    write_field_samples(file, {program.time_s(), program.b_T(), program.period_s()}, description);
  }
} // namespace swimtwin
