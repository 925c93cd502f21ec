#include "ladder/lowering/block_pins.h"

#include <algorithm>

#include "ladder/graphic/identifier.h"

namespace stepwright::lowering {

using graphic::Element;
using graphic::Pin;
using graphic::same_name;

bool is_connected(const Pin& pin) {
  return !pin.connections.empty() || !pin.expression.text.empty();
}

const Pin* enable_of(const Element& block) {
  for (const Pin& pin : block.inputs)
    if (same_name(pin.name, "EN") && is_connected(pin)) return &pin;
  return nullptr;
}

Origin result_of(const Element& block, const DiagramScope& scope) {
  const Signature* signature = scope.signature(block.name.text);
  for (const Pin& pin : block.outputs) {
    const bool own = same_name(pin.name, "OUT") || pin.name.empty() || same_name(pin.name, block.name.text);
    const bool declared = signature != nullptr &&
                          std::any_of(signature->outputs.begin(), signature->outputs.end(),
                                      [&](const Parameter& each) { return same_name(each.name, pin.name); });
    if (own && !declared) return {&block, pin.name};
  }
  for (const Pin& pin : block.outputs)
    if (!same_name(pin.name, "ENO")) return {&block, pin.name};
  return {&block, ""};
}

}  // namespace stepwright::lowering
