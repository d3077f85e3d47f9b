#include <datasets/system/error.h>
#include <datasets/system/memory_limits.h>
#include <tests/datasets/temporary_folder.h>

namespace swimtwin
{
  namespace
  {
    /// A machine's proc/ and sys/, made up.
    class Machine
    {
    public:
      void add(const std::string &file, const std::string &text)
      {
        std::filesystem::create_directories((folder_.path / file).parent_path());
        folder_.write(file, text);
      }

      std::string refusal(const double needed_MB) const
      {
        return message_of<ComputationError>([&] {
          require_memory("a mesh", {0., 0., needed_MB}, "choose a coarser one", memory_limits(folder_.path));
        });
      }

      /// Limits of this process, such as a CI's, are not those of the machine.
      std::size_t n_limits() const
      {
        std::size_t n = 0;
        for (const MemoryLimit &limit : memory_limits(folder_.path))
          n += limit.of == MemoryLimit::Of::machine ? 1 : 0;
        return n;
      }

    private:
      TemporaryFolder folder_;
    };
  } // namespace

  TEST(MemoryLimits, FreeMemoryAndSwapBoundAProcess)
  {
    Machine machine;
    machine.add("proc/meminfo", "MemTotal: 9000000 kB\nMemAvailable:   1000000 kB\nSwapFree: 500000 kB\n");
    EXPECT_EQ(machine.n_limits(), 1u);
    EXPECT_EQ(machine.refusal(2000.),
              "too little memory: a mesh needs about 2000 MB more, and the machine's free memory "
              "leaves 1536 MB; choose a coarser one or allow more memory");
    EXPECT_NO_THROW(require_memory("a mesh", {0., 0., 1500.}, "", {{MemoryLimit::Of::machine, "it", 1536.}}));
  }

  TEST(MemoryLimits, GroupsAndThoseAroundThemBoundAProcess)
  {
    Machine machine;
    machine.add("proc/self/cgroup", "0::/outer/inner\n");
    machine.add("sys/fs/cgroup/outer/inner/memory.max", "max\n");
    machine.add("sys/fs/cgroup/outer/inner/memory.current", "100000000\n");
    machine.add("sys/fs/cgroup/outer/memory.max", "900000000\n");
    machine.add("sys/fs/cgroup/outer/memory.current", "400000000\n");
    machine.add("sys/fs/cgroup/outer/memory.stat", "anon 1\ninactive_file 200000000\n");
    EXPECT_EQ(machine.n_limits(), 1u);
    expect_in(machine.refusal(701.), "the control group's memory.max leaves 700 MB");
  }

  TEST(MemoryLimits, TheFirstVersionOfGroupsIsReadToo)
  {
    Machine machine;
    machine.add("proc/self/cgroup", "7:cpu,cpuacct:/x\n5:memory:/docker/1\n");
    machine.add("sys/fs/cgroup/memory/memory.limit_in_bytes", "500000000\n"); // a container sees its own group on top
    machine.add("sys/fs/cgroup/memory/memory.usage_in_bytes", "450000000\n");
    expect_in(machine.refusal(51.), "the control group's memory.limit_in_bytes leaves 50 MB");
    machine.add("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    EXPECT_EQ(machine.n_limits(), 0u) << "unlimited";
  }

  TEST(MemoryLimits, WhatCannotBeReadIsNoLimit)
  {
    Machine machine;
    machine.add("proc/meminfo", "nothing of the kind\n");
    machine.add("proc/self/cgroup", "garbage\n0::\n");
    EXPECT_EQ(machine.n_limits(), 0u);
  }

  TEST(MemoryLimits, EachNeedIsHeldAgainstItsOwnLimit)
  {
    const std::vector<MemoryLimit> limits{{MemoryLimit::Of::address_space, "ulimit -v", 10.},
                                          {MemoryLimit::Of::data, "ulimit -d", 20.}};
    const auto                     refusal = [&](const MemoryNeed &need) {
      return message_of<ComputationError>([&] { require_memory("it", need, "wait", limits); });
    };
    expect_in(refusal({11., 0., 0.}), "it needs about 11 MB more, and ulimit -v leaves 10 MB; wait or allow more");
    expect_in(refusal({9., 21., 0.}), "it needs about 21 MB more, and ulimit -d leaves 20 MB");
    EXPECT_NO_THROW(require_memory("it", {9., 19., 1e6}, "wait", limits));
  }

  TEST(MemoryLimits, BoundTheNumberOfThreads)
  {
    const auto fitting = [](const int n, const double left_MB) {
      return n_threads_in_memory(n, {{MemoryLimit::Of::address_space, "ulimit -v", left_MB}});
    };
    EXPECT_EQ(n_threads_in_memory(64, {}), 64);
    EXPECT_EQ(fitting(64, 1e6), 64);
    EXPECT_EQ(fitting(64, 700.), 5);
    EXPECT_EQ(fitting(64, 20.), 1);
    EXPECT_THROW(fitting(1, 10.), std::bad_alloc);
  }
} // namespace swimtwin
