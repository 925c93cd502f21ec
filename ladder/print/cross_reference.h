#pragma once

// Cross-reference of a sheet, the places where its variables are written and read: networks of ladder
// diagrams, steps and transitions of charts, lines of listings. Internal to this folder; pure functions.

#include <string>
#include <vector>

#include "ladder/graphic/ladder_painter.h"
#include "ladder/graphic/sheet.h"

namespace stepwright::print {

struct VariableUses {
  std::string name;
  std::string type;                  // empty if the sheet does not declare it
  std::string address;               // "%IX0.0"; empty if none
  std::vector<std::string> written;  // places in the order of the sheet
  std::vector<std::string> read;
};

// Declared variables that are used, and what contacts and coils use beyond them; sorted by name.
std::vector<VariableUses> cross_reference(const graphic::Sheet& sheet);

// Notes below the symbols of a ladder diagram: below a contact where it is written, below a coil where it is
// read.
graphic::LadderNotes ladder_notes(const std::vector<VariableUses>& uses);

// "1, 2, 3"
std::string joined(const std::vector<std::string>& places, const char* between = ", ");

}  // namespace stepwright::print
