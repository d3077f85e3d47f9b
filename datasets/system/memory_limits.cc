#include <datasets/system/memory_limits.h>

#include <datasets/system/error.h>

#include <fmt/format.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <new>
#include <sstream>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr double bytes_per_MB = 1e6;

    /// The number in a file of one, in bytes; NaN for "max" or if there is none.
    double bytes_in(const fs::path &file)
    {
      std::ifstream stream(file);
      double        bytes;
      return stream >> bytes ? bytes : std::numeric_limits<double>::quiet_NaN();
    }

    /// The number behind a word at the start of a line; `otherwise` if there is none.
    double number_behind(const fs::path &file, const std::string &word, const double otherwise)
    {
      std::ifstream stream(file);
      double        number;
      for (std::string line; std::getline(stream, line);)
      {
        std::istringstream words(line);
        std::string        first;
        if (words >> first >> number && first == word)
          return number;
      }
      return otherwise;
    }

    /// Address space and data of this process, in bytes.
    struct InUse
    {
      double address_space = 0., data = 0.;
    };

    InUse in_use(const fs::path &root)
    {
      std::ifstream stream(root / "proc/self/statm");
      double        size, resident, shared, text, library, data;
      if (!(stream >> size >> resident >> shared >> text >> library >> data))
        return {};
      const auto page = static_cast<double>(::sysconf(_SC_PAGESIZE));
      return {page * size, page * data};
    }

    void add_process_limits(const fs::path &root, std::vector<MemoryLimit> &limits)
    {
      const InUse used = in_use(root);
      const auto  add  = [&](const auto resource, const MemoryLimit::Of of, const char *name, const double bytes) {
        rlimit limit{};
        if (::getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
          limits.push_back({of, name, (static_cast<double>(limit.rlim_cur) - bytes) / bytes_per_MB});
      };
      add(RLIMIT_AS, MemoryLimit::Of::address_space, "ulimit -v", used.address_space);
      add(RLIMIT_DATA, MemoryLimit::Of::data, "ulimit -d", used.data);
    }

    /// Names of the files of one version of control groups.
    struct GroupFiles
    {
      const char *limit, *usage, *reclaimable;
    };

    /// Of a group and all groups around it. Files that were read and are not in use any more give way.
    void add_groups(const fs::path &mount, const std::string &group, const GroupFiles &files,
                    std::vector<MemoryLimit> &limits)
    {
      constexpr double unlimited = 1e18; // version 1 says so with a number near 2^63
      for (fs::path path = fs::path(group).relative_path();; path = path.parent_path())
      {
        const fs::path folder = path.empty() ? mount : mount / path;
        const double   limit = bytes_in(folder / files.limit), usage = bytes_in(folder / files.usage);
        if (limit < unlimited && usage >= 0.)
        {
          const double given_way = number_behind(folder / "memory.stat", files.reclaimable, 0.);
          limits.push_back({MemoryLimit::Of::machine, fmt::format("the control group's {}", files.limit),
                            (limit - usage + given_way) / bytes_per_MB});
        }
        if (path.empty())
          return;
      }
    }

    void add_control_groups(const fs::path &root, std::vector<MemoryLimit> &limits)
    {
      const fs::path mount = root / "sys/fs/cgroup";
      std::ifstream  stream(root / "proc/self/cgroup");
      for (std::string line; std::getline(stream, line);)
      {
        const auto first = line.find(':'), second = line.find(':', first + 1); // "5:memory:/path", "0::/path"
        if (first == std::string::npos || second == std::string::npos)
          continue;
        const std::string controllers = line.substr(first + 1, second - first - 1), path = line.substr(second + 1);
        if (controllers.empty())
          add_groups(mount, path, {"memory.max", "memory.current", "inactive_file"}, limits);
        else if (controllers == "memory")
          add_groups(mount / "memory", path, {"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"},
                     limits);
      }
    }

    void add_machine(const fs::path &root, std::vector<MemoryLimit> &limits)
    {
      constexpr double bytes_per_kB = 1024.;
      const fs::path   file         = root / "proc/meminfo";
      const double     free         = number_behind(file, "MemAvailable:", -1.);
      if (free >= 0.)
        limits.push_back({MemoryLimit::Of::machine, "the machine's free memory",
                          (free + number_behind(file, "SwapFree:", 0.)) * bytes_per_kB / bytes_per_MB});
    }

    double needed_MB(const MemoryNeed &need, const MemoryLimit &limit)
    {
      switch (limit.of)
      {
      case MemoryLimit::Of::address_space:
        return need.address_space_MB;
      case MemoryLimit::Of::data:
        return need.data_MB;
      case MemoryLimit::Of::machine:
        break;
      }
      return need.machine_MB;
    }
  } // namespace

  std::vector<MemoryLimit> memory_limits(const fs::path &root)
  {
    std::vector<MemoryLimit> limits;
    add_process_limits(root, limits);
    add_control_groups(root, limits);
    add_machine(root, limits);
    return limits;
  }

  void require_memory(const std::string &what, const MemoryNeed &need, const std::string &remedy,
                      const std::vector<MemoryLimit> &limits)
  {
    for (const MemoryLimit &limit : limits)
      if (const double needed = needed_MB(need, limit); needed > limit.left_MB)
        throw ComputationError(fmt::format("too little memory: {} needs about {:.0f} MB more, and {} leaves {:.0f} MB; "
                                           "{} or allow more memory",
                                           what, needed, limit.name, std::max(0., limit.left_MB), remedy));
  }

  int n_threads_in_memory(const int n, const std::vector<MemoryLimit> &limits)
  {
    constexpr double of_one_MB = 16., of_another_MB = 150.; // glibc reserves 128 MB for a thread's heap, for a while
    int              fitting = n;
    for (const MemoryLimit &limit : limits)
    {
      if (limit.of != MemoryLimit::Of::address_space)
        continue;
      if (limit.left_MB < of_one_MB)
        throw std::bad_alloc();
      fitting = std::min(fitting, 1 + static_cast<int>((limit.left_MB - of_one_MB) / of_another_MB));
    }
    return fitting;
  }

  int n_threads_in_memory(const int n)
  {
    if (rlimit limit{}; ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY)
      return n;
    std::vector<MemoryLimit> limits;
    add_process_limits("/", limits);
    return n_threads_in_memory(n, limits);
  }
} // namespace swimtwin
