// Small observation files for tests.
#pragma once

#include <datasets/observation/observation_set.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/replaced.h>

#include <string>

namespace swimtwin
{
  inline const std::string example_sidecar = R"(source = "made for a test"
synthetic = true
swimmer = "none"
measured_by = "typed in"
period = 3

[field]
bx_T = 5e-3
by_T = 4e-3
)";

  inline const std::string example_curve = "frequency_Hz,displacement_m,sigma_m\n0.4,1.7e-4,3e-6\n0.8,1.8e-4,4e-6\n";

  /// A folder with NAME.csv and NAME.toml.
  struct ObservationFiles
  {
    explicit ObservationFiles(const std::string &csv, const std::string &toml = example_sidecar)
        : file(folder.write("data.csv", csv)), sidecar(folder.write("data.toml", toml))
    {
    }

    std::string message() const
    {
      return message_of<InputError>([&] { read_observations(file); });
    }
    std::string        warning() const { return first_warning(read_observations(file)); }
    static std::string first_warning(const ObservationSet &set) { return set.warnings.empty() ? "" : set.warnings[0]; }
    TemporaryFolder    folder;
    std::filesystem::path file, sidecar;
  };
} // namespace swimtwin
