#include <app/frame/command_words.h>

#include <datasets/system/error.h>
#include <datasets/system/nearest_name.h>
#include <datasets/text/toml_table.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>

namespace swimtwin
{
  namespace
  {
    using Words = std::vector<std::string>;

    bool is_blank(const std::string &word)
    {
      return std::all_of(word.begin(), word.end(), [](const unsigned char c) { return std::isspace(c) != 0; });
    }

    /// "-1e-3" and "-.5:2:7" are values; "-x" and "--force" are not.
    bool looks_like_option(const std::string &word)
    {
      return word.size() > 1 && word[0] == '-' && std::isdigit(static_cast<unsigned char>(word[1])) == 0 &&
             word[1] != '.';
    }

    Words option_names(const CLI::App &app)
    {
      Words names;
      for (const CLI::Option *option : app.get_options())
        for (const std::string &name : option->get_lnames())
          names.push_back("--" + name);
      return names;
    }

    Words verb_names(const CLI::App &tool)
    {
      Words names;
      for (const CLI::App *verb : tool.get_subcommands({}))
        names.push_back(verb->get_name());
      return names;
    }

    const CLI::Option *find_option(const CLI::App &app, const std::string &name)
    {
      for (const CLI::Option *option : app.get_options())
        if (!option->get_positional() && option->check_name(name))
          return option;
      return nullptr;
    }

    /// Looks at the words of one verb, from left to right.
    class VerbWords
    {
    public:
      VerbWords(const CLI::App &verb, const Words &words) : verb_(verb), words_(words) {}

      void check()
      {
        bool only_values = false; // after "--"
        for (at_ = 1; at_ < words_.size(); ++at_)
          if (!only_values && words_[at_] == "--")
            only_values = true;
          else if (!only_values && looks_like_option(words_[at_]))
            check_option();
          else
            check_positional(words_[at_]);
      }

    private:
      [[noreturn]] void refuse(const std::string &why) const
      {
        throw InputError(fmt::format("{}; see swimtwin {} --help", why, verb_.get_name()));
      }

      void check_option()
      {
        const std::string &word   = words_[at_];
        const auto         sign   = word.find('=');
        const std::string  name   = word.substr(0, sign);
        const CLI::Option *option = find_option(verb_, name);
        if (option == nullptr)
          refuse(fmt::format("{} has no option {}; the nearest is {}", verb_.get_name(), name,
                             nearest_name(name, option_names(verb_))));
        if (option->get_expected_max() == 0)
          return check_flag(name, sign != std::string::npos);
        if (sign != std::string::npos)
          return note_value(*option, name, word.substr(sign + 1));
        if (at_ + 1 == words_.size())
          refuse(fmt::format("{} is the last word; write its value behind it", name));
        const std::string &value = words_[++at_];
        if (looks_like_option(value))
          refuse(fmt::format("{} is followed by {}, which is no value; write {}=VALUE if it is meant as one", name,
                             value, name));
        note_value(*option, name, value);
        skip_further_values(*option, name);
      }

      void check_flag(const std::string &name, const bool has_value) const
      {
        if (has_value)
          refuse(fmt::format("{} takes no value; write it alone, or leave it out", name));
      }

      void note_value(const CLI::Option &option, const std::string &name, const std::string &value)
      {
        if (is_blank(value))
          refuse(fmt::format("{} \"\": a value is missing; give one, or leave {} out", name, name));
        const auto [earlier, is_first] = values_.emplace(&option, value);
        if (!is_first && option.get_expected_max() == 1)
          refuse(fmt::format("{} is given twice, as {} and as {}; it takes one value", name, earlier->second, value));
      }

      /// Some options take all words that follow.
      void skip_further_values(const CLI::Option &option, const std::string &name)
      {
        while (option.get_allow_extra_args() && option.get_expected_max() > 1 && at_ + 1 < words_.size() &&
               !looks_like_option(words_[at_ + 1]))
          note_value(option, name, words_[++at_]);
      }

      void check_positional(const std::string &word)
      {
        Words names;
        bool  takes_more = false;
        for (const CLI::Option *option : verb_.get_options())
          if (option->get_positional())
          {
            names.push_back(option->get_name(true));
            takes_more = takes_more || option->get_expected_max() > 1;
          }
        if (is_blank(word))
          refuse(fmt::format("a word is empty; {} takes {}", verb_.get_name(), fmt::join(names, " and ")));
        if (n_positionals_++ >= names.size() && !takes_more)
          refuse(fmt::format("\"{}\" is a word too many; {} takes {} (quote a name that has spaces)", word,
                             verb_.get_name(), fmt::join(names, " and ")));
      }

      const CLI::App                            &verb_;
      const Words                               &words_;
      std::size_t                                at_ = 0, n_positionals_ = 0;
      std::map<const CLI::Option *, std::string> values_; ///< of options that were given, the first one
    };

    [[noreturn]] void refuse_verb(const CLI::App &tool, const std::string &word)
    {
      const Words verbs = verb_names(tool);
      if (is_blank(word))
        throw InputError(
            fmt::format("the verb is empty; it is one of {}; see swimtwin --help", fmt::join(verbs, ", ")));
      throw InputError(
          fmt::format("there is no verb {}; the nearest is {}; see swimtwin --help", word, nearest_name(word, verbs)));
    }
  } // namespace

  void check_command_words(const CLI::App &tool, const Words &words)
  {
    if (words.empty())
      throw InputError(fmt::format("a verb is missing: {}; see swimtwin --help", fmt::join(verb_names(tool), ", ")));
    const std::string &first = words.front();
    if (!first.empty() && first[0] == '-')
    {
      if (find_option(tool, first) != nullptr)
        return; // --help or --version: whatever follows does not matter
      throw InputError(fmt::format("{} stands where the verb belongs; begin with one of {}; see swimtwin --help", first,
                                   fmt::join(verb_names(tool), ", ")));
    }
    for (const CLI::App *verb : tool.get_subcommands({}))
      if (verb->get_name() == first)
        return VerbWords(*verb, words).check();
    refuse_verb(tool, first);
  }
} // namespace swimtwin
