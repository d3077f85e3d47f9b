#include <datasets/files/earlier_results.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    fs::path place_aside(const fs::path &folder, const std::string &verb)
    {
      return folder / fmt::format(".swimtwin-before-{}", verb);
    }

    /// The same while the files are on their way: what is there belongs back in any case.
    fs::path place_on_the_way(const fs::path &aside)
    {
      return aside.string() + ".moving";
    }

    void move_file(const fs::path &file, const fs::path &from, const fs::path &to)
    {
      const fs::path target = to / file.lexically_relative(from);
      fs::create_directories(target.parent_path());
      fs::rename(file, target);
    }

    /// Folders that have become empty, up to `folder` and without it.
    void remove_empty_folders(fs::path inner, const fs::path &folder)
    {
      std::error_code error;
      for (; inner != folder && fs::is_directory(inner, error) && fs::remove(inner, error) && !error;
           inner = inner.parent_path())
        ;
    }

    /// Nothing that is there is overwritten.
    void put_back(const fs::path &aside, const fs::path &folder)
    {
      std::error_code       error;
      std::vector<fs::path> files;
      for (const auto &entry : fs::recursive_directory_iterator(aside, error))
        if (!entry.is_directory(error) || entry.is_symlink(error))
          files.push_back(entry.path());
      for (const fs::path &file : files)
        if (!fs::exists(fs::symlink_status(folder / file.lexically_relative(aside), error)))
          move_file(file, aside, folder);
      fs::remove_all(aside);
    }

    bool put_back_or_remove(const fs::path &aside, const fs::path &folder, const WrittenFiles &files)
    {
      const bool belongs_back = files_of_verb(folder, files).empty();
      if (belongs_back)
        put_back(aside, folder);
      else
        fs::remove_all(aside);
      return belongs_back;
    }
  } // namespace

  std::vector<fs::path> files_of_verb(const fs::path &folder, const WrittenFiles &files)
  {
    std::vector<fs::path> own = matching_files(folder, files.patterns);
    const auto is_own = [&](const fs::path &file) { return std::find(own.begin(), own.end(), file) != own.end(); };
    const std::vector<fs::path> sharers = matching_files(folder, files.sharers);
    if (!std::all_of(sharers.begin(), sharers.end(), is_own))
      std::erase(own, folder / files.shared);
    return own;
  }

  EarlierResults::EarlierResults(fs::path folder, WrittenFiles files)
      : folder_(std::move(folder)), files_(std::move(files))
  {
    const std::vector<fs::path> earlier = files_of_verb(folder_, files_);
    if (earlier.empty())
      return;
    const fs::path aside = place_aside(folder_, files_.verb), moving = place_on_the_way(aside);
    try
    {
      for (const fs::path &file : earlier)
        move_file(file, folder_, moving);
      for (const fs::path &file : earlier)
        remove_empty_folders(file.parent_path(), folder_);
      fs::rename(moving, aside);
    }
    catch (const fs::filesystem_error &error)
    {
      put_back(moving, folder_);
      throw ComputationError(fmt::format("cannot set the earlier results in {} aside: {}: {}", folder_.string(),
                                         error.path1().string(), error.code().message()));
    }
    aside_ = aside;
  }

  void EarlierResults::drop()
  {
    std::error_code ignored; // hidden, and settled by the next run in the folder
    if (are_aside())
      fs::remove_all(std::exchange(aside_, {}), ignored);
  }

  bool EarlierResults::restore_or_drop()
  {
    return are_aside() && put_back_or_remove(std::exchange(aside_, {}), folder_, files_);
  }

  void settle_earlier_results(const fs::path &folder, const std::vector<WrittenFiles> &all)
  {
    std::error_code ignored;
    for (const WrittenFiles &files : all)
    {
      const fs::path aside = place_aside(folder, files.verb), moving = place_on_the_way(aside);
      if (fs::exists(moving, ignored))
        put_back(moving, folder);
      if (fs::exists(aside, ignored))
        put_back_or_remove(aside, folder, files);
    }
  }
} // namespace swimtwin
