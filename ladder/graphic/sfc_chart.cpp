#include "ladder/graphic/sfc_chart.h"

#include <array>

#include "ladder/graphic/identifier.h"

namespace stepwright::graphic {
namespace {

constexpr std::array<const char*, 11> qualifier_names{"N",  "S",  "R",  "L",  "D", "P",
                                                      "P0", "P1", "SD", "DS", "SL"};

}  // namespace

const char* to_string(Qualifier qualifier) {
  return qualifier_names[static_cast<std::size_t>(qualifier)];
}

std::optional<Qualifier> qualifier_from(const std::string& text) {
  for (std::size_t i = 0; i < qualifier_names.size(); ++i) {
    if (same_name(text, qualifier_names[i])) return static_cast<Qualifier>(i);
  }
  return std::nullopt;
}

bool needs_duration(Qualifier qualifier) {
  return qualifier == Qualifier::L || qualifier == Qualifier::D || qualifier == Qualifier::SD ||
         qualifier == Qualifier::DS || qualifier == Qualifier::SL;
}

}  // namespace stepwright::graphic
