#include <datasets/files/output_folder.h>
#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>

#include <fmt/format.h>

#include <stdexcept>
#include <unistd.h>

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
    fs::create_symlink("/dev/full", temporary_name(file));
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

  TEST(WriteAtomically, UsesATemporaryNameThatTellsTheProcess)
  {
    const fs::path name = temporary_name("folder/result.txt");
    EXPECT_EQ(name.parent_path(), "folder");
    EXPECT_TRUE(name.filename().string().starts_with(fmt::format(".result.txt.{}-", getpid()))) << name;
    EXPECT_EQ(name.extension(), ".partial");
  }
} // namespace swimtwin
