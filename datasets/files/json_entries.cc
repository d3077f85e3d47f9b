#include <datasets/files/input_file.h>
#include <datasets/files/json_entries.h>
#include <datasets/files/output_folder.h>

#include <cmath>
#include <limits>

namespace swimtwin
{
  Json json_of(const double value)
  {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
  }

  Json json_of(const std::string &text)
  {
    return text;
  }

  Json json_of(const NamedNumbers &values)
  {
    Json object = Json::object();
    for (const auto &[key, value] : values)
      object[key] = json_of(value);
    return object;
  }

  Json json_of(const std::map<std::string, double> &values)
  {
    return json_of(NamedNumbers(values.begin(), values.end()));
  }

  Json json_of(const Eigen::VectorXd &values)
  {
    return json_of(std::vector<double>(values.begin(), values.end()));
  }

  Json json_of(const Eigen::MatrixXd &rows)
  {
    Json array = Json::array();
    for (const auto row : rows.rowwise())
      array.push_back(json_of(Eigen::VectorXd(row)));
    return array;
  }

  void read_json(const Json &json, double &value)
  {
    value = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
  }

  void read_json(const Json &json, std::string &text)
  {
    text = json.get<std::string>();
  }

  void read_json(const Json &json, NamedNumbers &values)
  {
    values.clear();
    for (const auto &[key, value] : json.get_ref<const Json::object_t &>())
      read_json(value, values.emplace_back(key, 0.).second);
  }

  void read_json(const Json &json, std::map<std::string, double> &values)
  {
    NamedNumbers list;
    read_json(json, list);
    values = {list.begin(), list.end()};
  }

  void read_json(const Json &json, Eigen::VectorXd &values)
  {
    std::vector<double> list;
    read_json(json, list);
    values = Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
  }

  void read_json(const Json &json, Eigen::MatrixXd &rows)
  {
    std::vector<Eigen::VectorXd> list;
    read_json(json, list);
    rows.resize(static_cast<Eigen::Index>(list.size()), list.empty() ? 0 : list.front().size());
    for (std::size_t i = 0; i < list.size(); ++i)
    {
      if (list[i].size() != rows.cols())
        throw InputError("has rows of different lengths");
      rows.row(static_cast<Eigen::Index>(i)) = list[i];
    }
  }

  Json read_json_file(const std::filesystem::path &file, const std::string &what, const std::string &remedy)
  {
    const std::string text = read_text_file(file, what);
    try
    {
      return Json::parse(text);
    }
    catch (const Json::parse_error &error)
    {
      const bool at_end = error.byte > text.size(); // the parser asked for more than there is
      throw InputError(fmt::format("{} {}; {}.", file.string(),
                                   at_end ? "was cut short: it ends in the middle of its JSON"
                                          : fmt::format("is not JSON (byte {} of {})", error.byte, text.size()),
                                   remedy));
    }
    catch (const Json::exception &) // out_of_range: 1e999
    {
      throw InputError(fmt::format("{} holds a number that is too large to be read; {}.", file.string(), remedy));
    }
  }

  void write_json_file(const std::filesystem::path &file, const Json &json)
  {
    write_text_atomically(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  }
} // namespace swimtwin
