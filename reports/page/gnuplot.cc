#include <reports/page/gnuplot.h>

#include <datasets/files/output_folder.h>
#include <reports/page/gnuplot_process.h>
#include <reports/page/gnuplot_style.h>

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <system_error>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr std::chrono::seconds version_limit(10);

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
    if (!has_rows_)
      text_ += undrawn_row;
    text_ += fmt::format("{}# {}\n", text_.empty() ? "" : "\n\n", columns);
    has_rows_ = false;
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
    has_rows_ = true;
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

  GnuplotPicture titled_picture(const std::string &name, const std::string_view script, const std::string_view heading,
                                const std::string_view caption)
  {
    GnuplotPicture picture{name, {}, {}, script};
    picture.set_text("heading", heading);
    picture.set_text("caption", caption);
    return picture;
  }

  std::optional<GnuplotFault> find_gnuplot_fault()
  {
    const ProcessResult result = run_gnuplot("/", {"--version"}, version_limit);
    if (result.succeeded)
      return std::nullopt;
    if (!result.found)
      return GnuplotFault{"gnuplot is not installed", "install it with `apt-get install gnuplot-nox`"};
    return GnuplotFault{fmt::format("`gnuplot --version` fails: {}", one_line(result.messages)),
                        "put the folder of a gnuplot that works first in PATH"};
  }

  void write_gnuplot_files(const fs::path &folder, const GnuplotPicture &picture, const std::string_view origin)
  {
    fs::remove(folder / (picture.name + ".png")); // it may not show these data
    write_text_atomically(folder / "style.gp", gnuplot_scripts::style);
    write_text_atomically(folder / (picture.name + ".dat"), comment(origin) + picture.table.text());
    write_text_atomically(folder / (picture.name + ".gp"), script_text(picture, origin));
  }

  fs::path draw_png(const fs::path &folder, const std::string &name, const std::chrono::milliseconds limit)
  {
    const fs::path png = folder / (name + ".png");
    write_atomically(png, [&](const fs::path &partial) {
      const std::string   output = fmt::format("picture='{}'", partial.filename().string());
      const ProcessResult result = run_gnuplot(folder, {"-e", output, name + ".gp"}, limit);
      std::error_code     absent;
      const bool          drawn = fs::file_size(partial, absent) > 0 && !absent;
      if (!result.succeeded || !drawn)
        throw std::runtime_error(fmt::format("gnuplot failed: {}", one_line(result.messages)));
    });
    return png;
  }
} // namespace swimtwin
