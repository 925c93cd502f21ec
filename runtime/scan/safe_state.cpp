#include "runtime/scan/safe_state.h"

namespace stepwright::scan {

void apply_safe_state(std::span<const SafeOutput> rules, std::span<std::byte> outputs) {
  for (std::size_t byte = 0; byte < outputs.size(); ++byte) {
    const auto before = static_cast<std::uint32_t>(outputs[byte]);
    std::uint32_t safe = 0;
    for (const SafeOutput& rule : rules) {
      if (rule.byte != byte) continue;
      const std::uint32_t source = rule.mode == SafeMode::Hold    ? before
                                   : rule.mode == SafeMode::Value ? rule.value
                                                                  : 0;
      safe = (safe & ~std::uint32_t{rule.mask}) | (source & rule.mask);
    }
    outputs[byte] = static_cast<std::byte>(safe);
  }
}

}  // namespace stepwright::scan
