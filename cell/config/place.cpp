#include "cell/config/place.h"

#include <unistd.h>

#include <array>
#include <fstream>
#include <system_error>

namespace stepwright::config {
namespace {

constexpr std::size_t kIdLetters = 8;

std::string machine() {
  std::array<char, 65> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
  std::string name = host.data();
  std::string id;
  if (std::ifstream("/etc/machine-id") >> id) name += "-" + id.substr(0, kIdLetters);
  return name;
}

}  // namespace

std::string place_of(const std::filesystem::path& state_dir) {
  std::error_code error;
  const auto real = std::filesystem::weakly_canonical(std::filesystem::absolute(state_dir, error), error);
  return machine() + ":" + (error ? state_dir : real).string();
}

}  // namespace stepwright::config
