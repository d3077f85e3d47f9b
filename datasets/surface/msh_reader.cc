#include <datasets/surface/msh_reader.h>

#include <datasets/files/input_file.h>
#include <datasets/surface/surface_words.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace swimtwin
{
  namespace
  {
    using Tag = long long;

    /// How many nodes an element has, by gmsh's number of its kind.
    const std::map<Tag, std::size_t> n_nodes_of_kind{
        {1, 2},   {2, 3},   {3, 4},   {4, 4},  {5, 8},  {6, 6},   {7, 5},   {8, 3},   {9, 6},  {10, 9},  {11, 10},
        {12, 27}, {13, 18}, {14, 14}, {15, 1}, {16, 8}, {17, 20}, {18, 15}, {19, 13}, {20, 9}, {21, 10}, {22, 12},
        {23, 15}, {24, 15}, {25, 21}, {26, 4}, {27, 5}, {28, 6},  {29, 20}, {30, 35}, {31, 56}};
    constexpr Tag triangle = 2, curved_triangle = 9;

    bool is_quadrangle(const Tag kind)
    {
      return kind == 3 || kind == 10 || kind == 16;
    }
    bool is_triangle_of_higher_order(const Tag kind)
    {
      return kind >= 20 && kind <= 25;
    }

    class MshReader
    {
    public:
      MshReader(const std::filesystem::path &file, const std::string_view content) : file_(file), words_(file, content)
      {
      }

      SurfaceSoup read()
      {
        read_format();
        for (std::string section(words_.next()); !section.empty(); section = words_.next())
          read_section(section);
        if (!has_elements_)
          words_.refuse("the file ends without $Elements; it has no mesh, or is cut off: mesh the surface in gmsh and "
                        "save it again");
        return soup();
      }

    private:
      void read_format()
      {
        words_.expect("$MeshFormat");
        version_         = words_.number();
        const Tag binary = words_.integer();
        if (version_ != 2.2 && version_ != 4.1)
          words_.refuse(fmt::format("it is of gmsh's format {}; save it in 4.1 or 2.2 (gmsh -format msh41)", version_));
        if (binary != 0)
          words_.refuse("it is written in bytes; save it as text (in gmsh: Mesh.Binary = 0)");
        words_.integer();
        words_.expect("$EndMeshFormat");
      }

      void read_section(const std::string &section)
      {
        const bool is_old = version_ == 2.2;
        if (section == "$PhysicalNames")
          read_names();
        else if (section == "$Entities" && !is_old)
          read_entities();
        else if (section == "$Nodes")
          is_old ? read_old_nodes() : read_nodes();
        else if (section == "$Elements")
          is_old ? read_old_elements() : read_elements();
        else if (section.starts_with('$'))
          return skip(section);
        else
          words_.refuse(
              fmt::format("\"{}\" stands where a section begins; save the mesh again", section.substr(0, 40)));
        words_.expect("$End" + section.substr(1));
      }

      void skip(const std::string &section)
      {
        const std::string end = "$End" + section.substr(1);
        for (std::string_view word = words_.next(); word != end; word = words_.next())
          if (word.empty())
            words_.refuse(fmt::format("the file ends in {}; copy or save it again", section));
      }

      void read_names()
      {
        for (Tag n = words_.integer(); n > 0; --n)
        {
          const Tag         dimension = words_.integer(), tag = words_.integer();
          const std::string name = words_.quoted();
          if (dimension == 2)
            names_[tag] = name;
        }
      }

      /// The first named physical surface of every surface.
      void read_entities()
      {
        std::array<Tag, 4> n{};
        for (Tag &count : n)
          count = words_.integer();
        for (int dimension = 0; dimension < 4; ++dimension)
          for (Tag i = 0; i < n[dimension]; ++i)
          {
            const Tag entity = words_.integer();
            for (int c = 0; c < (dimension == 0 ? 3 : 6); ++c)
              words_.next(); // its box
            for (Tag k = words_.integer(); k > 0; --k)
              if (const Tag physical = words_.integer(); dimension == 2)
                physical_of_surface_.try_emplace(entity, physical);
            if (dimension > 0)
              for (Tag k = words_.integer(); k > 0; --k)
                words_.integer();
          }
      }

      void add_node(const Tag tag, const Eigen::Vector3d &x)
      {
        if (!place_.try_emplace(tag, points_.size()).second)
          words_.refuse(fmt::format("node {} is there twice; save the mesh again", tag));
        points_.push_back(x);
      }
      Eigen::Vector3d point()
      {
        Eigen::Vector3d x;
        for (int c = 0; c < 3; ++c)
          x[c] = words_.number();
        return x;
      }

      void read_old_nodes()
      {
        for (Tag n = words_.integer(); n > 0; --n)
        {
          const Tag tag = words_.integer();
          add_node(tag, point());
        }
      }

      void read_nodes()
      {
        Tag n_blocks = words_.integer();
        for (int i = 0; i < 3; ++i)
          words_.integer();
        for (; n_blocks > 0; --n_blocks)
        {
          const Tag dimension = words_.integer();
          words_.integer();
          const bool       is_parametric = words_.integer() != 0;
          std::vector<Tag> tags;
          for (Tag n = words_.integer(); n > 0; --n)
            tags.push_back(words_.integer());
          for (const Tag tag : tags)
          {
            add_node(tag, point());
            for (Tag k = 0; is_parametric && k < dimension; ++k)
              words_.number();
          }
        }
      }

      void read_old_elements()
      {
        has_elements_ = true;
        for (Tag n = words_.integer(); n > 0; --n)
        {
          words_.integer();
          const Tag kind     = words_.integer();
          Tag       physical = 0;
          const Tag n_tags   = words_.integer();
          for (Tag k = 0; k < n_tags; ++k)
          {
            const Tag tag = words_.integer();
            physical      = k == 0 ? tag : physical;
          }
          read_element(kind, physical);
        }
      }

      void read_elements()
      {
        has_elements_ = true;
        Tag n_blocks  = words_.integer();
        for (int i = 0; i < 3; ++i)
          words_.integer();
        for (; n_blocks > 0; --n_blocks)
        {
          const Tag  dimension = words_.integer(), entity = words_.integer(), kind = words_.integer();
          const auto physical = physical_of_surface_.find(entity);
          for (Tag n = words_.integer(); n > 0; --n)
          {
            words_.integer();
            read_element(kind, dimension == 2 && physical != physical_of_surface_.end() ? physical->second : 0);
          }
        }
      }

      void read_element(const Tag kind, const Tag physical)
      {
        const auto n_nodes = n_nodes_of_kind.find(kind);
        if (n_nodes == n_nodes_of_kind.end())
          words_.refuse(
              fmt::format("there is an element of a kind ({}) that is not known here; save triangles of order "
                          "1 or 2 alone",
                          kind));
        if (is_quadrangle(kind))
          words_.refuse("there are quadrangles; mesh the surface with triangles (in gmsh: Mesh.RecombineAll = 0)");
        if (is_triangle_of_higher_order(kind))
          words_.refuse("there are triangles of order 3 or higher; mesh the surface in order 1 or 2 (gmsh -order 2)");
        std::array<Tag, 64> nodes{};
        for (std::size_t a = 0; a < n_nodes->second; ++a)
          nodes[a] = words_.integer();
        if (kind != triangle && kind != curved_triangle)
          return;
        if (!elements_.empty() && is_curved_ != (kind == curved_triangle))
          words_.refuse("there are triangles of order 1 and of order 2; mesh the surface in one order");
        is_curved_  = kind == curved_triangle;
        auto &added = elements_.emplace_back();
        std::copy_n(nodes.begin(), 6, added.begin());
        patches_.push_back(physical);
      }

      SurfaceSoup soup() const
      {
        if (elements_.empty())
          refuse_file(file_, "the surface",
                      "it holds no triangles; mesh the surface in gmsh (gmsh -2), and save all of it or its physical "
                      "surfaces");
        SurfaceSoup                     soup;
        std::map<std::string, unsigned> number;
        soup.points    = points_;
        soup.is_curved = is_curved_;
        for (std::size_t t = 0; t < elements_.size(); ++t)
        {
          auto &face = soup.faces.emplace_back();
          for (int a = 0; a < (is_curved_ ? 6 : 3); ++a)
          {
            const auto place = place_.find(elements_[t][a]);
            if (place == place_.end())
              refuse_file(file_, "the surface",
                          fmt::format("triangle {} of {} has node {}, which is not among $Nodes; save the mesh again",
                                      t + 1, elements_.size(), elements_[t][a]));
            face[a] = place->second;
          }
          const auto        named    = names_.find(patches_[t]);
          const std::string name     = named == names_.end() ? "outer" : named->second;
          const auto [patch, is_new] = number.try_emplace(name, soup.patches.size());
          if (is_new)
            soup.patches.push_back(name);
          soup.patch_of_face.push_back(patch->second);
        }
        return soup;
      }

      const std::filesystem::path    &file_;
      SurfaceWords                    words_;
      double                          version_      = 0.;
      bool                            has_elements_ = false, is_curved_ = false;
      std::map<Tag, std::string>      names_;
      std::map<Tag, Tag>              physical_of_surface_;
      std::map<Tag, unsigned int>     place_; ///< of every node
      std::vector<Eigen::Vector3d>    points_;
      std::vector<std::array<Tag, 6>> elements_;
      std::vector<Tag>                patches_;
    };
  } // namespace

  SurfaceSoup read_msh(const std::filesystem::path &file, const std::string_view content)
  {
    return MshReader(file, content).read();
  }
} // namespace swimtwin
