// Lines of a small laboratory, and a configuration that fits them.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/twin/open_swimmer.h>
#include <twin/lab/lab_run.h>
#include <twin/run/twin_session.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace swimtwin
{
  inline std::filesystem::path written(const TemporaryFolder &folder, const char *name, const std::string &text)
  {
    std::ofstream(folder.path / name) << text;
    return folder.path / name;
  }

  inline std::vector<std::string> lab_lines(const ReducedModel &model, const std::string &toml)
  {
    const TemporaryFolder    folder;
    std::vector<std::string> lines;
    run_laboratory(model, read_lab_config(written(folder, "lab.toml", toml), model),
                   {[&](double, const std::string &line) {
                     lines.push_back(line);
                     return true;
                   }});
    return lines;
  }

  inline TwinConfig twin_config(const ReducedModel &model, const std::string &toml)
  {
    const TemporaryFolder folder;
    return read_twin_config(written(folder, "twin.toml", toml), model);
  }

  inline constexpr const char *short_lab  = "duration_s = 6\n[coils]\nbx_T = 4e-3\nby_T = 4e-3\nfrequency_Hz = 0.8\n";
  inline constexpr const char *plain_twin = "[field]\nbx_T = 4e-3\nby_T = 4e-3\nfrequency_Hz = 0.8\n";

  inline std::vector<nlohmann::json> lines_of_type(const std::vector<nlohmann::json> &lines, const std::string &type)
  {
    std::vector<nlohmann::json> found;
    std::copy_if(lines.begin(), lines.end(), std::back_inserter(found),
                 [&](const nlohmann::json &line) { return line["type"] == type; });
    return found;
  }

  /// A session whose answers are kept.
  struct KeptSession
  {
    std::vector<nlohmann::json> answers;
    std::vector<EstimateRecord> estimates;
    TwinSession                 session;

    KeptSession(const ReducedModel &model, const TwinConfig &config)
        : session(model, config,
                  {[this](const std::string &line) { answers.push_back(nlohmann::json::parse(line)); },
                   [this](const EstimateRecord &record) { estimates.push_back(record); }})
    {
    }

    void take_all(const std::vector<std::string> &lines)
    {
      for (const std::string &line : lines)
        session.take(line);
    }
    std::vector<nlohmann::json> of_type(const std::string &type) const { return lines_of_type(answers, type); }
    std::vector<std::string>    alarms() const
    {
      std::vector<std::string> names;
      for (const nlohmann::json &alarm : of_type("alarm"))
        if (!alarm["over"])
          names.push_back(alarm["name"]);
      return names;
    }
  };
} // namespace swimtwin
