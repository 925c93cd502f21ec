#include "hmi_web/server/program_layout.h"

#include <algorithm>
#include <cctype>

namespace stepwright::server {
namespace {

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char left, char right) {
    return std::toupper(static_cast<unsigned char>(left)) == std::toupper(static_cast<unsigned char>(right));
  });
}

std::string_view last_part(std::string_view name) {
  const auto dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

}  // namespace

std::optional<ImageLocation> find_tag(const ProgramLayout& layout, std::string_view name) {
  std::optional<std::size_t> partial;
  bool ambiguous = false;
  const auto& tags = layout.program.tags;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (same_name(tags[i].name, name)) return layout.tags[i];
    if (!same_name(last_part(tags[i].name), name)) continue;
    ambiguous = partial.has_value();
    partial = i;
  }
  if (!partial || ambiguous) return std::nullopt;
  return layout.tags[*partial];
}

}  // namespace stepwright::server
