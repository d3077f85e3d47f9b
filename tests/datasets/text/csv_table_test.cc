#include <datasets/system/error.h>
#include <datasets/text/csv_table.h>
#include <tests/datasets/temporary_folder.h>

namespace swimtwin
{
  namespace
  {
    using namespace std::string_literals;

    CsvTable table_of(const std::string &bytes)
    {
      const TemporaryFolder folder;
      return CsvTable::read(folder.write("t.csv", bytes));
    }

    std::string refusal_of_table(const std::string &bytes)
    {
      const TemporaryFolder folder;
      const auto            file = folder.write("t.csv", bytes);
      return message_of<InputError>([&] { CsvTable::read(file); });
    }

    /// ASCII as UTF-16.
    std::string wide(const std::string &text, const bool little)
    {
      std::string bytes;
      for (const char c : text)
        bytes += little ? std::string{c, '\0'} : std::string{'\0', c};
      return bytes;
    }

    void expect_the_table(const CsvTable &table)
    {
      ASSERT_TRUE(table.has_column("a") && table.has_column("b"));
      EXPECT_EQ(table.column("a"), (std::vector<double>{0.5, 2.}));
      EXPECT_EQ(table.column("b"), (std::vector<double>{-1e-4, 3.25}));
    }
  } // namespace

  TEST(CsvTable, FindsTheSeparator)
  {
    for (const std::string separator : {",", ";", "\t", "|", " ", " ; ", "   "})
      expect_the_table(table_of("a" + separator + "b\n0.5" + separator + "-1e-4\n2" + separator + "3.25\n"));
    for (const std::string stated : {"sep=;\n", "Sep=;\n", "\"sep=;\"\n", "sep=;\r\n"})
      expect_the_table(table_of(stated + "a;b\n0.5;-1e-4\n2;3.25\n"));
    expect_in(refusal_of_table("sep=x\naxb\n"), "t.csv:1: \"sep=x\" names no separator that is known");
  }

  TEST(CsvTable, TakesTheSeparatorThatMakesEqualRowsOrAsks)
  {
    const CsvTable table = table_of("a;b (x, y)\n1;2,5\n3;4\n");
    EXPECT_EQ(table.column("b (x, y)"), (std::vector<double>{2.5, 4.}));
    expect_in(refusal_of_table("a;b,c\n1;2,5\n"),
              "t.csv:1: the columns may be separated by \";\" or by \",\"; say which with");
  }

  TEST(CsvTable, ReadsDecimalCommasWhereTheyAreCertain)
  {
    for (const std::string separator : {";", "\t", "|", " "})
      expect_the_table(table_of("a" + separator + "b\n0,5" + separator + "-1e-4\n2" + separator + "3,25\n"));
    expect_the_table(table_of("a,b\n\"0,5\",-1e-4\n2,\"3,25\"\n"));
    EXPECT_EQ(table_of("a;b\n0,5;1,234\n").column("b"), std::vector<double>{1.234}); // as the other column says
    EXPECT_EQ(table_of("a;b\n0,5;7.5\n").column("b"), std::vector<double>{7.5});
  }

  TEST(CsvTable, RefusesNumbersThatMayMeanTwoThings)
  {
    const auto refusal_in = [](const std::string &text, const std::string &column) {
      return message_of<InputError>([&] { table_of(text).column(column); });
    };
    const std::string either = "its mark may stand between thousands or before decimals: write 1234 or 1.2340";
    expect_in(refusal_in("a;b\n1,234;2\n", "a"), either);
    expect_in(refusal_in("a,b\n\"1,234\",0.5\n", "a"), either);
    expect_in(refusal_in("a;b\n1.234;0,5\n", "a"), either);
    expect_in(refusal_in("a;b\n1;151.000\n2;95.000\n", "b"), either);
    EXPECT_EQ(table_of("a;b\n1;151.0000\n2;95.000\n").column("b"), (std::vector<double>{151., 95.}));
    EXPECT_EQ(table_of("a;b\n0.5;151.000\n").column("b"), std::vector<double>{151.});
    EXPECT_EQ(table_of("a\tb\n1\t151.000\n").column("b"), std::vector<double>{151.});
    expect_in(refusal_in("a;b\n1.234,5;2\n", "a"), "write it without separators between thousands");
    expect_in(refusal_in("a;b\n0,5;2\n0.5;2\n", "a"),
              "t.csv:2: a = \"0,5\" is not a finite number; other cells have decimal "
              "points: write all numbers of the table with one decimal mark.");
    expect_in(refusal_in("a;b\n0,5 mm;2\n", "a"), "write the number alone, without unit or blanks");
    expect_in(refusal_in("a;b\n;2\n", "a"), "correct it, or leave the row out");
    EXPECT_EQ(table_of("a,b\n-1.5D-04,2\n").column("a"), std::vector<double>{-1.5e-4}); // Fortran
    EXPECT_EQ(table_of("a,b\n\u22120.5,+2\n").column("a"), std::vector<double>{-0.5});  // the sign of typesetting
  }

  TEST(CsvTable, ReadsEncodingsAndLineEndsOfOtherSystems)
  {
    const std::string text = "a,b\n0.5,-1e-4\n2,3.25\n", dos = "a,b\r\n0.5,-1e-4\r\n2,3.25\r\n",
                      mac = "a,b\r0.5,-1e-4\r2,3.25\r";
    for (const std::string &bytes : {text, dos, mac, "\xEF\xBB\xBF" + dos, "\xFF\xFE" + wide(dos, true),
                                     "\xFE\xFF" + wide(text, false), wide(text, true), wide(mac, false)})
      expect_the_table(table_of(bytes));
    EXPECT_TRUE(table_of("x (\xB5m),b\n1,2\n").has_column("x (\u00B5m)")); // Windows-1252, Latin-1
    EXPECT_TRUE(table_of("x (\u00B5m),b\n1,2\n").has_column("x (\u00B5m)"));
    const CsvTable mixed = table_of("x (\u00B5m),Gr\xF6\u00DFe\n1,2\n");
    EXPECT_TRUE(mixed.has_column("x (\u00B5m)") && mixed.has_column("Gr\u00F6\u00DFe"));
    expect_in(refusal_of_table("\xFF\xFE" + wide(text, true) + "x"),
              "t.csv: this is text in UTF-16LE that is cut or damaged");
    expect_in(refusal_of_table("a,b\n1,2\n\0\0\0"s), "t.csv:3: there are NUL bytes");
  }

  TEST(CsvTable, ForgetsWhatASpreadsheetLeftEmpty)
  {
    expect_the_table(table_of(",,\na,b,,\n0.5,-1e-4,,\n2,3.25,,\n,,,\n,,,\n"));
    expect_the_table(table_of(",a,b\n,0.5,-1e-4\n,2,3.25\n"));
    expect_the_table(table_of("a,b\n0.5,-1e-4,,\n2,3.25,\n"));
    expect_the_table(table_of("a,b,,\n0.5,-1e-4\n2,3.25\n"));
    expect_the_table(table_of("a,b\n0.5,-1e-4\na,b\n2,3.25\n")); // two files in one
    EXPECT_EQ(table_of(",a,b\n,0.5,-1e-4\n").quote(0, "a"), "a (column 2) = \"0.5\"");
  }

  TEST(CsvTable, KnowsRowNumbersWithoutAName)
  {
    expect_the_table(table_of("\"a\" \"b\"\n\"1\" 0.5 -1e-4\n\"2\" 2 3.25\n")); // R
    expect_the_table(table_of("\"a\",\"b\"\n\"1\",0.5,-1e-4\n\"2\",2,3.25\n"));
    expect_the_table(table_of(" \ta\tb\n1\t0.5\t-1e-4\n2\t2\t3.25\n")); // ImageJ
    expect_the_table(table_of(",a,b\n0,0.5,-1e-4\n1,2,3.25\n"));        // pandas
    expect_the_table(table_of("row,a,b\n1,0.5,-1e-4\n2,2,3.25\n"));
  }

  TEST(CsvTable, AsksWhetherTheFirstColumnOrTheLastHasNoName)
  {
    const std::string either =
        "may number the rows or be a beside a last column without a name; name the column of row "
        "numbers too (row), or delete the one without a name.";
    for (const std::string &text :
         {"a,b\n1,0.5,-1e-4\n2,2,3.25\n"s, "a b\n1 0.5 -1e-4\n2 2 3.25\n"s, "a,b\n0,0.5,-1e-4\n1,2,3.25\n"s,
          "\"a\",\"b\"\n\"1\",\"0.5\",\"2\"\n\"2\",\"2\",\"3\"\n"s})
      expect_in(refusal_of_table(text), either);
    expect_in(refusal_of_table("a,b\n1,0.5,3\n2,2,4\n"),
              "t.csv:1: the header names 2 columns but the rows have 3 values, and 1, 2, ... may number");
    expect_in(refusal_of_table("a,b\n2,0.5,3\n3,2,4\n"), "this row has 3 values but the header names 2 columns");
  }

  TEST(CsvTable, ReadsQuotedCells)
  {
    const CsvTable table = table_of("a,\"note, long\",\"two\nlines\"\n1,\"says \"\"so\"\", late\",2\n3,5\" tail,4\n");
    EXPECT_EQ(table.column_names(), (std::vector<std::string>{"a", "note, long", "two lines"}));
    EXPECT_EQ(table.cells(0)[1], "says \"so\", late");
    EXPECT_EQ(table.cells(1)[1], "5\" tail");
    EXPECT_EQ(table.line(1), 4u);
  }

  TEST(CsvTable, SkipsCommentsButNotErrorsOfASpreadsheet)
  {
    const CsvTable table = table_of("# \"quoted\na,b\n#0.4,2\n#N/A,3\n#DIV/0!,4\n0.5,5\n");
    EXPECT_EQ(table.n_rows(), 3u);
    EXPECT_FALSE(table.number(0, "a"));
    EXPECT_EQ(table.number(2, "a"), 0.5);
    for (const char *error : {"########", "#N/A N/A", "#N/D", "#WERT!", "#NAME?"})
      EXPECT_EQ(table_of("a;b\n"s + error + ";3\n0.5;5\n").n_rows(), 2u) << error;
    for (const char *comment : {"#", "########", "######;;", "# sorted; 3", "#0.4;2", "## Part 2; of May"})
      EXPECT_EQ(table_of("########;May;2024\na;b\n"s + comment + "\n0.5;5\n").n_rows(), 1u) << comment;
    expect_in(message_of<InputError>([] { table_of("a;b\n####;3\n").column("a"); }),
              "t.csv:2: a = \"####\" is not a finite number; a spreadsheet writes # where a column is too narrow: make "
              "it wider and save the table again.");
  }

  TEST(CsvTable, SaysWhatRowsOfAnotherLengthMayBe)
  {
    expect_in(refusal_of_table("a,b\n0,5,1,25\n1,5,2,5\n"),
              "t.csv:2: this row has 4 values but the header names 2 columns (2 rows: lines 2, 3); give one value per "
              "column, or "
              "save the table with semicolons or tabs between the columns if these are decimal commas.");
    expect_in(refusal_of_table("Run of May\n1,2\n"), "if the header is a title, delete it or put # before it");
    for (const char *title : {"Run of May", "Run 3, May, 2024"})
      expect_in(refusal_of_table(title + "\na,b\n1,2\n"s),
                " but every row below it 2, and line 2 names the columns: if it is a title, delete it or put # before");
    expect_in(refusal_of_table("a,b\n1;2\n3;4\n"), "separate the rows like the header");
  }

  TEST(CsvTable, RefusesOtherFormatsByWhatTheyAre)
  {
    expect_in(refusal_of_table("PK\x03\x04zip"), "t.csv: it is a ZIP archive, such as a workbook of Excel (.xlsx)");
    expect_in(refusal_of_table("\xD0\xCF\x11\xE0\xA1"),
              "a workbook of Excel (.xls); open it and save the sheet as CSV");
    expect_in(refusal_of_table("\x89HDF\r\n\x1A\n"), "pandas.read_hdf");
    expect_in(refusal_of_table("<?xml version=\"1.0\"?>\n<TrackMate version=\"7\">"), "it is TrackMate's XML; open it");
    expect_in(refusal_of_table("\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<Workbook>"), "a workbook of Excel (XML)");
    expect_in(refusal_of_table("<?xml version=\"1.0\"?>\n<Error>"), "an XML document");
    expect_in(refusal_of_table("<root>"), "it is XML; export the table as CSV");
    expect_in(refusal_of_table("<!DOCTYPE html>"), "a web page");
    expect_in(refusal_of_table("<div><p>"), "a web page");
    expect_in(refusal_of_table("<TABLE border=1><tr><td>a"), "open it in a spreadsheet and save the sheet as CSV");
    expect_in(refusal_of_table("<html xmlns:x=\"urn:schemas-microsoft-com:office:excel\">"),
              "open it in a spreadsheet");
    expect_in(refusal_of_table("MATLAB 7.3 MAT-file, Platform"), "a MAT-file of MATLAB; write the table there");
    expect_in(refusal_of_table("bplist00\xD1"), "a property list of Apple");
    expect_in(refusal_of_table("outs:\n- md5: 12ab\n  path: t.csv\n"), "a pointer of DVC");
    expect_in(refusal_of_table("\x28\xB5\x2F\xFD$"), "unpack it first");
    expect_in(refusal_of_table("{\"a\": 1}"), "JSON");
    expect_in(refusal_of_table("version https://git-lfs.github.com/spec/v1\n"), "git lfs pull");
    expect_in(refusal_of_table("\x1F\x8B"), "unpack it first");
    expect_in(refusal_of_table(""), "the file is empty");
    expect_in(refusal_of_table("\n,,\n# nothing\n"), "the file is empty");
  }

  TEST(CsvTable, NamesTheFactorOfAColumnInAnotherUnit)
  {
    expect_in(message_of<InputError>([] { table_of("bx_mT,b\n1,2\n").column("bx_T"); }),
              "the column bx_T is missing; multiply bx_mT by 0.001 and name it bx_T.");
  }
} // namespace swimtwin
