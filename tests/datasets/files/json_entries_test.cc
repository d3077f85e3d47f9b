#include <datasets/files/json_entries.h>

#include <tests/datasets/temporary_folder.h>

#include <cmath>
#include <limits>

namespace swimtwin
{
  struct JsonLeaf
  {
    double              number = 0.;
    std::optional<bool> perhaps;
    Eigen::MatrixXd     rows;
  };
  struct JsonTree
  {
    std::vector<JsonLeaf>         leaves;
    std::map<std::string, double> terms;
    NamedNumbers                  parts;
    unsigned long                 seed = 0;
  };

  template <Like<JsonLeaf> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("number", v.number);
    visit("perhaps", v.perhaps);
    visit("rows", v.rows);
  }
  template <Like<JsonTree> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("leaves", v.leaves);
    visit("terms", v.terms);
    visit("parts", v.parts);
    visit("seed", v.seed);
  }

  namespace
  {
    JsonTree example_tree()
    {
      JsonTree tree;
      tree.leaves = {{1. / 3., true, Eigen::MatrixXd::Random(2, 3)}, {-0., {}, {}}};
      tree.terms  = {{"b", 2.}, {"a", 1e-300}};
      tree.parts  = {{"z", 1.}, {"y", 2.}};
      tree.seed   = std::numeric_limits<unsigned long>::max();
      return tree;
    }

    std::string refusal(const std::string &text)
    {
      JsonTree tree;
      return message_of<InputError>([&] { read_json(Json::parse(text), tree); });
    }
  } // namespace

  TEST(JsonEntries, KeepEveryBitOnTheWayThereAndBack)
  {
    const JsonTree written = example_tree();
    JsonTree       read;
    read.terms["stale"] = 1.;
    read_json(Json::parse(json_of(written).dump()), read);
    ASSERT_EQ(read.leaves.size(), 2u);
    EXPECT_EQ(read.leaves[0].number, written.leaves[0].number);
    EXPECT_EQ(read.leaves[0].perhaps, true);
    EXPECT_EQ(read.leaves[0].rows, written.leaves[0].rows);
    EXPECT_FALSE(read.leaves[1].perhaps);
    EXPECT_EQ(read.leaves[1].rows.size(), 0);
    EXPECT_EQ(read.terms, written.terms);
    EXPECT_EQ(read.parts, written.parts); // in their order
    EXPECT_EQ(read.seed, written.seed);
  }

  TEST(JsonEntries, NumbersThatAreNotFiniteAreNullAndComeBackAsNaN)
  {
    for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    {
      EXPECT_TRUE(json_of(value).is_null());
      double read = 0.;
      read_json(json_of(value), read);
      EXPECT_TRUE(std::isnan(read));
    }
  }

  TEST(JsonEntries, NamesTheInnermostEntryAtFault)
  {
    EXPECT_EQ(refusal("{}"), "lacks the entry leaves");
    EXPECT_EQ(refusal("3"), "lacks the entry leaves");
    EXPECT_EQ(refusal(R"({"leaves": "none"})"), "has an entry leaves of the wrong kind");
    EXPECT_EQ(refusal(R"({"leaves": [{"number": 1}]})"), "lacks the entry perhaps");
    EXPECT_EQ(refusal(R"({"leaves": [{"number": "1"}]})"), "has an entry number of the wrong kind");
    EXPECT_EQ(refusal(R"({"leaves": [{"number": 1, "perhaps": null, "rows": [[1, 2], [3]]}]})"),
              "has rows of different lengths");
    EXPECT_EQ(refusal(R"({"leaves": [], "terms": {"a": "b"}})"), "has an entry terms of the wrong kind");
  }

  // A conversion would make another number of it, whichever the machine likes.
  TEST(JsonEntries, CountsAreWholeAndNotTooLarge)
  {
    for (const char *wrong : {"-1", "0.5", "1e30", "18446744073709551616", "-1e300"})
      expect_in(refusal(fmt::format(R"({{"leaves": [], "terms": {{}}, "parts": {{}}, "seed": {}}})", wrong)),
                "not whole, or too large");
    for (const char *right : {"0", "3", "3.0", "18446744073709551615"})
    {
      JsonTree tree;
      read_json(Json::parse(fmt::format(R"({{"leaves": [], "terms": {{}}, "parts": {{}}, "seed": {}}})", right)), tree);
      EXPECT_EQ(static_cast<double>(tree.seed), std::stod(right));
    }
    const auto read_int = [](const char *text) {
      int value = 0;
      read_json(Json::parse(text), value);
      return value;
    };
    EXPECT_EQ(read_int("-2147483648"), std::numeric_limits<int>::min());
    EXPECT_EQ(read_int("2147483647"), std::numeric_limits<int>::max());
    EXPECT_THROW(read_int("2147483648"), InputError);
  }

  TEST(JsonEntries, AFileOfTooLargeANumberIsNamed)
  {
    const TemporaryFolder folder;
    const auto            file = folder.write("a.json", R"({"number": 1e999})");
    expect_in(message_of<InputError>([&] { read_json_file(file, "the summary", "run again"); }),
              "a.json holds a number that is too large to be read; run again.");
  }
} // namespace swimtwin
