#include <datasets/files/input_file.h>
#include <datasets/scene/field_period.h>
#include <datasets/text/text_decoding.h>
#include <datasets/text/toml_table.h>
#include <datasets/text/unit_names.h>
#include <datasets/tracks/observation_sidecar.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace swimtwin
{
  namespace
  {
    constexpr Range above_freezing{-50., 150., false, false, "lie between -50 and 150"};

    constexpr Range likelihood_range{0., 1., false, false, "lie between 0 and 1"};

    void note_all(const TomlTable &table, DataProblems &problems)
    {
      for (const std::string &text : table.problems())
        problems.error(text);
    }

    constexpr Range plane_or_space{2., 3., false, false, "be 2 or 3"};

    /// A flat swimmer's data are fitted as well by a model in space, with a wrong stiffness.
    void read_dimension(TomlTable &table, ObservationSidecar &sidecar)
    {
      if (!table.has("dimension"))
        return;
      int dimension = 2;
      table.integer("dimension", {"", plane_or_space}, dimension);
      if (!sidecar.synthetic)
        table.note("dimension", "can be said of computed data only; leave it out, or say synthetic = true.");
      sidecar.dimension = dimension;
    }

    enum class Settled { periodic };
    constexpr std::array<std::pair<std::string_view, Settled>, 1> settled_words{{{"periodic", Settled::periodic}}};

    /// `period = 3`, or `period = "periodic"`.
    void read_period(const TomlDocument &document, TomlTable &table, std::optional<int> &period)
    {
      const toml::node *node = document.find("period");
      if (node != nullptr && node->is_string())
      {
        Settled settled = Settled::periodic;
        return table.choice("period", Need::required, settled_words, settled);
      }
      int number = 1;
      table.integer("period", {"", at_least_one, Need::required}, number);
      period = number;
    }

    void read_words(TomlTable &table, const std::string &key, std::string &target)
    {
      table.text(key, target, Need::required);
      if (table.has(key) && target.empty())
        table.note(key, "is empty; say it in a few words.");
    }

    void read_top_level(const TomlDocument &document, ObservationSidecar &sidecar, DataProblems &problems)
    {
      TomlTable table(document, "");
      read_words(table, "source", sidecar.source);
      table.flag("synthetic", sidecar.synthetic, Need::required);
      read_dimension(table, sidecar);
      read_words(table, "swimmer", sidecar.swimmer);
      read_words(table, "measured_by", sidecar.measured_by);
      read_period(document, table, sidecar.period);
      std::string file;
      table.text("table", file);
      if (!file.empty())
        sidecar.table = sidecar.file.parent_path() / file;
      table.number("body_length_m", {"m", positive}, sidecar.body_length_m);
      for (const char *name : {"fluid", "field", "camera", "recording"})
        table.table(name);
      note_all(table, problems);
    }

    constexpr std::array<std::pair<std::string_view, bool>, 2> inertia_words{{{"full", true}, {"none", false}}};

    void read_fluid(const TomlDocument &document, ObservationSidecar &sidecar, DataProblems &problems)
    {
      TomlTable table(document, "fluid");
      table.number("temperature_C", {"degrees Celsius", above_freezing}, sidecar.temperature_C);
      table.choice("inertia", Need::optional, inertia_words, sidecar.has_inertia);
      if (!sidecar.has_inertia && !sidecar.synthetic)
        table.note("inertia", "can be said of computed data only; leave it out, or say synthetic = true.");
      note_all(table, problems);
      if (!sidecar.temperature_C && !sidecar.synthetic)
        problems.warning(fmt::format("{}: [fluid] temperature_C is missing; the viscosity of glycerol falls by 9 % per "
                                     "degree, so measure it with the next data.",
                                     document.where("fluid")));
    }

    void read_program(const TomlDocument &document, TomlTable &table, ObservationSidecar &sidecar,
                      DataProblems &problems)
    {
      std::string program;
      double      period_s = 0.;
      table.text("program", program);
      const std::filesystem::path file = sidecar.file.parent_path() / program;
      const Need                  need = is_there(period_file(file)) ? Need::optional : Need::required;
      table.number("period_s", {"s", positive, need}, period_s);
      for (const char *other : {"bx_T", "by_T"})
        if (table.has(other))
          problems.error(document.sentence("field", other,
                                           "contradicts the program; keep one of them, bx_T and by_T or program."));
      if (table.problems().empty())
        problems.attempt([&] { sidecar.field = FieldProgram::read_csv(file, period_s); });
    }

    /// Around micro-robots coils make millitesla.
    void warn_of_strong_field(const TomlDocument &document, const FieldProgram &field, DataProblems &problems)
    {
      constexpr double strong_T = 1.;
      const bool       sampled  = field.waveform() == FieldProgram::Waveform::sampled;
      double           most_T   = sampled ? 0. : std::hypot(field.bx_T(), field.by_T());
      for (const auto &b : field.b_T())
        most_T = std::max(most_T, std::hypot(b[0], b[1], b[2]));
      if (most_T > strong_T)
        problems.warning(fmt::format("{}: {} reaches {:.4g} T; it looks like mT in {} of T: check the unit.",
                                     document.where("field"), sampled ? field.file.string() : "the field", most_T,
                                     sampled ? "columns" : "entries"));
    }

    void read_field(const TomlDocument &document, ObservationSidecar &sidecar, DataProblems &problems)
    {
      TomlTable table(document, "field");
      if (!table.present())
        return problems.error(fmt::format(
            "{}: the table [field] is missing; add bx_T and by_T of B = (bx, by sin 2 pi f t), or a program.",
            document.where("")));
      double bx_T = 0., by_T = 0.;
      if (table.has("program"))
        read_program(document, table, sidecar, problems);
      const Need need = table.has("program") ? Need::optional : Need::required;
      table.number("bx_T", {"T", any_number, need}, bx_T);
      table.number("by_T", {"T", any_number, need}, by_T);
      if (!table.has("program"))
      {
        std::string none;
        table.text("program", none);
        sidecar.field = FieldProgram::sinusoidal(bx_T, by_T, 1.);
        if (bx_T == 0. && by_T == 0. && table.problems().empty())
          problems.error(document.sentence("field", "by_T", "is 0, and so is bx_T; without a field nothing swims."));
      }
      note_all(table, problems);
      warn_of_strong_field(document, sidecar.field, problems);
    }

    /// A unit of what `si` measures, or a pixel where that is one.
    void read_unit(TomlTable &table, const char *key, const char *si, const bool may_be_pixel, std::string &unit)
    {
      table.text(key, unit);
      if (!unit.empty() && !unit_factor(unit, si) && !(may_be_pixel && is_pixel(unit)))
        table.note(key, may_be_pixel ? "is not a known unit of length; \"um\", \"mm\", \"inch\" and \"pixel\" are some."
                                     : "is not a known unit of time; \"s\", \"ms\" and \"min\" are some.");
    }

    void read_camera(const TomlDocument &document, ObservationSidecar &sidecar, DataProblems &problems)
    {
      TomlTable table(document, "camera");
      if (!table.present())
        return;
      Camera                camera;
      std::array<double, 2> direction{};
      table.pair("head_first", {"", any_number}, direction);
      if (table.has("head_first"))
        camera.head_first = direction;
      if (camera.head_first && std::hypot(direction[0], direction[1]) == 0.)
        table.note("head_first", "has no direction; [-1, 0] is a head to the left of its tail.");
      table.number("position_sigma_m", {"m", positive}, camera.position_sigma_m);
      table.number("pixel_m", {"m", positive}, camera.pixel_m);
      table.number("frame_s", {"s", positive}, camera.frame_s);
      read_unit(table, "length_unit", "m", true, camera.length_unit);
      read_unit(table, "time_unit", "s", false, camera.time_unit);
      table.number("least_likelihood", {"", likelihood_range}, camera.least_likelihood);
      table.number("period_start_s", {"s", any_number}, camera.period_start_s);
      table.integer("skipped_periods", {"", not_negative}, camera.skipped_periods);
      note_all(table, problems);
      sidecar.camera = camera;
    }

    void read_recording(const TomlDocument &document, const std::string &path, ObservationSidecar &sidecar,
                        DataProblems &problems)
    {
      TomlTable   table(document, path);
      Recording   recording;
      std::string file;
      read_words(table, "file", file);
      table.number("frequency_Hz", {"Hz", positive, Need::required}, recording.frequency_Hz);
      recording.period_start_s = sidecar.camera ? sidecar.camera->period_start_s.value_or(0.) : 0.;
      table.number("period_start_s", {"s", any_number}, recording.period_start_s);
      table.integers("track_id", {"", any_number}, recording.track_ids);
      if (std::set<int>(recording.track_ids.begin(), recording.track_ids.end()).size() < recording.track_ids.size())
        table.note("track_id", "names a track twice; name each piece once.");
      table.text("body_part", recording.body_part);
      table.text("individual", recording.individual);
      recording.file  = sidecar.file.parent_path() / file;
      recording.where = document.where(path);
      note_all(table, problems);
      sidecar.recordings.push_back(recording);
    }

    void read_recordings(const TomlDocument &document, ObservationSidecar &sidecar, DataProblems &problems)
    {
      const toml::node *node = document.find("recording");
      if (node == nullptr)
        return;
      if (!node->is_array_of_tables())
        return problems.error(document.sentence("", "recording", "must be tables: write [[recording]] above each."));
      for (std::size_t i = 0; i < node->as_array()->size(); ++i)
        read_recording(document, fmt::format("recording.{}", i), sidecar, problems);
    }
  } // namespace

  ObservationSidecar read_observation_sidecar(const std::filesystem::path &file, DataProblems &problems)
  {
    ObservationSidecar sidecar;
    sidecar.file = file;
    problems.attempt([&] {
      const TomlDocument document(read_decoded_text(file, "the sidecar"), file.string(), {});
      read_top_level(document, sidecar, problems);
      read_fluid(document, sidecar, problems);
      read_field(document, sidecar, problems);
      read_camera(document, sidecar, problems);
      read_recordings(document, sidecar, problems);
    });
    return sidecar;
  }
} // namespace swimtwin
