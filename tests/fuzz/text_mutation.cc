#include <tests/fuzz/text_mutation.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace swimtwin
{
  namespace
  {
    struct Span
    {
      std::size_t begin = 0, size = 0;
    };

    using Spans = std::vector<Span>;

    /// Numbers and words, as a parser sees them.
    bool belongs_to_token(const char c)
    {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' || c == '+' || c == '-';
    }

    Spans tokens_of(const std::string &text)
    {
      Spans tokens;
      for (std::size_t i = 0; i < text.size(); ++i)
      {
        if (!belongs_to_token(text[i]))
          continue;
        if (i == 0 || !belongs_to_token(text[i - 1]))
          tokens.push_back({i, 0});
        ++tokens.back().size;
      }
      return tokens;
    }

    Spans lines_of(const std::string &text)
    {
      Spans lines;
      for (std::size_t begin = 0; begin < text.size();)
      {
        const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
        lines.push_back({begin, end - begin});
        begin = end;
      }
      return lines;
    }

    Span random_span(const std::string &text, RandomNumbers &random)
    {
      const std::size_t begin = pick(random, text.size() + 1);
      return {begin, std::min(pick(random, 40), text.size() - begin)};
    }

    /// Where numbers, texts and brackets end to be harmless.
    std::string extreme_token(RandomNumbers &random)
    {
      static const std::array<const char *, 40> tokens = {"0",
                                                          "-1",
                                                          "-0",
                                                          "1e999",
                                                          "-1e308",
                                                          "1e-320",
                                                          "5e-324",
                                                          "nan",
                                                          "inf",
                                                          "-inf",
                                                          "2147483648",
                                                          "-2147483649",
                                                          "9223372036854775807",
                                                          "18446744073709551616",
                                                          "1e",
                                                          "0x10",
                                                          "0b1",
                                                          "1_000",
                                                          "1,5",
                                                          "1.2.3",
                                                          "true",
                                                          "\"\"",
                                                          "''",
                                                          "[]",
                                                          "{}",
                                                          "[[]]",
                                                          "null",
                                                          "[0]",
                                                          "[1e400, 1]",
                                                          "{a=1}",
                                                          "1979-05-27",
                                                          "07:32:00",
                                                          "\\u0000",
                                                          "\"\\ud800\"",
                                                          "\xEF\xBB\xBF",
                                                          "\xC3\xA9",
                                                          "\xFF\xFE",
                                                          "%s%n",
                                                          "../..",
                                                          "#"};
      switch (pick(random, 12))
      {
      case 0:
        return std::string(1 + pick(random, 20000), "9x[{\"("[pick(random, 6)]);
      case 1:
        return std::string(1, static_cast<char>(pick(random, 256)));
      default:
        return pick_from(random, tokens);
      }
    }

    void change_bytes(std::string &text, RandomNumbers &random)
    {
      static const std::string telling = "\"'[]{}(),;:=#.-+\t\r\n\\|";
      for (std::size_t n = 1 + pick(random, 4); n > 0 && !text.empty(); --n)
      {
        char &byte = pick_from(random, text);
        switch (pick(random, 3))
        {
        case 0:
          byte = static_cast<char>(byte ^ (1 << pick(random, 8)));
          break;
        case 1:
          byte = static_cast<char>(pick(random, 256));
          break;
        default:
          byte = pick_from(random, telling);
        }
      }
    }

    void change_a_part(std::string &text, const Span &part, RandomNumbers &random)
    {
      const std::string content = text.substr(part.begin, part.size);
      switch (pick(random, 4))
      {
      case 0:
        text.erase(part.begin, part.size);
        break;
      case 1:
        text.insert(part.begin, content);
        break;
      case 2: // moved
        text.erase(part.begin, part.size);
        text.insert(pick(random, text.size() + 1), content);
        break;
      default: // many times
        for (std::size_t n = pick(random, 200); n > 0 && text.size() < 200000; --n)
          text.insert(part.begin, content);
      }
    }

    void change_a_token(std::string &text, RandomNumbers &random)
    {
      const Spans tokens = tokens_of(text);
      if (tokens.empty())
        return;
      const Span &token = pick_from(random, tokens), &other = pick_from(random, tokens);
      if (pick(random, 3) == 0)
        text.replace(token.begin, token.size, text.substr(other.begin, other.size));
      else
        text.replace(token.begin, token.size, extreme_token(random));
    }

    void cut(std::string &text, RandomNumbers &random)
    {
      const std::size_t here = pick(random, text.size() + 1);
      text                   = pick(random, 3) == 0 ? text.substr(here) : text.substr(0, here);
    }

    void splice(std::string &text, const std::string &other, RandomNumbers &random)
    {
      text = text.substr(0, pick(random, text.size() + 1)) + other.substr(pick(random, other.size() + 1));
    }

    /// As another system would have saved it.
    void encode_otherwise(std::string &text, RandomNumbers &random)
    {
      std::string wide = pick(random, 2) == 0 ? "\xFF\xFE" : "\xFE\xFF";
      const bool  low  = wide[0] == '\xFF';
      for (const char c : text)
        wide += low ? std::string{c, '\0'} : std::string{'\0', c};
      text = wide;
    }
  } // namespace

  std::size_t pick(RandomNumbers &random, const std::size_t n)
  {
    return random() % n;
  }

  std::string mutated_text(const std::vector<std::string> &seeds, RandomNumbers &random)
  {
    std::string text = pick_from(random, seeds);
    for (std::size_t n = 1 + pick(random, 4); n > 0; --n)
    {
      const std::size_t kind  = pick(random, 20);
      const Spans       lines = kind == 9 ? lines_of(text) : Spans();
      if (kind < 4)
        change_bytes(text, random);
      else if (kind < 7)
        change_a_part(text, random_span(text, random), random);
      else if (kind == 8)
        cut(text, random);
      else if (kind == 9 && !lines.empty())
        change_a_part(text, pick_from(random, lines), random);
      else if (kind == 10)
        splice(text, pick_from(random, seeds), random);
      else if (kind == 11 && pick(random, 4) == 0)
        encode_otherwise(text, random);
      else
        change_a_token(text, random);
    }
    return text;
  }
} // namespace swimtwin
