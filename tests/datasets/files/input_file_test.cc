#include <datasets/files/input_file.h>
#include <datasets/system/error.h>
#include <tests/datasets/other_process.h>
#include <tests/datasets/temporary_folder.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    /// Root may read everything: as another user, until the end of the scope.
    class AsNobody
    {
    public:
      AsNobody() : is_root_(::geteuid() == 0) { EXPECT_EQ(is_root_ ? ::seteuid(65534) : 0, 0); }
      ~AsNobody() { EXPECT_EQ(is_root_ ? ::seteuid(0) : 0, 0); }

    private:
      bool is_root_;
    };

    std::string refusal_to_read(const fs::path &file)
    {
      return message_of<InputError>([&] { read_text_file(file, "the scene"); });
    }
  } // namespace

  TEST(InputFile, IsReadAsItIs)
  {
    const TemporaryFolder folder;
    EXPECT_EQ(read_text_file(folder.write("a.toml", "a = 1\n\r\xFF"), "the scene"), "a = 1\n\r\xFF");
  }

  TEST(InputFile, ThatIsMissingIsRefusedWithTheNearestName)
  {
    const TemporaryFolder folder;
    folder.write("scene.toml", "a = 1");
    EXPECT_EQ(refusal_to_read(folder.path / "scnee.toml"), "cannot read the scene " +
                                                               (folder.path / "scnee.toml").string() +
                                                               ": No such file or directory; the nearest name there is "
                                                               "scene.toml.");
    EXPECT_EQ(refusal_to_read(folder.path / "unlike").find("nearest"), std::string::npos);
    expect_in(refusal_to_read(folder.path / "none" / "scene.toml"), "and no folder " + (folder.path / "none").string());
    expect_in(refusal_to_read(folder.path / "scene.toml" / "below"), "is a file");
    fs::create_symlink("gone.toml", folder.path / "link.toml");
    expect_in(refusal_to_read(folder.path / "link.toml"), "it is a link to gone.toml, which is not there");
    expect_in(refusal_to_read(folder.path / std::string(300, 'x')), "File name too long");
  }

  TEST(InputFile, ThatIsAFolderIsRefusedWithTheModelInIt)
  {
    const TemporaryFolder folder;
    expect_in(refusal_to_read(folder.path), "Is a directory; name a file in it.");
    folder.write("model.h5", "x");
    expect_in(refusal_to_read(folder.path), "such as " + (folder.path / "model.h5").string());
  }

  TEST(InputFile, ThatMayNotBeReadIsRefused)
  {
    const TemporaryFolder folder;
    const fs::path        file = folder.write("scene.toml", "a = 1"), inner = folder.path / "inner";
    fs::create_directory(inner);
    std::ofstream(inner / "scene.toml") << "a = 1";
    fs::permissions(folder.path, fs::perms::all);
    fs::permissions(file, fs::perms::none);
    fs::permissions(inner, fs::perms::none);
    const AsNobody nobody;
    expect_in(refusal_to_read(file), "Permission denied; ask its owner");
    expect_in(refusal_to_read(inner / "scene.toml"), "one of the folders on its way may not be entered");
    expect_in(message_of<InputError>([&] { require_folder(inner, "name another"); }),
              "Permission denied; name another");
  }

  TEST(InputFile, ThatHoldsNothingIsRefused)
  {
    const TemporaryFolder folder;
    expect_in(refusal_to_read(folder.write("empty.toml", "")), "the file is empty (0 bytes)");
    expect_in(refusal_to_read(folder.write("zeros.toml", std::string(5000, '\0'))), "nothing but zero bytes");
  }

  TEST(InputFile, ThatIsSomethingElseIsCalledByItsName)
  {
    const TemporaryFolder                                  folder;
    const std::vector<std::pair<std::string, std::string>> contents = {
        {"version https://git-lfs.github.com/spec/v1\noid sha256:12\nsize 34\n", "`git lfs pull`"},
        {"/annex/objects/SHA256E-s104--1.csv\n", "`git annex get`"},
        {"\n <!DOCTYPE html>\n<html><body>404</body></html>", "a web page (HTML)"},
        {"\xEF\xBB\xBF<html lang=\"de\">", "a web page (HTML)"},
        {"<?xml version=\"1.0\"?>\n<!DOCTYPE html><html>", "a web page (XHTML)"},
        {"<?xml version=\"1.0\"?>\n<Error><Code>AccessDenied</Code></Error>", "an XML document"},
        {"<?xml version=\"1.0\"?>\n<TrackMate version=\"7\">", "export the table of spots as CSV"},
        {"PK\x03\x04rest", "a ZIP archive"},
        {"\x1F\x8B\x08rest", "compressed"},
        {std::string(hdf5_signature) + "rest", "an HDF5 file"}};
    for (const auto &[content, part] : contents)
      expect_in(refusal_to_read(folder.write("data.csv", content)), part);
  }

  TEST(InputFile, MayBeAPipeForATextAndNotForALibrary)
  {
    const TemporaryFolder folder;
    const fs::path        pipe = folder.path / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    for (const bool as_text : {true, false})
    {
      const OtherProcess writer([&] {
        if (::fork() == 0)
        {
          std::ofstream(pipe) << "a = 1\n";
          ::_exit(0);
        }
      });
      const auto         read_bytes = [&] { read_first_bytes(pipe, "", 8); };
      const std::string  result     = as_text ? read_text_file(pipe, "the scene") : message_of<InputError>(read_bytes);
      expect_in(result, as_text ? "a = 1\n" : "a device or a pipe");
    }
  }

  TEST(InputFile, IsKnownToBeLockedByAnother)
  {
    const TemporaryFolder folder;
    const fs::path        file = folder.write("data.h5", "x");
    EXPECT_FALSE(is_locked(file));
    OtherProcess other([&] { ::flock(::open(file.c_str(), O_RDWR), LOCK_EX); });
    EXPECT_TRUE(is_locked(file));
    other.kill();
    EXPECT_FALSE(is_locked(file));
  }

  TEST(InputFolder, IsRefusedByWhatItIs)
  {
    const TemporaryFolder folder;
    fs::create_directory(folder.path / "results");
    const fs::path file    = folder.write("file", "x");
    const auto     message = [&](const fs::path &path) {
      return message_of<InputError>([&] { require_folder(path, "give another"); });
    };
    EXPECT_NO_THROW(require_folder(folder.path, "give another"));
    expect_in(message(file), "is a file, not a folder; give another.");
    expect_in(message(folder.path / "result"), "the nearest name there is results; give another.");
  }
} // namespace swimtwin
