#include <datasets/error.h>
#include <datasets/foreign_format.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    using namespace std::string_view_literals;

    struct Format
    {
      std::string_view beginning, name, remedy;
    };

    constexpr auto from_spreadsheet = "open it and save the sheet as CSV (Excel: File > Save As > CSV UTF-8)"sv;
    constexpr auto as_it_is         = "unpack it and name the table inside"sv;
    constexpr auto measured_first   = "measure it first (TrackMate, DeepLabCut) and export the positions as CSV"sv;
    constexpr auto from_python      = "load it in Python and write the table with pandas.DataFrame(...).to_csv"sv;

    constexpr Format formats[] = {
        {"PK\x03\x04"sv, "a zip container, such as a workbook of Excel (.xlsx) or LibreOffice (.ods)",
         from_spreadsheet},
        {"\xD0\xCF\x11\xE0"sv, "a binary workbook of Excel (.xls)", from_spreadsheet},
        {"\x89HDF\r\n\x1A\n"sv, "HDF5, as DeepLabCut and pandas write it",
         "write its table as CSV, in Python: pandas.read_hdf(\"FILE.h5\").to_csv(\"FILE.csv\")"},
        {"<TrackMate"sv, "XML of TrackMate",
         "open it in TrackMate (Load a TrackMate file) and export the table Spots of the tracks with Export to CSV"},
        {"<Tracks"sv, "XML of TrackMate (Export tracks to XML file)",
         "export the table Spots of the tracks in TrackMate with Export to CSV instead"},
        {"<!DOCTYPE html"sv, "a web page", "download the file itself (on GitHub: Raw)"},
        {"<!doctype html"sv, "a web page", "download the file itself (on GitHub: Raw)"},
        {"<html"sv, "a web page", "download the file itself (on GitHub: Raw)"},
        {"<"sv, "XML", "export the table as CSV from the program that wrote it"},
        {"{\\rtf"sv, "a text document (RTF)", "save it as plain text"},
        {"{"sv, "JSON", from_python},
        {"[{"sv, "JSON", from_python},
        {"[["sv, "JSON", from_python},
        {"version https://git-lfs"sv, "a pointer of Git LFS, not the file itself", "fetch it with git lfs pull"},
        {"%PDF"sv, "PDF", "name the table that it was made of"},
        {"\x1F\x8B"sv, "compressed (gzip)", as_it_is},
        {"BZh"sv, "compressed (bzip2)", as_it_is},
        {"\xFD\x37zXZ"sv, "compressed (xz)", as_it_is},
        {"\x93NUMPY"sv, "an array of NumPy", from_python},
        {"PAR1"sv, "a Parquet table", from_python},
        {"SQLite format 3"sv, "a database of SQLite", "export the table as CSV"},
        {"MATLAB 5.0 MAT-file"sv, "a MAT-file of MATLAB", "write the table there with writetable(T, \"FILE.csv\")"},
        {"\x89PNG"sv, "a picture (PNG)", measured_first},
        {"II*\0"sv, "a picture or film (TIFF)", measured_first},
        {"MM\0*"sv, "a picture or film (TIFF)", measured_first}};

    /// What a text begins with after a byte order mark, blanks and the declaration of XML.
    std::string_view beginning_of(std::string_view bytes)
    {
      const auto skip_blanks = [&] { bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size())); };
      if (bytes.starts_with("\xEF\xBB\xBF"))
        bytes.remove_prefix(3);
      skip_blanks();
      if (const auto end = bytes.find("?>"); bytes.starts_with("<?xml") && end != std::string_view::npos)
      {
        const std::string_view content = bytes.substr(end + 2);
        bytes                          = content.find('<') == std::string_view::npos ? bytes : content;
        skip_blanks();
      }
      return bytes;
    }
  } // namespace

  void refuse_foreign_format(const std::filesystem::path &file, const std::string_view bytes)
  {
    const std::string_view beginning = beginning_of(bytes);
    for (const Format &format : formats)
      if (bytes.starts_with(format.beginning) || beginning.starts_with(format.beginning))
        throw InputError(
            fmt::format("{}: this is {}, no table as text; {}.", file.string(), format.name, format.remedy));
  }
} // namespace swimtwin
