#include <datasets/files/file_patterns.h>
#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    const FilePatterns example_patterns =
        joined({{"summary.json", "fields/tail-[0-9]*.vtu"}, below("runs/run-*", {"a.csv"})});

    void put(const fs::path &file)
    {
      fs::create_directories(file.parent_path());
      std::ofstream(file) << "x";
    }

    std::vector<std::string> names(const std::vector<fs::path> &files, const fs::path &folder)
    {
      std::vector<std::string> result;
      for (const fs::path &file : files)
        result.push_back(file.lexically_relative(folder).string());
      return result;
    }
  } // namespace

  TEST(FilePatterns, FindWhatTheyNameAndNothingElse)
  {
    const TemporaryFolder folder;
    for (const char *name : {"runs/run-02/a.csv", "runs/run-01/a.csv", "runs/mine/a.csv", "fields/tail-0001.vtu",
                             "fields/tail-view.vtu", "summary.json", "notes.txt", ".summary.json"})
      put(folder.path / name);
    EXPECT_EQ(
        names(matching_files(folder.path, example_patterns), folder.path),
        (std::vector<std::string>{"summary.json", "fields/tail-0001.vtu", "runs/run-01/a.csv", "runs/run-02/a.csv"}));
    EXPECT_TRUE(matching_files(folder.path / "none", example_patterns).empty());
  }

  TEST(FilePatterns, FindWhatKilledRunsLeftHalfWritten)
  {
    const TemporaryFolder folder;
    for (const char *name : {".summary.json.12-ab.partial", ".summary.json.partial", "runs/run-01/.a.csv.7-cd.partial",
                             "fields/.tail-0001.vtu.7-cd.partial", ".mine.partial", "summary.json.partial",
                             ".summary.json.staged.7-cd.partial/a.csv"})
      put(folder.path / name);
    EXPECT_EQ(names(partial_files(folder.path, example_patterns), folder.path),
              (std::vector<std::string>{".summary.json.partial", ".summary.json.12-ab.partial",
                                        ".summary.json.staged.7-cd.partial", "fields/.tail-0001.vtu.7-cd.partial",
                                        "runs/run-01/.a.csv.7-cd.partial"}));
  }

  TEST(FilePatterns, RefuseAFolderInTheirPlace)
  {
    const TemporaryFolder folder;
    EXPECT_NO_THROW(require_places(folder.path, example_patterns));
    put(folder.path / "fields");
    expect_in(message_of<InputError>([&] { require_places(folder.path, example_patterns); }), "fields is a file");
    fs::remove(folder.path / "fields");
    fs::create_directory(folder.path / "summary.json");
    expect_in(message_of<InputError>([&] { require_places(folder.path, example_patterns); }),
              "summary.json is a folder");
  }
} // namespace swimtwin
