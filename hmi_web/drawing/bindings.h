#pragma once

// The attributes by which an element of a drawing lives: `data-fill="a1.level" data-from="0" data-to="100"`.
//
// Pure. Internal to this folder.

#include <string>
#include <vector>

#include <pugixml.hpp>

namespace stepwright::drawing {

struct BindingMistake {
  std::string message;
  std::string hint;
};

// The names of the values that the element is bound to, without a "!"; says what is wrong with its attributes
// that begin with `data-`.
std::vector<std::string> check_bindings(pugi::xml_node element, std::vector<BindingMistake>& mistakes);

}  // namespace stepwright::drawing
