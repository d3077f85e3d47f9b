#include <datasets/files/hdf5_file.h>
#include <datasets/files/hdf5_open.h>
#include <datasets/files/input_file.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>

#include <fmt/format.h>
#include <hdf5.h>

namespace swimtwin
{
  namespace
  {
    constexpr std::string_view seal_start = "\nswimtwin sha256 ";
    constexpr std::size_t      seal_size  = seal_start.size() + 64 + 1;

    /// What HDF5's own list of errors says, from the outermost call to the innermost.
    std::string hdf5_errors()
    {
      std::string text;
      H5Ewalk2(
          H5E_DEFAULT, H5E_WALK_DOWNWARD,
          [](unsigned, const H5E_error2_t *error, void *collected) -> herr_t {
            *static_cast<std::string *>(collected) += fmt::format("{}; ", error->desc != nullptr ? error->desc : "");
            return 0;
          },
          &text);
      return text;
    }

    bool has_signature(const std::string &name)
    {
      return H5Fis_hdf5(name.c_str()) > 0; // also behind a user's block of 512, 1024, ... bytes
    }

    /// Why HDF5 does not open a file whose first bytes are as they should be.
    std::string cause_of_refusal(const std::string &name, const std::string &errors)
    {
      const auto says = [&](const char *words) { return errors.find(words) != std::string::npos; };
      if (says("already open for write") || says("h5clear"))
        return "another program has it open to write, or ended without closing it; wait until it has closed the file, "
               "or free the file with `h5clear -s`";
      if (says("truncated file"))
        return fmt::format("it was cut short: {} bytes are left; copy or make it again",
                           std::filesystem::file_size(name));
      return "it is damaged, or of a later version of HDF5; copy or make it again";
    }

    /// `errors` is what HDF5 says, which its next call would clear.
    hid_t open_with_locking(const std::string &name, const bool locking, std::string &errors)
    {
      const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      H5Pset_file_locking(access.id(), locking, true);
      const hid_t file = H5Fopen(name.c_str(), H5F_ACC_RDONLY, access.id());
      errors           = file < 0 ? hdf5_errors() : "";
      return file;
    }
  } // namespace

  /// Failures are reported by our exceptions, not by HDF5's own printing.
  void silence_hdf5()
  {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }

  std::int64_t open_hdf5_file(const std::string &name)
  {
    silence_hdf5();
    const std::string start = read_first_bytes(name, "", 512);
    std::string       errors;
    hid_t             file = open_with_locking(name, true, errors);
    if (file < 0 && errors.find("unable to lock file") != std::string::npos)
    {
      if (is_locked(name))
        refuse_file(name, "", locked_by_another_program);
      file = open_with_locking(name, false, errors); // a file system without locks
    }
    if (file >= 0)
      return file;
    if (hdf5_signature.starts_with(start))
      refuse_file(name, "", fmt::format("it was cut short: {} bytes are left; copy or make it again", start.size()));
    if (!has_signature(name))
      refuse_file(name, "", "it is not an HDF5 file");
    refuse_file(name, "", cause_of_refusal(name, errors));
  }

  std::string seal_of(const std::string &content)
  {
    return fmt::format("{}{}\n", seal_start, digest(content));
  }

  void require_seal(const std::filesystem::path &file, const std::string &remedy)
  {
    std::string text = read_content(file, "");
    if (text.size() < seal_size || text.compare(text.size() - seal_size, seal_start.size(), seal_start) != 0)
      throw InputError(
          fmt::format("{} ends without its checksum: it was cut short, or written by an earlier version; {}.",
                      file.string(), remedy));
    const std::string seal = text.substr(text.size() - seal_size);
    text.resize(text.size() - seal_size);
    if (seal != seal_of(text))
      throw InputError(
          fmt::format("{} is damaged: its content is not what its checksum was made of; {}.", file.string(), remedy));
  }
} // namespace swimtwin
