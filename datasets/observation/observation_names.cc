#include <datasets/observation/observation_names.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace swimtwin
{
  namespace
  {
    /// Level 0: `run`; 1: `run.csv`; 2: `monday/run`; 3: `monday/run.csv`; 4: `may/monday/run` ...
    std::string name_at(const ObservationSet &set, const std::size_t level)
    {
      std::error_code             error;
      const std::filesystem::path file   = std::filesystem::weakly_canonical(set.file, error);
      std::string                 name   = (level % 2 == 0 ? file.stem() : file.filename()).string();
      std::filesystem::path       folder = file.parent_path();
      for (std::size_t i = 0; i < level / 2 && folder.has_relative_path(); ++i, folder = folder.parent_path())
        name = folder.filename().string() + "/" + name;
      return name;
    }

    bool tells_apart(const std::vector<ObservationSet *> &sets, const std::size_t level)
    {
      std::set<std::string> names;
      return std::all_of(sets.begin(), sets.end(),
                         [&](const ObservationSet *set) { return names.insert(name_at(*set, level)).second; });
    }
  } // namespace

  void name_apart(std::vector<ObservationSet> &sets)
  {
    constexpr std::size_t                                deepest = 64;
    std::map<std::string, std::vector<ObservationSet *>> of_name;
    for (ObservationSet &set : sets)
      of_name[set.name].push_back(&set);
    for (const auto &[name, alike] : of_name)
    {
      std::size_t level = 1;
      while (level < deepest && !tells_apart(alike, level))
        ++level;
      for (ObservationSet *set : alike)
        if (alike.size() > 1)
          set->name = name_at(*set, level);
    }
  }

  void refuse_repeated_files(const std::vector<ObservationSet> &sets, DataProblems &problems)
  {
    std::set<std::filesystem::path> seen;
    std::error_code                 error;
    for (const ObservationSet &set : sets)
      if (!seen.insert(std::filesystem::weakly_canonical(set.file, error)).second)
        problems.error(fmt::format(
            "{}: this file is named twice, and its measurements would count twice; name it once.", set.file.string()));
  }
} // namespace swimtwin
