#include <datasets/files/input_file.h>
#include <datasets/system/error.h>
#include <datasets/system/nearest_name.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    std::string words_of(const int error_number)
    {
      return std::generic_category().message(error_number);
    }

    std::vector<std::string> names_in(const fs::path &folder)
    {
      constexpr std::size_t    n_most = 10000; // enough for a hint
      std::error_code          ignored;
      std::vector<std::string> names;
      for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end && names.size() < n_most;
           entry.increment(ignored))
        names.push_back(entry->path().filename().string());
      std::sort(names.begin(), names.end());
      return names;
    }

    fs::path folder_of(const fs::path &file)
    {
      return file.has_parent_path() ? file.parent_path() : fs::path(".");
    }

    /// What is there instead of a name that is not.
    std::string missing(const fs::path &path)
    {
      std::error_code   ignored;
      const std::string plain = words_of(ENOENT);
      if (fs::is_symlink(fs::symlink_status(path, ignored)))
        return fmt::format("it is a link to {}, which is not there", fs::read_symlink(path, ignored).string());
      const fs::path folder = folder_of(path);
      if (!fs::exists(folder, ignored))
        return fmt::format("{}, and no folder {}", plain, folder.string());
      const auto near = close_name(path.filename().string(), names_in(folder));
      return near ? fmt::format("{}; the nearest name there is {}", plain, *near) : plain;
    }

    std::string forbidden(const fs::path &path)
    {
      std::error_code ignored;
      const auto      status = fs::status(path, ignored);
      if (status.type() == fs::file_type::none)
        return fmt::format("{}: one of the folders on its way may not be entered", words_of(EACCES));
      return fmt::format("{}; ask its owner for the right to read it, or give it yourself with `chmod u+r`",
                         words_of(EACCES));
    }

    std::string a_folder(const fs::path &path)
    {
      std::error_code ignored;
      const fs::path  model = path / "model.h5";
      return fmt::format("{}; name a file in it{}", words_of(EISDIR),
                         fs::exists(model, ignored) ? fmt::format(", such as {}", model.string()) : "");
    }

    std::string cause_of(const int error_number, const fs::path &path)
    {
      switch (error_number)
      {
      case ENOENT:
        return missing(path);
      case EACCES:
      case EPERM:
        return forbidden(path);
      case EISDIR:
        return a_folder(path);
      case ENOTDIR:
        return fmt::format("{}: what should be a folder on its way is a file", words_of(ENOTDIR));
      case EAGAIN:
      case EBUSY:
      case ETXTBSY:
      case EDEADLK:
        return locked_by_another_program;
      default:
        return words_of(error_number);
      }
    }

    /// A file open to read; every failure is told by refuse_file.
    class InputFile
    {
    public:
      InputFile(const fs::path &file, const std::string &what)
          : file_(file), what_(what), descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY))
      {
        if (descriptor_ < 0)
          refuse_file(file_, what_, cause_of(errno, file_));
        if (::fstat(descriptor_, &status_) == 0 && S_ISDIR(status_.st_mode))
        {
          ::close(descriptor_);
          refuse_file(file_, what_, cause_of(EISDIR, file_));
        }
      }
      InputFile(const InputFile &)            = delete;
      InputFile &operator=(const InputFile &) = delete;
      ~InputFile() { ::close(descriptor_); }

      bool is_regular() const { return S_ISREG(status_.st_mode); }

      std::string read(const std::size_t n_bytes_at_most) const
      {
        std::string             text;
        std::array<char, 65536> buffer;
        while (text.size() < n_bytes_at_most)
        {
          const ssize_t n = ::read(descriptor_, buffer.data(), std::min(buffer.size(), n_bytes_at_most - text.size()));
          if (n < 0 && errno == EINTR)
            continue;
          if (n < 0)
            refuse_file(file_, what_, cause_of(errno, file_));
          if (n == 0)
            break;
          text.append(buffer.data(), static_cast<std::size_t>(n));
        }
        return text;
      }

    private:
      const fs::path    &file_;
      const std::string &what_;
      int                descriptor_;
      struct ::stat      status_ = {};
    };

    void require_data(const fs::path &file, const std::string &what, const std::string_view content)
    {
      if (content.empty())
        refuse_file(file, what, "the file is empty (0 bytes); copy or make it again");
      if (content.find_first_not_of('\0') == std::string_view::npos)
        refuse_file(file, what,
                    "it holds nothing but zero bytes, as after a crash while it was written; copy or make it again");
    }

    void require_own_content(const fs::path &file, const std::string &what, const std::string_view content)
    {
      if (const auto foreign = foreign_content(content))
        refuse_file(file, what, *foreign);
    }

    /// The beginning in lower case, without byte order mark and blanks.
    std::string first_words(std::string_view content)
    {
      if (content.starts_with("\xEF\xBB\xBF"))
        content.remove_prefix(3);
      content.remove_prefix(std::min(content.find_first_not_of(" \t\r\n"), content.size()));
      std::string words(content.substr(0, 1024));
      for (char &letter : words)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
      return words;
    }
  } // namespace

  void refuse_file(const fs::path &file, const std::string &what, const std::string &cause)
  {
    throw InputError(fmt::format("cannot read {}{}{}: {}.", what, what.empty() ? "" : " ", file.string(), cause));
  }

  std::optional<std::string> foreign_content(const std::string_view content)
  {
    using namespace std::string_view_literals;
    if (content.starts_with("PK\x03\x04"))
      return "it is a ZIP archive, as workbooks (.xlsx, .ods) are; unpack it, or save the sheet as CSV";
    if (content.starts_with("\xD0\xCF\x11\xE0"))
      return "it is a workbook of Excel (.xls); save the sheet as CSV";
    if (content.starts_with("\x1F\x8B") || content.starts_with("BZh") || content.starts_with("\xFD\x37zXZ") ||
        content.starts_with("\x28\xB5\x2F\xFD") || content.starts_with("7z\xBC\xAF\x27\x1C"))
      return "it is compressed; unpack it first";
    const std::string words = first_words(content);
    if (words.starts_with("version https://git-lfs.github.com/spec/"))
      return "it is a pointer of Git LFS, not the data; fetch them with `git lfs pull`";
    if (words.find("/annex/objects/") < words.find('\n') && words.size() < 1024)
      return "it is a pointer of git-annex, not the data; fetch them with `git annex get`";
    if (words.starts_with("outs:") && words.find("md5:") != std::string::npos)
      return "it is a pointer of DVC, not the data; fetch them with `dvc pull`, and name the file without .dvc";
    if (words.starts_with("<table") ||
        (words.starts_with("<html") && words.find("schemas-microsoft-com:office") != std::string::npos))
      return "it is a table as a web page (HTML), as some programs write .xls; open it in a spreadsheet and save the "
             "sheet as CSV";
    for (const auto start : {"<!doctype html"sv, "<html"sv, "<head"sv, "<body"sv, "<script"sv, "<div"sv, "<meta"sv,
                             "<style"sv, "<title>"sv})
      if (words.starts_with(start))
        return "it is a web page (HTML), not the data; download the file itself, not the page that shows it";
    if (words.starts_with("<?xml") || words.starts_with("<!doctype") || words.starts_with("<!--"))
      return words.find("<html") != std::string::npos
                 ? "it is a web page (XHTML), not the data; download the file itself, not the page that shows it"
             : words.find("<trackmate") != std::string::npos
                 ? "it is TrackMate's XML; export the table of spots as CSV"
                 : "it is an XML document, not the data; if it tells of an error, download the file again";
    return std::nullopt;
  }

  std::string read_content(const fs::path &file, const std::string &what)
  {
    std::string content = InputFile(file, what).read(std::string::npos);
    require_data(file, what, content);
    return content;
  }

  std::string read_text_file(const fs::path &file, const std::string &what)
  {
    std::string text = read_content(file, what);
    if (text.starts_with(hdf5_signature))
      refuse_file(file, what, "it is an HDF5 file, and a text is needed here");
    require_own_content(file, what, text);
    return text;
  }

  std::string read_first_bytes(const fs::path &file, const std::string &what, const std::size_t n_bytes)
  {
    const InputFile input(file, what);
    if (!input.is_regular())
      refuse_file(file, what, "it is a device or a pipe; name a file");
    const std::string bytes = input.read(n_bytes);
    require_data(file, what, bytes);
    require_own_content(file, what, bytes);
    return bytes;
  }

  bool is_there(const fs::path &path)
  {
    std::error_code in_the_way;
    return fs::exists(path, in_the_way);
  }

  bool is_folder(const fs::path &path)
  {
    std::error_code in_the_way;
    return fs::is_directory(path, in_the_way);
  }

  bool is_locked(const fs::path &file)
  {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
      return false;
    const bool locked_by_another = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    ::close(descriptor);
    return locked_by_another;
  }

  void require_folder(const fs::path &folder, const std::string &remedy)
  {
    std::error_code error;
    const auto      type = fs::status(folder, error).type();
    if (type == fs::file_type::not_found)
      throw InputError(fmt::format("there is no folder {}: {}; {}.", folder.string(), missing(folder), remedy));
    if (type != fs::file_type::directory && type != fs::file_type::none)
      throw InputError(fmt::format("{} is a file, not a folder; {}.", folder.string(), remedy));
    if (type == fs::file_type::none || ::eaccess(folder.c_str(), R_OK | X_OK) != 0)
      throw InputError(fmt::format("cannot read the folder {}: {}; {}.", folder.string(),
                                   type == fs::file_type::none ? error.message() : words_of(errno), remedy));
  }
} // namespace swimtwin
