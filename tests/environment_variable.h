// A variable of the environment for the time of a test.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace swimtwin
{
  class EnvironmentVariable
  {
  public:
    /// Without a value it is not set.
    EnvironmentVariable(const char *name, const char *value) : name_(name)
    {
      if (const char *before = std::getenv(name))
        before_ = before;
      set(value);
    }
    EnvironmentVariable(const EnvironmentVariable &)            = delete;
    EnvironmentVariable &operator=(const EnvironmentVariable &) = delete;
    ~EnvironmentVariable() { set(before_ ? before_->c_str() : nullptr); }

  private:
    void set(const char *value) const
    {
      if (value == nullptr)
        unsetenv(name_);
      else
        setenv(name_, value, 1);
    }

    const char                *name_;
    std::optional<std::string> before_;
  };
} // namespace swimtwin
