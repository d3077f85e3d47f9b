// An example with one part changed.
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace swimtwin
{
  inline std::string replaced(std::string text, const std::string &what, const std::string &by)
  {
    const auto place = text.find(what);
    EXPECT_NE(place, std::string::npos) << what;
    return text.replace(place, what.size(), by);
  }
} // namespace swimtwin
