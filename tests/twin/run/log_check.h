// That twin.h5 says what twin.csv says.
#pragma once

#include <datasets/files/hdf5_file.h>
#include <datasets/text/delimited_text.h>
#include <twin/watch/watchdog.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

namespace swimtwin
{
  /// Columns of a table without quoted cells.
  inline std::map<std::string, std::vector<std::string>> columns_of_table(const std::filesystem::path &file)
  {
    std::map<std::string, std::vector<std::string>> columns;
    std::ifstream                                   in(file);
    std::string                                     line;
    std::getline(in, line);
    const std::vector<std::string> names = split_cells(line, ',');
    for (const std::string &name : names)
      columns[name] = {};
    while (std::getline(in, line))
    {
      const std::vector<std::string> cells = split_cells(line, ',');
      EXPECT_EQ(cells.size(), names.size());
      for (std::size_t i = 0; i < std::min(cells.size(), names.size()); ++i)
        columns[names[i]].push_back(cells[i]);
    }
    return columns;
  }

  inline void expect_log_as_table(const std::filesystem::path &log, const std::filesystem::path &table)
  {
    const Hdf5Reader reader(log);
    for (const auto &[name, cells] : columns_of_table(table))
    {
      if (name == "flags")
      {
        std::size_t n_flags = 0, n_words = 0;
        for (const char *flag : watch_flags)
          for (const double is_on : reader.read_vector(fmt::format("/flag_{}", flag)))
            n_flags += is_on == 1. ? 1u : 0u;
        for (const std::string &words : cells)
          n_words += words.empty() ? 0u : 1u + static_cast<std::size_t>(std::count(words.begin(), words.end(), ';'));
        EXPECT_EQ(n_flags, n_words);
        continue;
      }
      const auto values = reader.read_vector("/" + name);
      EXPECT_FALSE(reader.read_text_attribute("/" + name, "units").empty()) << name;
      ASSERT_EQ(static_cast<std::size_t>(values.size()), cells.size()) << name;
      for (std::size_t i = 0; i < cells.size(); ++i)
        if (cells[i].empty())
          EXPECT_TRUE(std::isnan(values[i])) << name << " " << i;
        else
          EXPECT_EQ(values[i], std::stod(cells[i])) << name << " " << i;
    }
  }
} // namespace swimtwin
