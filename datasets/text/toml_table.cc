#include <datasets/system/error.h>
#include <datasets/system/nearest_name.h>
#include <datasets/text/toml_table.h>
#include <datasets/text/unit_names.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    std::string in_unit(const std::string_view unit)
    {
      return unit.empty() ? std::string() : fmt::format(" in {}", unit);
    }

    std::string number_words(const NumberRule &rule)
    {
      return fmt::format("a number{}", in_unit(rule.unit));
    }

    std::string join_words(const std::vector<std::string> &words)
    {
      return fmt::format("\"{}\"", fmt::join(words, "\", \""));
    }
  } // namespace

  bool Range::contains(const double value) const
  {
    const bool above = low_excluded ? value > low : value >= low;
    const bool below = high_excluded ? value < high : value <= high;
    return std::isfinite(value) && above && below;
  }

  TomlTable::TomlTable(const TomlDocument &document, std::string path) : document_(document), path_(std::move(path))
  {
    const toml::node *node = document.find(path_);
    if (node == nullptr)
      return;
    table_ = node->as_table();
    if (table_ == nullptr)
      document.refuse("", path_, "must be a table of entries.");
  }

  void TomlTable::note(const std::string &key, const std::string &problem)
  {
    problems_.push_back(document_.sentence(path_, key, problem));
  }

  void TomlTable::wrong_type(const std::string &key, const std::string &expected)
  {
    note(key, fmt::format("has the wrong type; {} is needed.", expected));
  }

  const toml::node *TomlTable::entry(const std::string &key, const Need need, const std::string &expected)
  {
    known_.push_back(key);
    if (has(key))
      return table_->get(key);
    if (present() && need == Need::required)
      note(key, fmt::format("is missing; add it as {}.", expected));
    return nullptr;
  }

  std::optional<double> TomlTable::read_number(const std::string &key, const toml::node &node, const NumberRule &rule)
  {
    if (!node.is_number())
      return std::nullopt;
    const double value = *node.value<double>();
    if (!rule.range.contains(value))
      note(key, fmt::format("is out of range; it must {}{}.", rule.range.words,
                            rule.unit.empty() ? "" : fmt::format(" (unit: {})", rule.unit)));
    return value;
  }

  void TomlTable::number(const std::string &key, const NumberRule &rule, double &target)
  {
    std::optional<double> value;
    number(key, rule, value);
    target = value.value_or(target);
  }

  void TomlTable::number(const std::string &key, const NumberRule &rule, std::optional<double> &target)
  {
    const toml::node *node = entry(key, rule.need, number_words(rule));
    if (node == nullptr)
      return;
    target = read_number(key, *node, rule);
    if (!target)
      wrong_type(key, number_words(rule));
  }

  void TomlTable::pair(const std::string &key, const NumberRule &rule, std::array<double, 2> &target)
  {
    list(key, rule, "an array of two numbers [x, y]", target.data(), target.size());
  }

  void TomlTable::pairs(const std::string &key, const NumberRule &rule, std::vector<std::array<double, 2>> &target)
  {
    const std::string expected = "an array of points [[x, y], ...]" + in_unit(rule.unit);
    const toml::node *node     = entry(key, rule.need, expected);
    if (node == nullptr)
      return;
    const toml::array *points = node->as_array();
    if (points == nullptr || points->empty())
      return wrong_type(key, expected);
    for (const toml::node &point : *points)
    {
      const toml::array *array = point.as_array();
      if (array == nullptr || array->size() != 2)
        return wrong_type(key, expected);
      std::array<double, 2> values;
      for (std::size_t i = 0; i < 2; ++i)
      {
        const std::optional<double> value = read_number(key, *array->get(i), rule);
        if (!value)
          return wrong_type(key, expected);
        values[i] = *value;
      }
      target.push_back(values);
    }
  }

  void TomlTable::triple(const std::string &key, const NumberRule &rule, std::array<double, 3> &target)
  {
    list(key, rule, "an array of three numbers [x, y, z]", target.data(), target.size());
  }

  void TomlTable::list(const std::string &key, const NumberRule &rule, const std::string &shape, double *target,
                       const std::size_t size)
  {
    const std::string expected = shape + in_unit(rule.unit);
    const toml::node *node     = entry(key, rule.need, expected);
    if (node == nullptr)
      return;
    const toml::array *array = node->as_array();
    if (array == nullptr || array->size() != size)
      return wrong_type(key, expected);
    for (std::size_t i = 0; i < size; ++i)
    {
      const std::optional<double> value = read_number(key, *array->get(i), rule);
      if (!value)
        return wrong_type(key, expected);
      target[i] = *value;
    }
  }

  std::optional<int> TomlTable::read_integer(const std::string &key, const toml::node &node, const NumberRule &rule)
  {
    if (!node.is_integer())
      return std::nullopt;
    const double value = *read_number(key, node, rule);
    if (std::abs(value) <= std::numeric_limits<int>::max())
      return static_cast<int>(value);
    note(key, "is out of range; it must be smaller.");
    return 0;
  }

  void TomlTable::integer(const std::string &key, const NumberRule &rule, int &target)
  {
    const toml::node *node = entry(key, rule.need, "a whole number");
    if (node == nullptr)
      return;
    if (const std::optional<int> value = read_integer(key, *node, rule))
      target = *value;
    else
      wrong_type(key, "a whole number without point or exponent");
  }

  void TomlTable::integers(const std::string &key, const NumberRule &rule, std::vector<int> &target)
  {
    const std::string expected = "a whole number, or several as in [0, 3],";
    const toml::node *node     = entry(key, rule.need, expected);
    if (node == nullptr)
      return;
    target.clear();
    const toml::array *array = node->as_array();
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i)
      if (const std::optional<int> value = read_integer(key, *array->get(i), rule))
        target.push_back(*value);
      else
        return wrong_type(key, expected);
    if (const std::optional<int> value = array == nullptr ? read_integer(key, *node, rule) : std::nullopt)
      target.push_back(*value);
    if (target.empty())
      wrong_type(key, expected);
  }

  void TomlTable::flag(const std::string &key, bool &target, const Need need)
  {
    const toml::node *node = entry(key, need, "true or false");
    if (node == nullptr)
      return;
    if (!node->is_boolean())
      return wrong_type(key, "true or false");
    target = *node->value<bool>();
  }

  void TomlTable::text(const std::string &key, std::string &target, const Need need)
  {
    const toml::node *node = entry(key, need, "a text in quotes");
    if (node == nullptr)
      return;
    if (!node->is_string())
      return wrong_type(key, "a text in quotes");
    target = *node->value<std::string>();
  }

  void TomlTable::table(const std::string &key)
  {
    known_.push_back(key);
  }

  void TomlTable::word(const std::string &key, const Need need, const std::vector<std::string> &words,
                       std::string &target)
  {
    if (const auto index = choose(key, need, words))
      target = words[*index];
  }

  void TomlTable::words(const std::string &key, const Need need, const std::vector<std::string> &words,
                        std::vector<std::string> &target)
  {
    const std::string expected = fmt::format("an array of some of {}", join_words(words));
    const toml::node *node     = entry(key, need, expected);
    if (node == nullptr)
      return;
    const toml::array *array = node->as_array();
    if (array == nullptr)
      return wrong_type(key, expected);
    target.clear();
    for (const toml::node &element : *array)
    {
      const auto value = element.value<std::string>();
      if (!value || !element.is_string())
        return wrong_type(key, expected);
      if (std::find(words.begin(), words.end(), *value) == words.end())
        return note(key, fmt::format("names \"{}\", which is not known; the nearest is \"{}\" ({}).", *value,
                                     nearest_name(*value, words), expected));
      if (std::find(target.begin(), target.end(), *value) != target.end())
        return note(key, fmt::format("names \"{}\" twice; name it once.", *value));
      target.push_back(*value);
    }
  }

  std::optional<std::size_t> TomlTable::choose(const std::string &key, const Need need,
                                               const std::vector<std::string> &words)
  {
    const std::string expected = fmt::format("one of {}", join_words(words));
    const toml::node *node     = entry(key, need, expected);
    if (node == nullptr)
      return std::nullopt;
    const auto value = node->value<std::string>();
    const auto found = std::find(words.begin(), words.end(), value.value_or(std::string()));
    if (found != words.end())
      return static_cast<std::size_t>(found - words.begin());
    if (value)
      note(key, fmt::format("is not known; the nearest is \"{}\" ({}).", nearest_name(*value, words), expected));
    else
      wrong_type(key, expected);
    return std::nullopt;
  }

  /// An entry in another unit is not to be renamed only.
  std::string TomlTable::advice_for(const std::string &unknown, const toml::node &node) const
  {
    for (const std::string &known : known_)
      if (const std::optional<double> factor = factor_between_names(unknown, known); factor && *factor != 1.)
        return fmt::format("it is {} in another unit: write {} {}", known, known,
                           node.is_number() ? fmt::format("= {:.10g}", *factor * *node.value<double>())
                                            : fmt::format("and multiply by {:.6g}", *factor));
    return fmt::format("the nearest known name is {}", nearest_name(unknown, known_));
  }

  std::vector<std::string> TomlTable::problems() const
  {
    if (!present())
      return {};
    std::vector<std::string> sentences;
    for (const auto &[key, node] : *table_)
      if (const std::string word(key.str()); std::find(known_.begin(), known_.end(), word) == known_.end())
      {
        const std::string kind   = node.is_table() ? "table" : "entry";
        const std::string prefix = path_.empty() ? "" : fmt::format("[{}] ", path_);
        sentences.push_back(fmt::format("{}: {}{} is not a known {}; {}.", document_.where(join_path(path_, word)),
                                        prefix, word, kind, advice_for(word, node)));
      }
    sentences.insert(sentences.end(), problems_.begin(), problems_.end());
    return sentences;
  }

  void TomlTable::finish() const
  {
    if (const std::vector<std::string> sentences = problems(); !sentences.empty())
      throw InputError(sentences.front());
  }
} // namespace swimtwin
