#include "runtime/ground/log/log_file.h"

#include <array>
#include <fstream>
#include <string_view>

namespace stepwright::log {
namespace {

constexpr std::string_view kObject = "{\"time\":\"";
constexpr std::string_view kStamp = "0000-00-00T00:00:00.000Z";

// Where the disk was full a line may be torn: as far as it goes.
bool begins_with_stamp(std::string_view text) {
  for (std::size_t i = 0; i < text.size() && i < kStamp.size(); ++i) {
    const bool digit = text[i] >= '0' && text[i] <= '9';
    if (kStamp[i] == '0' ? !digit : text[i] != kStamp[i]) return false;
  }
  return true;
}

}  // namespace

bool is_log_or_empty(const std::filesystem::path& file) {
  std::array<char, kObject.size() + kStamp.size()> begin{};
  std::ifstream content(file, std::ios::binary);
  if (!content) return true;
  content.read(begin.data(), begin.size());
  const std::string_view text(begin.data(), static_cast<std::size_t>(content.gcount()));
  if (!text.starts_with('{')) return begins_with_stamp(text);
  const std::string_view head = text.substr(0, kObject.size());
  return kObject.starts_with(head) && begins_with_stamp(text.substr(head.size()));
}

}  // namespace stepwright::log
