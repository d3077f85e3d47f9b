// The magnetic field, and gravity.
#include <datasets/scene/field_period.h>
#include <datasets/scene/scene_parts.h>
#include <datasets/scene/scene_rules.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <datasets/text/csv_table.h>
#include <datasets/text/text_decoding.h>

namespace swimtwin
{
  namespace
  {
    /// A relative path of a field program is relative to the scene file.
    std::filesystem::path program_path(const std::string &program, const std::filesystem::path &folder)
    {
      return std::filesystem::path(program).is_absolute() ? std::filesystem::path(program) : folder / program;
    }

    /// From the file beside the program into the scene, which has to say by itself what was played; 0 without one.
    double take_over_stated_period(TomlDocument &document, const std::filesystem::path &program)
    {
      const std::optional<double> period_s = stated_period_s(program);
      if (period_s)
        document.set_number("field", "period_s", *period_s);
      return period_s.value_or(0.);
    }
  } // namespace

  FieldProgram read_field(TomlDocument &document, const std::filesystem::path &folder)
  {
    TomlTable              table(document, "field");
    FieldProgram::Waveform waveform = FieldProgram::Waveform::sinusoidal;
    double                 bx_T = 0., by_T = 0., frequency_Hz = 0., period_s = 0., ramp_s = 0.;
    FieldAlongZ            along_z;
    std::string            program, program_digest;
    read_choice(table, "waveform", waveform);
    table.number("bx_T", optional("T", any_number), bx_T);
    table.number("by_T", optional("T", any_number), by_T);
    table.number("bz_T", optional("T", any_number), along_z.bz_T);
    table.number("bz_phase_rad", optional("rad", any_number), along_z.phase_rad);
    table.number("frequency_Hz", optional("Hz"), frequency_Hz);
    table.text("program", program);
    table.text("program_sha256", program_digest);
    table.number("period_s", optional("s"), period_s);
    table.number("ramp_s", optional("s", not_negative), ramp_s);
    table.finish();
    if (!table.present())
      return {};
    const std::filesystem::path file = program_path(program, folder);
    if (table.has("program") && !table.has("period_s"))
      period_s = take_over_stated_period(document, file);
    check_field_entries(document);

    FieldProgram field;
    if (table.has("program"))
    {
      const std::string actual = digest(read_text_file(file, "the field program"));
      if (!program_digest.empty() && program_digest != actual)
        document.refuse("field", "program",
                        "has changed since this scene was written; remove program_sha256 to use the new content.");
      document.set_text("field", "program_sha256", actual);
      field = FieldProgram::read_csv(file, period_s);
    }
    else if (waveform == FieldProgram::Waveform::constant)
      field = FieldProgram::constant(bx_T, by_T, along_z.bz_T);
    else
      field = FieldProgram::sinusoidal(bx_T, by_T, frequency_Hz, along_z);
    field.ramp_s = ramp_s;
    return field;
  }

  Gravity read_gravity(const TomlDocument &document, const int dimension)
  {
    TomlTable  table(document, "gravity");
    Gravity    gravity;
    auto      &g    = gravity.acceleration_m_s2;
    const auto rule = required("m/s^2", any_number);
    if (dimension == 3 && table.array_size("acceleration_m_s2") != 2) // two: no component along z
      table.triple("acceleration_m_s2", rule, g);
    else
    {
      std::array<double, 2> in_plane{};
      table.pair("acceleration_m_s2", rule, in_plane);
      g = {in_plane[0], in_plane[1], 0.};
    }
    table.number("ramp_s", optional("s", not_negative), gravity.ramp_s);
    table.finish();
    return gravity;
  }
} // namespace swimtwin
