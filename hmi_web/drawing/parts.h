#pragma once

// Reads the operator parts of a drawing. Pure. Internal to this folder.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "hmi_web/drawing/bindings.h"
#include "hmi_web/drawing/part.h"

namespace stepwright::drawing {

// One of the attributes that parts, symbols and screens have beside the bindings of drawings.
bool is_part_attribute(std::string_view name);
std::span<const std::string_view> part_attributes();

// The part that the element is; says what is wrong with its attributes. Names of variables that it shows are
// appended to `names`.
std::optional<Part> read_part(pugi::xml_node element, std::vector<std::string>& names,
                              std::vector<BindingMistake>& mistakes);

// A symbol that is to act and that the editor has left without a part, as something of it is not filled in:
// "the button 'Go' writes nothing", with the field that is missed.
std::optional<BindingMistake> idle_symbol(pugi::xml_node element);

}  // namespace stepwright::drawing
