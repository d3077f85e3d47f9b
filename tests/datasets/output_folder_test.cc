#include <datasets/error.h>
#include <datasets/output_folder.h>
#include <tests/datasets/temporary_folder.h>

#include <stdexcept>

namespace swimtwin
{
  namespace fs = std::filesystem;

  TEST(WriteAtomically, LeavesOnlyTheFinishedFile)
  {
    const TemporaryFolder folder;
    write_text_atomically(folder.path / "result.txt", "done\n");
    EXPECT_EQ(content(folder.path / "result.txt"), "done\n");
    EXPECT_EQ(n_files(folder.path), 1u);
  }

  TEST(WriteAtomically, ReplacesAnEarlierResult)
  {
    const TemporaryFolder folder;
    write_text_atomically(folder.path / "result.txt", "a long first result");
    write_text_atomically(folder.path / "result.txt", "second");
    EXPECT_EQ(content(folder.path / "result.txt"), "second");
  }

  TEST(WriteAtomically, KeepsTheEarlierResultWhenTheWriterFails)
  {
    const TemporaryFolder folder;
    const fs::path        file = folder.write("result.txt", "earlier");
    const auto            fail = [](const fs::path &partial) {
      std::ofstream(partial) << "half";
      throw std::runtime_error("the solver stopped");
    };
    const std::string message = message_of<ComputationError>([&] { write_atomically(file, fail); });
    expect_in(message, file.string());
    expect_in(message, "the solver stopped");
    EXPECT_EQ(content(file), "earlier");
    EXPECT_EQ(n_files(folder.path), 1u);
  }

  TEST(WriteAtomically, ReportsAFullDiskAndKeepsTheEarlierResult)
  {
    const TemporaryFolder folder;
    const fs::path        file = folder.write("result.txt", "earlier");
    fs::create_symlink("/dev/full", folder.path / ".result.txt.partial");
    const std::string message = message_of<ComputationError>([&] { write_text_atomically(file, "later"); });
    EXPECT_EQ(message, "cannot write " + file.string() + ": No space left on device; free some space and run again");
    EXPECT_EQ(content(file), "earlier");
    EXPECT_EQ(n_files(folder.path), 1u);
  }

  TEST(WriteAtomically, NamesAFolderThatDoesNotExist)
  {
    const TemporaryFolder folder;
    const std::string     message =
        message_of<ComputationError>([&] { write_text_atomically(folder.path / "missing" / "result.txt", "text"); });
    expect_in(message, "missing/result.txt: No such file or directory");
  }

  TEST(PrepareOutputFolder, CreatesNestedFolders)
  {
    const TemporaryFolder folder;
    prepare_output_folder(folder.path / "a" / "b", {"summary.json"}, false);
    EXPECT_TRUE(fs::is_directory(folder.path / "a" / "b"));
  }

  TEST(PrepareOutputFolder, RefusesAnExistingResultWithoutForce)
  {
    const TemporaryFolder folder;
    folder.write("summary.json", "{}");
    const std::string message = message_of<InputError>([&] {
      prepare_output_folder(folder.path, {"trajectory.csv", "summary.json"}, false);
    });
    expect_in(message, "already holds summary.json");
    expect_in(message, "--force");
    EXPECT_NO_THROW(prepare_output_folder(folder.path, {"summary.json"}, true));
    EXPECT_NO_THROW(prepare_output_folder(folder.path, {"trajectory.csv"}, false));
  }

  TEST(PrepareOutputFolder, RefusesAFileInItsPlace)
  {
    const TemporaryFolder folder;
    const fs::path        file = folder.write("result", "text");
    expect_in(message_of<InputError>([&] { prepare_output_folder(file, {}, true); }), file.string());
    expect_in(message_of<InputError>([&] { prepare_output_folder(file / "inside", {}, true); }), "--output");
  }
} // namespace swimtwin
