#include <tests/fuzz/fuzzed_readers.h>

#include <tests/datasets/temporary_folder.h>

#include <algorithm>
#include <cctype>

// Some hundreds of mutants for each reader; bench/fuzz makes as many as one waits for.
namespace swimtwin
{
  namespace
  {
    class MutantsOf : public testing::TestWithParam<FuzzedReader>
    {
    };

    /// How GoogleTest names a case.
    std::string name_of_case(const testing::TestParamInfo<FuzzedReader> &test)
    {
      std::string name = test.param.name;
      std::erase_if(name, [](const unsigned char c) { return !std::isalnum(c); });
      return name;
    }
  } // namespace

  void PrintTo(const FuzzedReader &reader, std::ostream *stream)
  {
    *stream << reader.name;
  }

  TEST_P(MutantsOf, StartFromFilesThatAreRead)
  {
    const FuzzedReader &reader = GetParam();
    for (const std::string &seed : reader.seeds)
    {
      const TemporaryFolder folder;
      for (const auto &[name, text] : reader.beside)
        folder.write(name, text);
      EXPECT_NO_THROW(reader.read(folder.write(reader.file_name, seed))) << seed.substr(0, 300);
    }
  }

  TEST_P(MutantsOf, AreReadOrRefusedInOurWords)
  {
    constexpr unsigned int n_mutants = 300;
    const FuzzedReader    &reader    = GetParam();
    const TemporaryFolder  folder;
    const auto             file = folder.path / reader.file_name;
    limit_reading();
    for (unsigned int seed = 0; seed < n_mutants && !HasFailure(); ++seed)
    {
      RandomNumbers random(seed);
      write_mutant(reader, file, random);
      EXPECT_EQ(fault_of(reader, file), "") << reader.name << ", seed " << seed;
    }
  }

  INSTANTIATE_TEST_SUITE_P(EveryReader, MutantsOf, testing::ValuesIn(all_readers()), name_of_case);
} // namespace swimtwin
