// Pictures drawn by gnuplot: a table, a script that a user can restyle and run again, and the PNG.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace swimtwin
{
  /// Blocks of numbers as gnuplot's `index` counts them, each under a comment that names its columns. It would pass
  /// over one without rows, which has a row that is not drawn.
  class GnuplotTable
  {
  public:
    void begin_block(std::string_view columns);
    void add_row(const std::vector<double> &values);
    /// The rows since the last one are the corners of a polygon.
    void end_polygon() { text_ += '\n'; }

    std::string text() const { return has_rows_ ? text_ : text_ + undrawn_row; }

  private:
    static constexpr const char *undrawn_row = "NaN NaN NaN NaN\n";

    std::string text_;
    bool        has_rows_ = true; ///< the last block
  };

  /// One picture `name`.png. The script finds the variables assigned and the style loaded before its first line, and
  /// reads the table as the file `data`.
  struct GnuplotPicture
  {
    std::string                                      name;
    std::vector<std::pair<std::string, std::string>> variables; ///< name, value as gnuplot reads it
    GnuplotTable                                     table;
    std::string_view                                 script;

    void set(const std::string &variable, double value);
    void set_flag(const std::string &variable, bool value);
    /// A line of text, shown as it is: gnuplot's marks for subscripts and the like have no effect.
    void set_text(const std::string &variable, std::string_view text);
  };

  /// With what every script of ours shows above its panels: a heading, and under it what there is to see.
  GnuplotPicture titled_picture(const std::string &name, std::string_view script, std::string_view heading,
                                std::string_view caption);

  /// Why nothing can be drawn, and what to do.
  struct GnuplotFault
  {
    std::string cause, remedy;
  };

  /// None where gnuplot answers when asked for its version.
  std::optional<GnuplotFault> find_gnuplot_fault();

  /// Write style.gp, name.dat and name.gp; `origin` is a comment in each. An earlier name.png is removed. Throws
  /// ComputationError (disk full, ...).
  void write_gnuplot_files(const std::filesystem::path &folder, const GnuplotPicture &picture, std::string_view origin);

  inline constexpr std::chrono::seconds drawing_limit(60);

  /// Run name.gp in its folder. Throws ComputationError with gnuplot's message, or when it does not end within the
  /// limit. Returns the PNG. The picture depends on its files, on gnuplot and on the fonts of the machine, and not on
  /// variables or settings of the user.
  std::filesystem::path draw_png(const std::filesystem::path &folder, const std::string &name,
                                 std::chrono::milliseconds limit = drawing_limit);
} // namespace swimtwin
