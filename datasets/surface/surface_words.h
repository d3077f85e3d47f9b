// The words of a text that holds a surface, with the lines they stand in.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace swimtwin
{
  class SurfaceWords
  {
  public:
    /// Both must outlive this.
    SurfaceWords(const std::filesystem::path &file, std::string_view text) : file_(file), text_(text) {}

    /// The next word between blanks; empty at the end.
    std::string_view next();
    /// The next word, which must be this one (in small or capital letters).
    void expect(std::string_view word);
    /// Throw InputError if there is none, or it is not that: numbers have a point and are finite.
    double    number();
    long long integer();
    /// A text in quotes, which may hold blanks.
    std::string quoted();
    void        skip_line();

    /// Throw InputError: `<file>, line <n>: <cause>`.
    [[noreturn]] void refuse(const std::string &cause) const;

  private:
    std::string_view needed();

    const std::filesystem::path &file_;
    std::string_view             text_;
    std::size_t                  at_ = 0, line_ = 1;
  };

  bool equal_but_for_case(std::string_view a, std::string_view b);
} // namespace swimtwin
