#include <datasets/surface/stl_reader.h>

#include <datasets/files/input_file.h>
#include <datasets/surface/surface_words.h>
#include <datasets/text/text_line.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace swimtwin
{
  using Eigen::Vector3d;

  namespace
  {
    static_assert(std::endian::native == std::endian::little, "bytes of STL files are read as they are");

    constexpr std::size_t header_bytes = 80, start_bytes = 84, triangle_bytes = 50;

    template <typename T>
    T at(const std::string_view content, const std::size_t place)
    {
      T value;
      std::memcpy(&value, content.data() + place, sizeof value);
      return value;
    }

    void add_triangle(SurfaceSoup &soup, const std::array<Vector3d, 3> &corners)
    {
      const auto n = static_cast<unsigned int>(soup.points.size());
      soup.points.insert(soup.points.end(), corners.begin(), corners.end());
      soup.faces.push_back({n, n + 1, n + 2, 0, 0, 0});
      soup.patch_of_face.push_back(0);
    }

    std::size_t stated_bytes(const std::string_view content)
    {
      return start_bytes + triangle_bytes * std::size_t(at<std::uint32_t>(content, header_bytes));
    }

    /// Of any kind: bytes of triangles have zeros among them.
    bool is_text(const std::string_view content)
    {
      return content.substr(0, 4096).find('\0') == std::string_view::npos;
    }

    /// The first line of a text, or what a message has room for.
    std::string first_line(const std::string_view content)
    {
      return text_line(std::string(content.substr(0, std::min<std::size_t>(content.find_first_of("\r\n"), 40))));
    }

    SurfaceSoup read_bytes(const std::filesystem::path &file, const std::string_view content)
    {
      const std::size_t n = at<std::uint32_t>(content, header_bytes);
      if (content.size() < stated_bytes(content))
        refuse_file(
            file, "the surface",
            fmt::format("it is cut off, or no STL: after {} triangles in {} bytes, {} bytes were to come, and the "
                        "file has {}; copy or export it again",
                        n, triangle_bytes * n, stated_bytes(content), content.size()));
      SurfaceSoup soup;
      for (std::size_t t = 0; t < n && n <= n_faces_at_most; ++t)
      {
        std::array<Vector3d, 3> corners;
        for (std::size_t v = 0; v < 3; ++v)
          for (std::size_t c = 0; c < 3; ++c)
            corners[v][static_cast<int>(c)] =
                at<float>(content, start_bytes + triangle_bytes * t + 4 * (3 + 3 * v + c));
        for (const Vector3d &x : corners)
          if (!x.allFinite())
            refuse_file(
                file, "the surface",
                fmt::format("triangle {} has the corner ({}, {}, {}), which is no point; export the surface again",
                            t + 1, x[0], x[1], x[2]));
        add_triangle(soup, corners);
      }
      if (n > n_faces_at_most)
        soup.faces.resize(n); // to be refused for that
      return soup;
    }

    /// One facet after the word that begins it.
    std::array<Vector3d, 3> read_facet(SurfaceWords &words)
    {
      words.expect("normal");
      for (int c = 0; c < 3; ++c)
        words.next(); // some write nan there; corners say it better
      words.expect("outer");
      words.expect("loop");
      std::array<Vector3d, 3> corners;
      for (auto &x : corners)
      {
        words.expect("vertex");
        for (int c = 0; c < 3; ++c)
          x[c] = words.number();
      }
      words.expect("endloop");
      words.expect("endfacet");
      return corners;
    }

    SurfaceSoup read_text(const std::filesystem::path &file, const std::string_view content)
    {
      SurfaceSoup  soup;
      SurfaceWords words(file, content);
      for (std::string_view word = words.next(); !word.empty(); word = words.next())
      {
        if (!equal_but_for_case(word, "solid"))
          words.refuse(fmt::format("\"{}\" stands where a \"solid\" begins or the file ends; export the surface again",
                                   word.substr(0, 40)));
        words.skip_line(); // its name
        for (word = words.next(); !equal_but_for_case(word, "endsolid"); word = words.next())
        {
          if (word.empty())
            words.refuse("the file ends here without \"endsolid\": it is cut off; copy or export it again");
          if (!equal_but_for_case(word, "facet"))
            words.refuse(
                fmt::format("\"{}\" stands where a \"facet\" begins; export the surface again", word.substr(0, 40)));
          add_triangle(soup, read_facet(words));
        }
        words.skip_line();
      }
      return soup;
    }
  } // namespace

  SurfaceSoup read_stl(const std::filesystem::path &file, const std::string_view content)
  {
    const bool has_table = content.size() >= start_bytes;
    const bool is_exact  = has_table && content.size() == stated_bytes(content);
    const bool is_words  = !is_exact && is_text(content);
    if (is_words && !equal_but_for_case(SurfaceWords(file, content).next(), "solid"))
      refuse_file(
          file, "the surface",
          fmt::format("it is no STL, but a text that begins with \"{}\" and not with \"solid\"; export the surface "
                      "as STL",
                      first_line(content)));
    if (!is_words && !has_table)
      refuse_file(file, "the surface",
                  "it is no STL: it ends within the header of 84 bytes; export the surface as STL");
    SurfaceSoup soup = is_words ? read_text(file, content) : read_bytes(file, content);
    soup.patches     = {"outer"};
    return soup;
  }
} // namespace swimtwin
