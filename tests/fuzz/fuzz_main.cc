// The long run: mutants of every reader until the time is over (bench/fuzz has the command).
//
//     fuzz_readers --seconds 600 [--seed 1] [--only NAME] [--keep FOLDER]
//
// A mutant whose reading goes wrong is kept in FOLDER, by its reader and seed. One that ends this program, by a
// sanitizer's report or by the clock, is the last one in FOLDER/now.
#include <tests/fuzz/fuzzed_readers.h>

#include <CLI/CLI.hpp>

#include <chrono>
#include <iostream>
#include <set>

namespace
{
  namespace fs = std::filesystem;
  using namespace swimtwin;

  struct Request
  {
    double       seconds = 60.;
    unsigned int seed    = 1;
    std::string  only;
    fs::path     keep = "fuzz";
  };

  /// The same fault is told and kept once: without numbers, sentences of one kind are alike.
  std::string kind_of(std::string fault)
  {
    std::erase_if(fault, [](const unsigned char c) { return std::isdigit(c); });
    return fault.substr(0, 60);
  }

  class Fuzzing
  {
  public:
    explicit Fuzzing(const Request &request) : request_(request)
    {
      for (const FuzzedReader &reader : all_readers())
        if (request.only.empty() || reader.name == request.only)
          readers_.push_back(reader);
    }

    /// The number of faults.
    std::size_t run()
    {
      limit_reading();
      const auto    end = std::chrono::steady_clock::now() + std::chrono::duration<double>(request_.seconds);
      unsigned long n   = 0;
      for (unsigned int seed = request_.seed; std::chrono::steady_clock::now() < end; ++seed)
        for (const FuzzedReader &reader : readers_)
        {
          try_mutant(reader, seed);
          ++n;
        }
      std::cout << n << " mutants of " << readers_.size() << " readers, " << kinds_.size() << " kinds of faults\n";
      return kinds_.size();
    }

  private:
    void try_mutant(const FuzzedReader &reader, const unsigned int seed)
    {
      const fs::path folder = request_.keep / "now";
      fs::remove_all(folder);
      fs::create_directories(folder);
      RandomNumbers random(seed);
      write_mutant(reader, folder / reader.file_name, random);
      const std::string fault = fault_of(reader, folder / reader.file_name);
      if (fault.empty() || !kinds_.insert(reader.name + kind_of(fault)).second)
        return;
      const fs::path kept = request_.keep / (reader.name + " " + std::to_string(seed));
      fs::create_directories(kept);
      fs::copy(folder, kept, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
      std::cout << reader.name << ", seed " << seed << ": " << fault << std::endl;
    }

    Request                   request_;
    std::vector<FuzzedReader> readers_;
    std::set<std::string>     kinds_;
  };
} // namespace

int main(int argc, char *argv[])
{
  Request  request;
  CLI::App app("Mutants of every reader");
  app.add_option("--seconds", request.seconds);
  app.add_option("--seed", request.seed, "the first");
  app.add_option("--only", request.only, "one reader");
  app.add_option("--keep", request.keep, "where mutants are kept");
  CLI11_PARSE(app, argc, argv);
  return Fuzzing(request).run() == 0 ? 0 : 1;
}
