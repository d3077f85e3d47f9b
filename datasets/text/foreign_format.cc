#include <datasets/files/input_file.h>
#include <datasets/text/foreign_format.h>

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
    constexpr auto measured_first   = "measure it first (TrackMate, DeepLabCut) and export the positions as CSV"sv;
    constexpr auto from_python      = "load it in Python and write the table with pandas.DataFrame(...).to_csv"sv;
    constexpr auto spots_of_trackmate =
        "open it in TrackMate (Load a TrackMate file) and export the table Spots of the tracks with Export to CSV"sv;

    constexpr Format formats[] = {
        {"PK\x03\x04"sv, "a ZIP archive, such as a workbook of Excel (.xlsx) or LibreOffice (.ods)", from_spreadsheet},
        {"\xD0\xCF\x11\xE0"sv, "a workbook of Excel (.xls)", from_spreadsheet},
        {hdf5_signature, "HDF5, as DeepLabCut and pandas write it",
         "write its table as CSV, in Python: pandas.read_hdf(\"FILE.h5\").to_csv(\"FILE.csv\")"},
        {"<TrackMate"sv, "TrackMate's XML", spots_of_trackmate},
        {"<Tracks"sv, "TrackMate's XML (Export tracks to XML file)", spots_of_trackmate},
        {"<Workbook"sv, "a workbook of Excel (XML)", from_spreadsheet},
        {"{\\rtf"sv, "a text document (RTF)", "save it as plain text"},
        {"{"sv, "JSON", from_python},
        {"[{"sv, "JSON", from_python},
        {"[["sv, "JSON", from_python},
        {"%PDF"sv, "PDF", "name the table that it was made of"},
        {"\x93NUMPY"sv, "an array of NumPy", from_python},
        {"PAR1"sv, "a Parquet table", from_python},
        {"SQLite format 3"sv, "a database of SQLite", "export the table as CSV"},
        {"MATLAB 5.0 MAT-file"sv, "a MAT-file of MATLAB", "write the table there with writetable(T, \"FILE.csv\")"},
        {"MATLAB 7.3 MAT-file"sv, "a MAT-file of MATLAB", "write the table there with writetable(T, \"FILE.csv\")"},
        {"bplist00"sv, "a property list of Apple, such as a sheet of Numbers", from_spreadsheet},
        {"\x89PNG"sv, "a picture (PNG)", measured_first},
        {"\xFF\xD8\xFF"sv, "a picture (JPEG)", measured_first},
        {"II*\0"sv, "a picture or film (TIFF)", measured_first},
        {"MM\0*"sv, "a picture or film (TIFF)", measured_first}};

    /// What a text begins with after a byte order mark, blanks and the declaration of XML.
    std::string_view beginning_of(std::string_view content)
    {
      const auto skip_blanks = [&] {
        content.remove_prefix(std::min(content.find_first_not_of(" \t\r\n"), content.size()));
      };
      if (content.starts_with("\xEF\xBB\xBF"))
        content.remove_prefix(3);
      skip_blanks();
      if (const auto end = content.find("?>"); content.starts_with("<?xml") && end != std::string_view::npos)
      {
        content.remove_prefix(end + 2);
        skip_blanks();
      }
      return content;
    }
  } // namespace

  void refuse_foreign_table(const std::filesystem::path &file, const std::string_view content)
  {
    const std::string_view beginning = beginning_of(content);
    for (const Format &format : formats)
      if (content.starts_with(format.beginning) || beginning.starts_with(format.beginning))
        refuse_file(file, "the table", fmt::format("it is {}; {}", format.name, format.remedy));
    if (const auto foreign = foreign_content(content))
      refuse_file(file, "the table", *foreign);
    if (beginning.starts_with('<'))
      refuse_file(file, "the table", "it is XML; export the table as CSV from the program that wrote it");
  }
} // namespace swimtwin
