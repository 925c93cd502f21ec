#pragma once

// The attributes by which an element of a drawing lives: `data-fill="a1.level" data-from="0" data-to="100"`.
//
// Pure. Internal to this folder.

#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

namespace stepwright::drawing {

struct BindingMistake {
  std::string message;
  std::string hint;
};

// One of the attributes `data-...` that mean something here: bindings, what goes with them, parts.
bool is_known_data(std::string_view name);
// The one that was probably meant by another attribute `data-...`; empty: none is near.
std::string nearest_data(std::string_view name);

// The names of the values that the element is bound to, without a "!"; says what is wrong with its attributes
// that begin with `data-` and are known.
std::vector<std::string> check_bindings(pugi::xml_node element, std::vector<BindingMistake>& mistakes);

}  // namespace stepwright::drawing
