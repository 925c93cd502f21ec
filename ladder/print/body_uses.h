#pragma once

// Every place of a sheet's body where something that looks like a variable stands. Internal to this folder;
// pure functions.

#include <cstdint>
#include <string>
#include <vector>

#include "ladder/graphic/sheet.h"
#include "ladder/print/text_uses.h"

namespace stepwright::print {

// A body is a list of blocks: a listing is one, each rung is one; of a chart first its steps, then its
// transitions, then its actions.
struct BodyUse {
  TextUse use;  // line and column count in the block's text: 0 on a symbol that is drawn
  std::uint32_t block = 0;
  bool drawn = false;  // stands on a contact, coil or pin: a variable, declared or not
};

// The condition of a transition as its uses count in it.
std::string condition_text(const graphic::Condition& condition);

// In the order of the body.
std::vector<BodyUse> body_uses(const graphic::Sheet& sheet);
// Of a diagram as it was drawn: one block, in which a line is an element, from 1.
std::vector<BodyUse> diagram_uses(const graphic::Diagram& diagram);

// The number of each rung as people count: those that go on with a network have its number.
std::vector<std::uint32_t> network_numbers(const graphic::LadderProgram& program);

}  // namespace stepwright::print
