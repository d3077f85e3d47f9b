// A TOML text with overrides applied, which remembers where every entry came from.
#pragma once

#include <toml++/toml.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace swimtwin
{
  class TomlDocument
  {
  public:
    /// `name` stands for the file in messages; overrides are "key.path=value" with a TOML value or a bare word. Throws
    /// InputError for text that is not TOML (with line and column) and for an override without a key or a place.
    TomlDocument(std::string_view text, std::string name, const std::vector<std::string> &overrides);

    /// A document may hold further sizes of itself: tables [variants.NAME] of entries that replace its own. The entry
    /// variant = "NAME" chooses one; overrides go before it. Both are gone afterwards. Throws InputError for an unknown
    /// name.
    void apply_variant();

    /// The entry at a dotted path, or nullptr; a number steps into an array. The empty path is the whole document.
    const toml::node *find(const std::string &path) const;
    /// Add or replace an entry of an existing table.
    void set_text(const std::string &table, const std::string &key, const std::string &value);
    void set_number(const std::string &table, const std::string &key, double value);

    /// The content after overrides, serialised: stable, without comments.
    std::string text() const;
    /// Where the entry (or, when it is absent, the closest table around it) was written: `scene.toml:12`,
    /// `--set time.periods=3`, or `scene.toml`.
    std::string where(const std::string &path) const;

    /// Throw InputError `<where>: [table] key = value <problem>`; the value is left out when the entry is absent.
    [[noreturn]] void refuse(const std::string &table, const std::string &key, const std::string &problem) const;
    /// The sentence of `refuse`.
    std::string sentence(const std::string &table, const std::string &key, const std::string &problem) const;

  private:
    void apply_override(const std::string &override_text);
    void merge(const toml::table &entries, toml::table &target, const std::string &path);

    std::string                        name_;
    toml::table                        root_;
    std::map<std::string, std::string> overrides_; // path -> text of the override
  };

  /// `table.key`, or `key` at the top level.
  std::string join_path(const std::string &table, const std::string &key);
} // namespace swimtwin
