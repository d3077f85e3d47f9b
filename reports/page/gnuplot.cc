#include <reports/page/gnuplot.h>

#include <datasets/output_folder.h>
#include <reports/page/gnuplot_style.h>

#include <fmt/format.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <fcntl.h>
#include <spawn.h>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    struct ProcessResult
    {
      bool        succeeded = false;
      std::string messages; ///< what it wrote to standard error
    };

    /// What the child sees: a working folder, no input, no output, and a pipe for its messages.
    class ChildSurroundings
    {
    public:
      explicit ChildSurroundings(const fs::path &folder)
      {
        if (::pipe2(pipe_.data(), O_CLOEXEC) != 0)
          throw std::system_error(errno, std::generic_category());
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&actions_, pipe_[1], STDERR_FILENO);
      }
      ChildSurroundings(const ChildSurroundings &)            = delete;
      ChildSurroundings &operator=(const ChildSurroundings &) = delete;
      ~ChildSurroundings()
      {
        posix_spawn_file_actions_destroy(&actions_);
        ::close(pipe_[0]);
        close_write_end();
      }

      const posix_spawn_file_actions_t *actions() const { return &actions_; }

      /// Until the child has closed its end.
      std::string read_messages()
      {
        close_write_end();
        std::string            text;
        std::array<char, 4096> buffer;
        for (;;)
        {
          const ssize_t n = ::read(pipe_[0], buffer.data(), buffer.size());
          if (n > 0)
            text.append(buffer.data(), static_cast<std::size_t>(n));
          else if (n == 0 || errno != EINTR)
            return text;
        }
      }

    private:
      void close_write_end()
      {
        if (pipe_[1] >= 0)
          ::close(pipe_[1]);
        pipe_[1] = -1;
      }

      std::array<int, 2>         pipe_{-1, -1};
      posix_spawn_file_actions_t actions_;
    };

    /// gnuplot without the user's initialisation files. Not through a shell: nothing needs quoting.
    ProcessResult run_gnuplot(const fs::path &folder, std::vector<std::string> arguments)
    {
      arguments.insert(arguments.begin(), {"gnuplot", "--default-settings"});
      std::vector<char *> argv;
      for (std::string &argument : arguments)
        argv.push_back(argument.data());
      argv.push_back(nullptr);

      ChildSurroundings surroundings(folder);
      pid_t             child = 0;
      if (const int error = ::posix_spawnp(&child, "gnuplot", surroundings.actions(), nullptr, argv.data(), environ))
        return {false, std::generic_category().message(error)};
      ProcessResult result;
      result.messages = surroundings.read_messages();
      int   status    = -1;
      pid_t ended     = -1;
      do
        ended = ::waitpid(child, &status, 0);
      while (ended < 0 && errno == EINTR);
      result.succeeded = ended == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
      return result;
    }

    /// On one line, without the empty lines and the pointer under the offending character.
    std::string one_line(const std::string_view messages)
    {
      std::string line;
      for (const char c : messages)
      {
        const bool space = c == '\n' || c == '\t' || c == ' ';
        if (!space)
          line += c;
        else if (!line.empty() && line.back() != ' ')
          line += ' ';
      }
      while (!line.empty() && line.back() == ' ')
        line.pop_back();
      return line;
    }

    /// In single quotes, with the characters that enhanced text gives a meaning to escaped.
    std::string quoted(const std::string_view text)
    {
      std::string result = "'";
      for (const char c : text)
      {
        if (std::string_view("_^{}@&~\\").find(c) != std::string_view::npos)
          result += '\\';
        result += c;
        if (c == '\'')
          result += '\'';
      }
      return result + "'";
    }

    /// A line break in a scene's name must not end the comment.
    std::string comment(const std::string_view origin)
    {
      return fmt::format("# {}\n", one_line(origin));
    }

    std::string script_text(const GnuplotPicture &picture, const std::string_view origin)
    {
      std::string text =
          fmt::format("{0}# Draw again: gnuplot {1}.gp   As SVG: gnuplot -e \"picture='{1}.svg'\" {1}.gp\n\n"
                      "if (!exists(\"picture\")) picture = '{1}.png'\ndata = '{1}.dat'\n",
                      comment(origin), picture.name);
      for (const auto &[name, value] : picture.variables)
        text += fmt::format("{} = {}\n", name, value);
      return text + "load 'style.gp'\n" + std::string(picture.script);
    }
  } // namespace

  void GnuplotTable::begin_block(const std::string_view columns)
  {
    text_ += fmt::format("{}# {}\n", text_.empty() ? "" : "\n\n", columns);
  }

  void GnuplotTable::add_row(const std::vector<double> &values)
  {
    std::string_view separator;
    for (const double value : values)
    {
      text_ += fmt::format("{}{:.9g}", separator, value);
      separator = " ";
    }
    text_ += '\n';
  }

  void GnuplotPicture::set(const std::string &variable, const double value)
  {
    // a number without point or exponent would divide as an integer
    variables.emplace_back(variable, std::isfinite(value) ? fmt::format("{:.12e}", value) : "NaN");
  }

  void GnuplotPicture::set_flag(const std::string &variable, const bool value)
  {
    variables.emplace_back(variable, value ? "1" : "0");
  }

  void GnuplotPicture::set_text(const std::string &variable, const std::string_view text)
  {
    variables.emplace_back(variable, quoted(text));
  }

  bool gnuplot_is_installed()
  {
    return run_gnuplot(".", {"--version"}).succeeded;
  }

  void write_gnuplot_files(const fs::path &folder, const GnuplotPicture &picture, const std::string_view origin)
  {
    write_text_atomically(folder / "style.gp", gnuplot_scripts::style);
    write_text_atomically(folder / (picture.name + ".dat"), comment(origin) + picture.table.text());
    write_text_atomically(folder / (picture.name + ".gp"), script_text(picture, origin));
  }

  fs::path draw_png(const fs::path &folder, const std::string &name)
  {
    const fs::path png = folder / (name + ".png");
    write_atomically(png, [&](const fs::path &partial) {
      const std::string   output = fmt::format("picture='{}'", partial.filename().string());
      const ProcessResult result = run_gnuplot(folder, {"-e", output, name + ".gp"});
      std::error_code     absent;
      const bool          drawn = fs::file_size(partial, absent) > 0 && !absent;
      if (!result.succeeded || !drawn)
        throw std::runtime_error(fmt::format("gnuplot failed: {}", one_line(result.messages)));
    });
    return png;
  }
} // namespace swimtwin
