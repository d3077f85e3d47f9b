// A folder that lives as long as a test.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace swimtwin
{
  class TemporaryFolder
  {
  public:
    TemporaryFolder()
    {
      std::string name = (std::filesystem::temp_directory_path() / "swimtwin-test-XXXXXX").string();
      if (mkdtemp(name.data()) == nullptr)
        ADD_FAILURE() << "no temporary folder";
      path = name;
    }
    TemporaryFolder(const TemporaryFolder &)            = delete;
    TemporaryFolder &operator=(const TemporaryFolder &) = delete;
    ~TemporaryFolder()
    {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }

    std::filesystem::path write(const std::string &name, const std::string &text) const
    {
      std::ofstream(path / name) << text;
      return path / name;
    }

    std::filesystem::path path;
  };

  inline std::string content(const std::filesystem::path &file)
  {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }

  inline std::size_t n_files(const std::filesystem::path &folder)
  {
    const auto begin = std::filesystem::directory_iterator(folder);
    return static_cast<std::size_t>(std::distance(begin, std::filesystem::directory_iterator()));
  }

  /// what() of the Error that `action` must throw.
  template <typename Error, typename Action>
  std::string message_of(const Action &action)
  {
    try
    {
      action();
    }
    catch (const Error &error)
    {
      return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
  }

  inline void expect_in(const std::string &message, const std::string &part)
  {
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << message;
  }
} // namespace swimtwin
