#include <datasets/files/file_patterns.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <fnmatch.h>
#include <iterator>
#include <set>
#include <system_error>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    bool has_wildcard(const std::string &name)
    {
      return name.find_first_of("*?[") != std::string::npos;
    }

    std::vector<fs::path> entries_like(const fs::path &folder, const std::string &name)
    {
      std::error_code       error;
      std::vector<fs::path> found;
      if (!has_wildcard(name))
        return fs::exists(fs::symlink_status(folder / name, error)) ? std::vector{folder / name} : found;
      for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (::fnmatch(name.c_str(), entry->path().filename().c_str(), FNM_PERIOD) == 0)
          found.push_back(entry->path());
      return found;
    }

    std::vector<fs::path> entries_like(const fs::path &folder, const FilePatterns &patterns)
    {
      std::vector<fs::path> found;
      std::set<fs::path>    seen;
      for (const fs::path pattern : patterns)
      {
        std::vector<fs::path> folders{folder}, next;
        for (const fs::path &part : pattern)
        {
          next.clear();
          for (const fs::path &place : folders)
            for (fs::path &entry : entries_like(place, part.string()))
              next.push_back(std::move(entry));
          folders.swap(next);
        }
        std::sort(folders.begin(), folders.end());
        std::copy_if(folders.begin(), folders.end(), std::back_inserter(found),
                     [&](const fs::path &entry) { return seen.insert(entry).second; });
      }
      return found;
    }
  } // namespace

  FilePatterns below(const std::string &folder_pattern, const FilePatterns &patterns)
  {
    FilePatterns result;
    for (const std::string &pattern : patterns)
      result.push_back(folder_pattern + "/" + pattern);
    return result;
  }

  FilePatterns joined(const std::vector<FilePatterns> &lists)
  {
    FilePatterns result;
    for (const FilePatterns &list : lists)
      result.insert(result.end(), list.begin(), list.end());
    return result;
  }

  std::vector<fs::path> matching_files(const fs::path &folder, const FilePatterns &patterns)
  {
    std::vector<fs::path> files = entries_like(folder, patterns);
    std::erase_if(files, [](const fs::path &file) {
      std::error_code ignored;
      return fs::is_directory(fs::symlink_status(file, ignored));
    });
    return files;
  }

  std::vector<fs::path> partial_files(const fs::path &folder, const FilePatterns &patterns)
  {
    FilePatterns partial;
    for (const fs::path pattern : patterns)
      for (const char *ending : {"partial", "*.partial"}) // the first: of earlier versions
        partial.push_back(
            (pattern.parent_path() / fmt::format(".{}.{}", pattern.filename().string(), ending)).string());
    return entries_like(folder, partial);
  }

  void require_places(const fs::path &folder, const FilePatterns &patterns)
  {
    const auto refuse = [](const fs::path &place, const char *is, const char *becomes) {
      throw InputError(fmt::format("{} is {}, and this run writes {} of that name; move it away, or choose another "
                                   "--output.",
                                   place.string(), is, becomes));
    };
    for (const fs::path pattern : patterns)
    {
      fs::path place = folder;
      for (auto part = pattern.begin(); part != pattern.end() && !has_wildcard(part->string()); ++part)
      {
        place /= *part;
        std::error_code ignored;
        const bool      is_file  = std::next(part) == pattern.end();
        const auto      type     = fs::status(place, ignored).type();
        const bool      is_there = type != fs::file_type::not_found && type != fs::file_type::none;
        if (is_there && is_file && type == fs::file_type::directory)
          refuse(place, "a folder", "a file");
        if (is_there && !is_file && type != fs::file_type::directory)
          refuse(place, "a file", "a folder");
      }
    }
  }
} // namespace swimtwin
