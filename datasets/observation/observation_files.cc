#include <datasets/files/input_file.h>
#include <datasets/observation/observation_files.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr std::array<std::string_view, 8> endings{"", ".csv", ".tsv", ".txt", ".tab", ".dat", ".asc", ".xls"};

    std::string ending_of(const fs::path &file)
    {
      return boost::algorithm::to_lower_copy(file.extension().string());
    }

    bool are_one_file(const fs::path &a, const fs::path &b)
    {
      std::error_code error;
      return a.lexically_normal() == b.lexically_normal() || (fs::equivalent(a, b, error) && !error);
    }

    /// Files beside a sidecar that have its name and the ending of a table.
    std::vector<fs::path> tables_beside(const fs::path &sidecar)
    {
      std::vector<fs::path> tables;
      std::error_code       error;
      const fs::path        folder = sidecar.has_parent_path() ? sidecar.parent_path() : fs::path(".");
      for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
      {
        const fs::path name = entry->path().filename();
        const bool     is_candidate =
            name == sidecar.stem() || (name.stem() == sidecar.stem() &&
                                       std::find(endings.begin(), endings.end(), ending_of(name)) != endings.end());
        if (is_candidate && entry->is_regular_file(error))
          tables.push_back(sidecar.parent_path() / name);
      }
      std::sort(tables.begin(), tables.end());
      return tables;
    }

    std::string names_of(const std::vector<fs::path> &files)
    {
      std::vector<std::string> names;
      for (const fs::path &file : files)
        names.push_back(file.filename().string());
      return fmt::format("{}", fmt::join(names, ", "));
    }

    fs::path only_table_beside(const fs::path &sidecar, DataProblems &problems)
    {
      const std::vector<fs::path> tables = tables_beside(sidecar);
      if (tables.size() == 1)
        return tables.front();
      const std::string name = sidecar.stem().string();
      if (tables.empty())
        problems.error(
            fmt::format("{}: no table lies beside this sidecar; put {}.csv there, or name it in the sidecar: "
                        "table = \"...\".",
                        sidecar.string(), name));
      else
        problems.error(
            fmt::format("{}: {} lie beside this sidecar; name the one to read with --data, or in the sidecar: "
                        "table = \"{}\".",
                        sidecar.string(), names_of(tables), tables.front().filename().string()));
      return {};
    }

    /// A table that is named is read, and nothing else: recordings must all be of it.
    fs::path named_table(const fs::path &named, const ObservationSidecar &sidecar, DataProblems &problems)
    {
      if (!sidecar.table.empty() && !are_one_file(sidecar.table, named))
        problems.error(fmt::format(
            "{}: its sidecar {} belongs to another table, table = \"{}\"; name that one, or give this "
            "one a sidecar of its own, {}.toml.",
            named.string(), sidecar.file.string(), sidecar.table.filename().string(), named.filename().string()));
      std::vector<fs::path> others;
      for (const Recording &recording : sidecar.recordings)
        if (!are_one_file(recording.file, named))
          others.push_back(recording.file);
      if (!others.empty())
        problems.error(
            fmt::format("{}: its sidecar {} reads {} ([[recording]]), not only this table; name the sidecar to "
                        "read them.",
                        named.string(), sidecar.file.string(), names_of(others)));
      return sidecar.recordings.empty() ? named : fs::path();
    }
  } // namespace

  bool is_sidecar(const fs::path &file)
  {
    return ending_of(file) == ".toml";
  }

  fs::path sidecar_of(const fs::path &table)
  {
    fs::path own = table, shared = table;
    own += ".toml";
    return is_there(own) ? own : shared.replace_extension(".toml");
  }

  fs::path table_to_read(const fs::path &named, const ObservationSidecar &sidecar, DataProblems &problems)
  {
    if (!is_sidecar(named))
      return named_table(named, sidecar, problems);
    if (!sidecar.recordings.empty() && sidecar.table.empty())
      return {};
    if (!sidecar.recordings.empty())
      problems.error(fmt::format("{}: table = \"{}\" and [[recording]] both say what to read; keep one of them.",
                                 named.string(), sidecar.table.filename().string()));
    return sidecar.table.empty() ? only_table_beside(named, problems) : sidecar.table;
  }
} // namespace swimtwin
