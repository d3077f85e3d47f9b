// Which wall every node of a mesh in space is on.
#pragma once

#include <fom/mesh/fluid_mesh.h>
#include <fom/mesh/wall_loop.h>

namespace swimtwin
{
  /// Names of a node's walls, the strongest condition first.
  class NamesOfWalls
  {
  public:
    NamesOfWalls(const Domain &domain, const unsigned int n_nodes) : domain_(domain), name_(n_nodes) {}

    void add(const unsigned int node, const std::string &wall)
    {
      name_[node] = name_[node].empty() ? wall : stronger_wall(domain_, name_[node], wall);
    }
    std::vector<WallNode> nodes() const
    {
      std::vector<WallNode> nodes;
      for (unsigned int node = 0; node < name_.size(); ++node)
        if (!name_[node].empty())
          nodes.push_back({node, &domain_.walls.at(name_[node]), name_[node]});
      return nodes;
    }

  private:
    const Domain            &domain_;
    std::vector<std::string> name_;
  };
} // namespace swimtwin
