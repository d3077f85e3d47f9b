#include <datasets/system/error.h>
#include <datasets/text/toml_document.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

namespace swimtwin
{
  namespace
  {
    std::vector<std::string> split_path(const std::string &path)
    {
      std::vector<std::string> keys;
      std::istringstream       stream(path);
      for (std::string key; std::getline(stream, key, '.');)
        keys.push_back(key);
      return keys;
    }

    std::string parent_path(const std::string &path)
    {
      const auto dot = path.rfind('.');
      return dot == std::string::npos ? std::string() : path.substr(0, dot);
    }

    /// A value as a user would write it: numbers with as many digits as they need.
    std::string print_value(const toml::node &node)
    {
      if (const auto *number = node.as_floating_point())
        return fmt::format("{}", number->get());
      if (const auto *word = node.as_string())
        return fmt::format("\"{}\"", word->get());
      if (const toml::array *array = node.as_array())
      {
        std::vector<std::string> elements;
        for (const toml::node &element : *array)
          elements.push_back(print_value(element));
        return fmt::format("[{}]", fmt::join(elements, ", "));
      }
      std::ostringstream stream;
      node.visit([&](const auto &value) { stream << value; });
      return stream.str();
    }

    const toml::node *child_of(const toml::node &node, const std::string &key)
    {
      if (const toml::table *table = node.as_table())
        return table->get(key);
      std::size_t        index      = 0;
      const char        *end        = key.data() + key.size();
      const auto         conversion = std::from_chars(key.data(), end, index);
      const toml::array *array      = node.as_array();
      return array != nullptr && conversion.ptr == end ? array->get(index) : nullptr;
    }

    toml::table parse_toml(const std::string_view text, const std::string &name)
    {
      try
      {
        return toml::parse(text, std::string_view(name));
      }
      catch (const toml::parse_error &error)
      {
        std::string description(error.description());
        if (description.ends_with('.'))
          description.pop_back();
        throw InputError(fmt::format("{}:{}:{}: this is not valid TOML: {}.", name, error.source().begin.line,
                                     error.source().begin.column, description));
      }
    }

    /// A table with the single entry `value`: what the text says in TOML, or the text itself as a string.
    toml::table parse_override_value(const std::string &text)
    {
      try
      {
        toml::table parsed = toml::parse("value = " + text);
        if (parsed.size() == 1)
          return parsed;
      }
      catch (const toml::parse_error &)
      {
        // a bare word
      }
      return toml::table{{"value", text}};
    }
  } // namespace

  std::string join_path(const std::string &table, const std::string &key)
  {
    return table.empty() ? key : table + "." + key;
  }

  TomlDocument::TomlDocument(const std::string_view text, std::string name, const std::vector<std::string> &overrides)
      : name_(std::move(name)), root_(parse_toml(text, name_))
  {
    for (const std::string &text_of_override : overrides)
      apply_override(text_of_override);
  }

  void TomlDocument::apply_override(const std::string &override_text)
  {
    const auto                     equals = override_text.find('=');
    const std::string              path   = override_text.substr(0, equals);
    const std::vector<std::string> keys   = split_path(path);
    const bool                     empty_key =
        keys.empty() || path.ends_with('.') || std::find(keys.begin(), keys.end(), std::string()) != keys.end();
    if (equals == std::string::npos || empty_key)
      throw InputError(
          fmt::format("--set {}: an override reads key.path=value, such as time.periods=3.", override_text));

    toml::table *table = &root_;
    for (std::size_t i = 0; i + 1 < keys.size(); ++i)
    {
      if (!table->contains(keys[i]))
        table->insert(keys[i], toml::table());
      table = table->get(keys[i])->as_table();
      if (table == nullptr)
        throw InputError(fmt::format("--set {}: {} is not a table and holds no entries.", override_text, keys[i]));
    }
    toml::table parsed = parse_override_value(override_text.substr(equals + 1));
    parsed.get("value")->visit([&](auto &value) { table->insert_or_assign(keys.back(), std::move(value)); });
    overrides_[path] = "--set " + override_text;
  }

  void TomlDocument::merge(const toml::table &entries, toml::table &target, const std::string &path)
  {
    for (const auto &[key, value] : entries)
    {
      const std::string name(key.str()), entry = join_path(path, name);
      toml::node       *existing = target.get(name);
      if (value.is_table() && existing != nullptr && existing->is_table())
        merge(*value.as_table(), *existing->as_table(), entry);
      else if (!overrides_.contains(entry))
        value.visit([&](const auto &content) { target.insert_or_assign(name, content); });
    }
  }

  void TomlDocument::apply_variant()
  {
    const toml::node *variants = find("variants"), *chosen = find("variant");
    if (chosen != nullptr)
    {
      const toml::table       *tables = variants == nullptr ? nullptr : variants->as_table();
      const std::string        name   = chosen->value_or<std::string>("");
      std::vector<std::string> names;
      if (tables != nullptr)
        for (const auto &[key, value] : *tables)
          names.push_back(fmt::format("\"{}\"", key.str()));
      const toml::node *entries = tables == nullptr ? nullptr : tables->get(name);
      if (entries == nullptr || !entries->is_table())
        refuse("", "variant",
               names.empty() ? std::string("is not known: there is no table [variants]; remove it.")
                             : fmt::format("is not one of {}.", fmt::join(names, ", ")));
      merge(*entries->as_table(), root_, "");
    }
    root_.erase("variants");
    root_.erase("variant");
  }

  const toml::node *TomlDocument::find(const std::string &path) const
  {
    const toml::node *node = &root_;
    for (const std::string &key : split_path(path))
    {
      node = child_of(*node, key);
      if (node == nullptr)
        return nullptr;
    }
    return node;
  }

  void TomlDocument::set_text(const std::string &table, const std::string &key, const std::string &value)
  {
    root_.get(table)->as_table()->insert_or_assign(key, value);
  }

  void TomlDocument::set_number(const std::string &table, const std::string &key, const double value)
  {
    root_.get(table)->as_table()->insert_or_assign(key, value);
  }

  std::string TomlDocument::text() const
  {
    std::ostringstream stream;
    stream << root_ << "\n";
    return stream.str();
  }

  std::string TomlDocument::where(const std::string &path) const
  {
    for (std::string ancestor = path; !ancestor.empty(); ancestor = parent_path(ancestor))
      if (const auto found = overrides_.find(ancestor); found != overrides_.end())
        return found->second;
    // What is wrong with a table as a whole is most likely what was overridden in it.
    if (const toml::node *node = find(path); node != nullptr && node->is_table())
      for (const auto &[overridden, text] : overrides_)
        if (overridden.starts_with(path + "."))
          return text;
    for (std::string ancestor = path; !ancestor.empty(); ancestor = parent_path(ancestor))
      if (const toml::node *node = find(ancestor); node != nullptr && node->source().begin.line > 0)
        return fmt::format("{}:{}", name_, node->source().begin.line);
    return name_;
  }

  std::string TomlDocument::sentence(const std::string &table, const std::string &key, const std::string &problem) const
  {
    const std::string path  = join_path(table, key);
    const toml::node *node  = key.empty() ? nullptr : find(path);
    const std::string value = node == nullptr || node->is_table() ? "" : fmt::format(" = {}", print_value(*node));
    std::string       entry = table.empty() ? key : fmt::format("[{}]{}{}", table, key.empty() ? "" : " ", key);
    if (node != nullptr && node->is_table())
      entry = fmt::format("[{}]", path);
    return fmt::format("{}: {}{} {}", where(key.empty() ? table : path), entry, value, problem);
  }

  void TomlDocument::refuse(const std::string &table, const std::string &key, const std::string &problem) const
  {
    throw InputError(sentence(table, key, problem));
  }
} // namespace swimtwin
