#include <datasets/files/json_entries.h>
#include <datasets/scene/field_period.h>
#include <datasets/system/error.h>
#include <datasets/text/csv_table.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    /// Null for what is no JSON object, or lacks the entry.
    Json entry(const Json &json, const char *key)
    {
      return json.is_object() && json.contains(key) ? json[key] : Json();
    }

    void require_same_table(const fs::path &program, const fs::path &file, const Json &stated)
    {
      const Json hash = entry(stated, "table_sha256");
      if (hash.is_string() && hash != digest(read_text_file(program, "the field program")))
        throw InputError(fmt::format("{} states the period of another table than {}, which has changed since; give "
                                     "period_s yourself, or write it to {} without table_sha256.",
                                     file.string(), program.string(), file.filename().string()));
    }
  } // namespace

  fs::path period_file(const fs::path &program)
  {
    return fs::path(program).replace_extension(".json");
  }

  std::optional<double> stated_period_s(const fs::path &program)
  {
    const fs::path  file = period_file(program);
    std::error_code unreadable;
    if (!fs::exists(file, unreadable))
      return std::nullopt;
    const Json   stated   = Json::parse(read_text_file(file, "the period"), nullptr, false);
    const Json   period   = entry(stated, "period_s");
    const double period_s = period.is_number() ? period.get<double>() : 0.;
    if (!std::isfinite(period_s) || period_s <= 0.)
      throw InputError(fmt::format("{}: a positive number period_s, the period of {} in s, is missing; write "
                                   "{{\"period_s\": 1.25}}, or give period_s with the program.",
                                   file.string(), program.filename().string()));
    require_same_table(program, file, stated);
    return period_s;
  }
} // namespace swimtwin
