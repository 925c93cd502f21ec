#pragma once

// One table of [safe_state] as rules for bits and ramps. Thread-safe: pure.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/ground/settings/toml_document.h"
#include "runtime/scan/safe_state.h"

namespace stepwright::config {

// One line of the table.
struct SafeRule {
  std::string address;  // as it is written
  result::Location where;
  std::uint32_t first_bit = 0;  // of the output area
  std::uint32_t bits = 0;
  std::vector<scan::SafeOutput> outputs;  // one for every byte; none for a ramp
  std::optional<scan::SafeRamp> ramp;

  std::uint32_t end_bit() const { return first_bit + bits; }
  bool overlaps(const SafeRule& other) const {
    return first_bit < other.end_bit() && other.first_bit < end_bit();
  }
  bool covers(const SafeRule& other) const {
    return first_bit <= other.first_bit && other.end_bit() <= end_bit();
  }
};

// The rules that are right; what is wrong with the others is added to `problems` (C0302, C0303, C0442 to
// C0444).
std::vector<SafeRule> read_safe_rules(const settings::TomlTable& table, std::uint32_t output_bytes,
                                      result::Diagnostics& problems);

}  // namespace stepwright::config
