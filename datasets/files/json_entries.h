// Structs as JSON objects, and back: one list of keys per struct serves both directions.
//
// The list of a struct is
//
//     template <Like<Struct> Type, typename Visitor>
//     void for_each_entry(Type &v, const Visitor &visit)
//     {
//       visit("key_unit", v.key_unit);
//     }
//
// in namespace swimtwin itself: it is found by its argument, which a nameless namespace would hide.
#pragma once

#include <datasets/system/error.h>
#include <datasets/system/provenance.h>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace swimtwin
{
  using Json = nlohmann::ordered_json;

  /// Struct, or const Struct.
  template <typename Type, typename Struct>
  concept Like = std::same_as<std::remove_const_t<Type>, Struct>;

  template <Like<Provenance> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("program_version", v.program_version);
    visit("command_line", v.command_line);
    visit("scene_text", v.scene_text);
    visit("scene_hash", v.scene_hash);
    visit("created", v.created);
    visit("wall_time_s", v.wall_time_s);
  }

  template <typename Type>
  concept HasEntries = requires(Type &value)
  {
    for_each_entry(value, [](const char *, const auto &) {});
  };

  /// An object whose keys are data, in their order.
  using NamedNumbers = std::vector<std::pair<std::string, double>>;

  /// Numbers that are not finite, and what an optional lacks, become null. A matrix is an array of its rows.
  Json json_of(double value);
  Json json_of(const std::string &text);
  Json json_of(const NamedNumbers &values);
  Json json_of(const std::map<std::string, double> &values);
  Json json_of(const Eigen::VectorXd &values);
  Json json_of(const Eigen::MatrixXd &rows);
  template <std::integral Type>
  Json json_of(const Type value)
  {
    return value;
  }
  template <HasEntries Type>
  Json json_of(const Type &value);
  template <typename Type>
  Json json_of(const std::optional<Type> &value);
  template <typename Type>
  Json json_of(const std::vector<Type> &values)
  {
    Json array = Json::array();
    for (const Type &value : values)
      array.push_back(json_of(value));
    return array;
  }
  template <typename Type>
  Json json_of(const std::optional<Type> &value)
  {
    return value ? json_of(*value) : Json(nullptr);
  }
  template <HasEntries Type>
  Json json_of(const Type &value)
  {
    Json object = Json::object();
    for_each_entry(value, [&object](const char *key, const auto &member) { object[key] = json_of(member); });
    return object;
  }

  /// The way back. Throws InputError that says what an object lacks or has of the wrong kind, without a subject: "lacks
  /// the entry status", "has an entry status of the wrong kind"; outside objects, nlohmann's exception.
  template <std::integral Type>
  Type whole_number(const Json &json)
  {
    const double number = json.get<double>(); // throws for what is none
    bool         fits   = false;
    if (json.is_number_unsigned())
      fits = std::in_range<Type>(json.get<std::uint64_t>());
    else if (json.is_number_integer())
      fits = std::in_range<Type>(json.get<std::int64_t>());
    else // in half of the range: the other half is beyond what a double tells apart
      fits = number == std::floor(number) &&
             std::abs(number) <= static_cast<double>(std::numeric_limits<Type>::max() / 2) &&
             (number >= 0. || std::signed_integral<Type>);
    if (!fits)
      throw InputError("has a number that is not whole, or too large, where a count is needed");
    return json.get<Type>();
  }

  void read_json(const Json &json, double &value);
  void read_json(const Json &json, std::string &text);
  void read_json(const Json &json, NamedNumbers &values);
  void read_json(const Json &json, std::map<std::string, double> &values);
  void read_json(const Json &json, Eigen::VectorXd &values);
  void read_json(const Json &json, Eigen::MatrixXd &rows);
  /// A whole number that the type holds.
  template <std::integral Type>
  void read_json(const Json &json, Type &value)
  {
    if constexpr (std::same_as<Type, bool>)
      value = json.get<bool>();
    else
      value = whole_number<Type>(json);
  }
  template <HasEntries Type>
  void read_json(const Json &json, Type &value);
  template <typename Type>
  void read_json(const Json &json, std::optional<Type> &value);
  template <typename Type>
  void read_json(const Json &json, std::vector<Type> &values)
  {
    values.clear();
    for (const Json &entry : json.get_ref<const Json::array_t &>())
      read_json(entry, values.emplace_back());
  }
  template <typename Type>
  void read_json(const Json &json, std::optional<Type> &value)
  {
    value.reset();
    if (!json.is_null())
      read_json(json, value.emplace());
  }
  template <typename Type>
  void read_entry(const Json &json, const char *key, Type &value)
  {
    if (!json.is_object() || !json.contains(key))
      throw InputError(fmt::format("lacks the entry {}", key));
    try
    {
      read_json(json.at(key), value);
    }
    catch (const Json::exception &)
    {
      throw InputError(fmt::format("has an entry {} of the wrong kind", key));
    }
  }
  template <HasEntries Type>
  void read_json(const Json &json, Type &value)
  {
    for_each_entry(value, [&json](const char *key, auto &member) { read_entry(json, key, member); });
  }

  /// `what` and `remedy` are for the InputError: "the summary", "simulate again". Told apart are what read_text_file
  /// does, JSON that was cut short, and what is not JSON.
  Json read_json_file(const std::filesystem::path &file, const std::string &what, const std::string &remedy);

  /// Indented; bytes that are not UTF-8 are replaced. Written to a temporary name, then renamed.
  void write_json_file(const std::filesystem::path &file, const Json &json);
} // namespace swimtwin
