#pragma once

// The layout of a ladder diagram: where every symbol and wire stands. Drawings share it; the unit
// is what LadderMetrics are in. Pure function of its input; use from any thread.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ladder/graphic/ladder_program.h"

namespace stepwright::graphic {

struct LadderMetrics {
  int margin = 0;
  int character = 1;
  int line = 1;         // height of a line of text
  int symbol = 3;       // width of a contact or coil
  int symbol_half = 0;  // half its height
  int wire = 2;         // wire between neighbours in series
  int padding = 1;      // beside text in a box
  int branch_gap = 1;   // between parallel branches
  int rung_gap = 1;     // below a rung
  int min_width = 60;   // between the rails
  int max_width = 0;    // between the rails: a wider series goes on in another line; 0 = no bound
  int note = 0;         // height of the line of notes below contacts and coils
};

enum class SymbolKind : std::uint8_t { Contact, Box, Coil, Block, Connector, Jump, Return, GoesOn, WentOn };

// `x` is the left edge, `y` the height of the wire.
struct PlacedSymbol {
  SymbolKind kind = SymbolKind::Contact;
  int x = 0;
  int y = 0;
  int width = 0;
  const Condition* condition = nullptr;  // Contact, Box
  const Coil* coil = nullptr;
  const Block* block = nullptr;
  std::string text;  // of a Box, Connector, Jump, GoesOn (its line goes on ...), WentOn (... here)
};

struct PlacedWire {
  int x1 = 0;
  int y1 = 0;
  int x2 = 0;
  int y2 = 0;
};

struct PlacedRung {
  std::size_t rung = 0;
  std::size_t number = 0;            // as people count: rungs that go on with a network have none
  int top = 0;                       // of its comment
  int bottom = 0;                    // of everything, with the gap to the next rung
  std::vector<std::string> comment;  // with the label, in lines
  std::vector<PlacedSymbol> symbols;
  std::vector<PlacedWire> wires;
};

struct LadderLayout {
  int width = 0;
  int height = 0;
  int left_rail = 0;
  int right_rail = 0;
  std::vector<PlacedRung> rungs;
};

// The program must live as long as the layout.
LadderLayout lay_out(const LadderProgram& program, const LadderMetrics& metrics);

// How a block is drawn: a box with a title and rows of pins, their values outside of it. A statement list has
// its statements as rows and nothing outside.
struct BlockRow {
  std::string value_in;
  std::string pin_in;
  std::string pin_out;
  std::string value_out;
};

struct BlockShape {
  std::string title;
  std::string instance;
  std::vector<BlockRow> rows;  // the first one takes the power
  int left = 0;                // width of the values left of the box
  int box = 0;
  int right = 0;
  bool passes_power = false;  // has ENO in its first row
};

BlockShape shape_of(const Block& block, const LadderMetrics& metrics);

}  // namespace stepwright::graphic
