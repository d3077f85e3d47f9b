#include <datasets/system/error.h>
#include <datasets/system/provenance.h>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <ctime>

namespace swimtwin
{
  std::string digest(const std::string &text)
  {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned int                               n_bytes = 0;
    if (EVP_Digest(text.data(), text.size(), bytes.data(), &n_bytes, EVP_sha256(), nullptr) != 1)
      throw ComputationError("libcrypto refuses to compute a SHA-256 digest");
    return fmt::format("{:02x}", fmt::join(bytes.begin(), bytes.begin() + n_bytes, ""));
  }

  std::string utc_time_now()
  {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  }
} // namespace swimtwin
