// One table of a TOML document, read entry by entry with type, unit, range and spelling checked.
#pragma once

#include <datasets/text/toml_document.h>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swimtwin
{
  enum class Need { required, optional };

  /// Interval of allowed values, and the words for it.
  struct Range
  {
    double           low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    bool             low_excluded = false, high_excluded = false;
    std::string_view words = "be a finite number";

    bool contains(double value) const;
  };

  inline constexpr double infinity = std::numeric_limits<double>::infinity();
  inline constexpr Range  any_number{};
  inline constexpr Range  positive{0., infinity, true, false, "be positive"};
  inline constexpr Range  not_negative{0., infinity, false, false, "not be negative"};
  inline constexpr Range  at_least_one{1., infinity, false, false, "be at least 1"};

  /// What a number means: its unit and what is allowed.
  struct NumberRule
  {
    std::string_view unit; ///< empty: a pure number
    Range            range = any_number;
    Need             need  = Need::optional;
  };

  /// Every entry that is asked for becomes a known key. Problems are collected; `finish` reports an unknown key first,
  /// because a misspelt key explains a missing one.
  class TomlTable
  {
  public:
    TomlTable(const TomlDocument &document, std::string path);

    /// False when the document has no such table: then every entry is absent.
    bool present() const { return table_ != nullptr; }
    bool has(const std::string &key) const { return present() && table_->contains(key); }

    void number(const std::string &key, const NumberRule &rule, double &target);
    void number(const std::string &key, const NumberRule &rule, std::optional<double> &target);
    /// An array of two numbers.
    void pair(const std::string &key, const NumberRule &rule, std::array<double, 2> &target);
    /// An array, not empty, of arrays of two numbers.
    void pairs(const std::string &key, const NumberRule &rule, std::vector<std::array<double, 2>> &target);
    /// Of three.
    void triple(const std::string &key, const NumberRule &rule, std::array<double, 3> &target);
    void integer(const std::string &key, const NumberRule &rule, int &target);
    /// A whole number, or an array of at least one.
    void integers(const std::string &key, const NumberRule &rule, std::vector<int> &target);
    void flag(const std::string &key, bool &target, Need need = Need::optional);
    void text(const std::string &key, std::string &target, Need need = Need::optional);
    /// Declare a sub-table, to be read by a TomlTable of its own.
    void table(const std::string &key);
    /// One of the words of Names<Enum> (datasets/scene/scene_names.h).
    template <typename Enum, typename List>
    void choice(const std::string &key, const Need need, const List &names, Enum &target)
    {
      std::vector<std::string> words;
      for (const auto &[word, value] : names)
        words.emplace_back(word);
      if (const auto index = choose(key, need, words))
        target = names[*index].second;
    }

    /// One of `words`.
    void word(const std::string &key, Need need, const std::vector<std::string> &words, std::string &target);

    /// An array, perhaps empty, of some of `words`, each once.
    void words(const std::string &key, Need need, const std::vector<std::string> &words,
               std::vector<std::string> &target);
    /// Whether the entry is there and is an array.
    bool is_array(const std::string &key) const { return has(key) && table_->get(key)->is_array(); }
    /// Of that array; zero for anything else.
    std::size_t array_size(const std::string &key) const
    {
      return is_array(key) ? table_->get(key)->as_array()->size() : 0;
    }

    /// A problem of our own with an entry: a sentence that follows `key = value`.
    void note(const std::string &key, const std::string &problem);

    /// Throw InputError for the first unknown key, else for the first other problem.
    void finish() const;
    /// All of them, unknown keys first.
    std::vector<std::string> problems() const;

  private:
    void                  list(const std::string &key, const NumberRule &rule, const std::string &shape, double *target,
                               std::size_t size);
    const toml::node     *entry(const std::string &key, Need need, const std::string &expected);
    std::optional<double> read_number(const std::string &key, const toml::node &node, const NumberRule &rule);
    std::optional<std::size_t> choose(const std::string &key, Need need, const std::vector<std::string> &words);
    std::optional<int>         read_integer(const std::string &key, const toml::node &node, const NumberRule &rule);
    std::string                advice_for(const std::string &unknown, const toml::node &node) const;
    void                       wrong_type(const std::string &key, const std::string &expected);

    const TomlDocument      &document_;
    std::string              path_;
    const toml::table       *table_ = nullptr;
    std::vector<std::string> known_, problems_;
  };
} // namespace swimtwin
