#include "ladder/graphic/diagram.h"

#include <array>

namespace stepwright::graphic {

const char* to_string(ElementKind kind) {
  constexpr std::array<const char*, 25> names{"comment",
                                              "error",
                                              "connector",
                                              "continuation",
                                              "actionBlock",
                                              "vendorElement",
                                              "block",
                                              "inVariable",
                                              "outVariable",
                                              "inOutVariable",
                                              "label",
                                              "jump",
                                              "return",
                                              "leftPowerRail",
                                              "rightPowerRail",
                                              "coil",
                                              "contact",
                                              "step",
                                              "macroStep",
                                              "jumpStep",
                                              "transition",
                                              "selectionDivergence",
                                              "selectionConvergence",
                                              "simultaneousDivergence",
                                              "simultaneousConvergence"};
  return names[static_cast<std::size_t>(kind)];
}

const Element* find(const Diagram& diagram, std::uint64_t id) {
  for (const Element& element : diagram.elements)
    if (element.id == id) return &element;
  return nullptr;
}

}  // namespace stepwright::graphic
