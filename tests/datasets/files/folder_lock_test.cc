#include <datasets/files/folder_lock.h>
#include <datasets/system/error.h>
#include <tests/datasets/other_process.h>
#include <tests/datasets/temporary_folder.h>

#include <chrono>
#include <fcntl.h>
#include <memory>
#include <sys/file.h>
#include <thread>
#include <unistd.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    std::string refusal_to_lock(const fs::path &folder)
    {
      return message_of<InputError>([&] { FolderLock(folder, "swimtwin sweep"); });
    }

    void lock_for_ever(const fs::path &folder)
    {
      new FolderLock(folder, "swimtwin simulate open-2d"); // not a leak: the process ends by a kill
    }
  } // namespace

  TEST(FolderLock, LeavesNothingBehind)
  {
    const TemporaryFolder folder;
    {
      const FolderLock lock(folder.path, "swimtwin sweep");
      EXPECT_EQ(lock.doubt(), "");
      EXPECT_EQ(n_files(folder.path), 1u);
    }
    EXPECT_EQ(n_files(folder.path), 0u);
  }

  TEST(FolderLock, NamesTheProcessThatHasTheFolder)
  {
    const TemporaryFolder folder;
    OtherProcess          other([&] { lock_for_ever(folder.path); });
    const std::string     message = refusal_to_lock(folder.path);
    expect_in(message, folder.path.string() + " is in use by process " + std::to_string(other.id()) + " on ");
    expect_in(message, " since 20");
    expect_in(message, ": swimtwin simulate open-2d; wait for the end of that run, or choose another --output.");
    EXPECT_EQ(message.find("--force"), std::string::npos);
    ASSERT_TRUE(run_in(folder.path));
    expect_in(*run_in(folder.path), "swimtwin simulate open-2d");
    EXPECT_EQ(n_files(folder.path), 1u) << "who is refused must leave the other's lock";
  }

  TEST(FolderLock, EndsWithItsProcess)
  {
    const TemporaryFolder folder;
    OtherProcess          other([&] { lock_for_ever(folder.path); });
    other.kill();
    EXPECT_EQ(n_files(folder.path), 1u) << "the file stays, the lock does not";
    EXPECT_FALSE(run_in(folder.path));
    EXPECT_NO_THROW(FolderLock(folder.path, "swimtwin sweep"));
    EXPECT_EQ(n_files(folder.path), 0u);
  }

  TEST(FolderLock, MayBeTakenAgainByItsProcess)
  {
    const TemporaryFolder folder;
    auto                  outer = std::make_unique<FolderLock>(folder.path, "swimtwin demo");
    {
      const FolderLock inner(folder.path / ".", "swimtwin demo");
      EXPECT_TRUE(outer->is_outermost());
      EXPECT_FALSE(inner.is_outermost());
      EXPECT_FALSE(run_in(folder.path));
    }
    EXPECT_EQ(n_files(folder.path), 1u) << "the outer one still holds it";
    outer.reset();
    EXPECT_EQ(n_files(folder.path), 0u);
  }

  TEST(FolderLock, IsInNobodysWayWhereThereCanBeNone)
  {
    const TemporaryFolder folder;
    fs::create_directory(folder.path / ".swimtwin.lock"); // as good as a file system without locks
    const FolderLock lock(folder.path, "swimtwin sweep");
    expect_in(lock.doubt(), "the folder cannot be locked (Is a directory): start no second run in it");
  }

  TEST(FolderLock, OutlivesAGlanceAtTheFolder)
  {
    const TemporaryFolder folder;
    const fs::path        file       = folder.write(".swimtwin.lock", "");
    const int             descriptor = ::open(file.c_str(), O_RDONLY);
    ::flock(descriptor, LOCK_SH);
    std::thread glance([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      ::close(descriptor);
    });
    EXPECT_NO_THROW(FolderLock(folder.path, "swimtwin sweep"));
    glance.join();
  }
} // namespace swimtwin
