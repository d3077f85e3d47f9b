#include <app/frame/value_list.h>
#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    std::vector<double> values(const std::string &text, const ValueRule rule = ValueRule::positive)
    {
      return parse_values("--frequency", text, rule);
    }

    std::string refusal(const std::string &text, const ValueRule rule = ValueRule::positive)
    {
      return message_of<InputError>([&] { values(text, rule); });
    }
  } // namespace

  TEST(ValueList, ReadsNumbersListsAndRanges)
  {
    EXPECT_EQ(values("0.8"), std::vector<double>{0.8});
    EXPECT_EQ(values("5e4,8e4,2e5"), (std::vector<double>{5e4, 8e4, 2e5}));
    EXPECT_EQ(values("1:3:5"), (std::vector<double>{1., 1.5, 2., 2.5, 3.}));
    EXPECT_EQ(values("0.1:3:60").size(), 60u);
    EXPECT_EQ(values("0.1:3:60").back(), 3.);
    EXPECT_EQ(values("1:2:2,7"), (std::vector<double>{1., 2., 7.}));
    EXPECT_EQ(values("-2e-3:2e-3:3", ValueRule::finite), (std::vector<double>{-2e-3, 0., 2e-3}));
    const auto decades = values("0.1:10:3:log");
    EXPECT_NEAR(decades[1], 1., 1e-15);
  }

  TEST(ValueList, NamesOptionValueRuleAndRemedy)
  {
    expect_in(refusal(""), "--frequency \"\": a value is missing; give a number such as 0.8");
    expect_in(refusal("1,,2"), "a value is missing");
    expect_in(refusal("fast"), "--frequency fast: \"fast\" is not a number; write it as 0.8 or 5e4");
    expect_in(refusal("1Hz"), "\"1Hz\" is not a number");
    expect_in(refusal("nan"), "is not a number");
    expect_in(refusal("-1"), "-1 is not positive; only values above 0");
    expect_in(refusal("0:3:4"), "0 is not positive");
    expect_in(refusal("3:0.1:60"), "runs from 3 to 0.1; give the lower end first");
    expect_in(refusal("1:1:2"), "give the lower end first");
    expect_in(refusal("0.1:3"), "is not a range; write low:high:number");
    expect_in(refusal("0.1:3:60:exp"), "is not a range");
    expect_in(refusal("0.1:3:1"), "a range of 1 values is not possible; it needs at least 2");
    expect_in(refusal("0.1:3:-5"), "a range of -5 values");
    expect_in(refusal("0.1:3:2.5"), "\"2.5\" is not a whole number of values");
    expect_in(refusal("-1:3:5:log", ValueRule::finite), "start it above 0");
  }

  TEST(Share, IsOfAHundredOrOfOne)
  {
    EXPECT_DOUBLE_EQ(parse_share("--target", "1%"), 0.01);
    EXPECT_DOUBLE_EQ(parse_share("--target", "0.01"), 0.01);
    const auto refusal = [](const std::string &text) {
      return message_of<InputError>([&] { parse_share("--target", text); });
    };
    expect_in(refusal("1"), "--target 1 is 100 %, which is no agreement; choose 20 % at most, such as 1% or 0.01.");
    expect_in(refusal("150%"), "150 %");
    expect_in(refusal("0"), "--target");
    expect_in(refusal("small"), "is not a number");
  }
} // namespace swimtwin
