#pragma once

// The styles that all drawings share. Light grey paper, dark grey ink: colour is left to what is active
// (ISA-101). Internal to the drawings (ladder/graphic, ladder/print).

#include <string>

namespace stepwright::graphic {

// The shared head; drawings append the classes of their own symbols.
std::string drawing_style();
// Contacts, coils, blocks, rails.
std::string ladder_style();
// Steps, transitions, jumps.
std::string sfc_style();

}  // namespace stepwright::graphic
