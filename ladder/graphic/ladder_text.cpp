// The drawing of a ladder diagram for terminals; see ladder_drawing.h.

#include "ladder/graphic/ladder_drawing.h"
#include "ladder/graphic/ladder_layout.h"
#include "ladder/graphic/sfc_layout.h"
#include "ladder/graphic/text_canvas.h"

namespace stepwright::graphic {
namespace {

constexpr LadderMetrics metrics{.symbol_half = 0, .wire = 2, .branch_gap = 0, .rung_gap = 1, .min_width = 64};

int length(const std::string& text) {
  return static_cast<int>(length_of(text));
}

// One that senses an edge and is negated takes a character of the wire behind it.
std::string glyph(const Condition& contact) {
  const std::string edge = contact.edge == Edge::Rising ? "P" : contact.edge == Edge::Falling ? "N" : "";
  const std::string mark = (contact.negated ? "/" : "") + edge;
  return "┤" + (mark.empty() ? " " : mark) + "├";
}

std::string glyph(CoilKind kind) {
  constexpr const char* marks[] = {" ", "/", "S", "R", "P", "N"};
  return std::string("(") + marks[static_cast<std::size_t>(kind)] + ")";
}

void named(TextCanvas& canvas, const PlacedSymbol& symbol, const std::string& name, const std::string& text) {
  canvas.text(symbol.x, symbol.y, text);
  canvas.text(symbol.x + 1 - length(name) / 2, symbol.y - 1, name);
}

void draw_block(TextCanvas& canvas, const PlacedSymbol& symbol) {
  const BlockShape shape = shape_of(*symbol.block, metrics);
  const int rows = static_cast<int>(shape.rows.size());
  canvas.box(symbol.x, symbol.y - 1, shape.box, rows + 2, false);
  canvas.text(symbol.x + (shape.box - length(shape.title)) / 2, symbol.y - 1, shape.title);
  if (!shape.instance.empty()) {
    canvas.text(symbol.x + (shape.box - length(shape.instance)) / 2, symbol.y - 2, shape.instance);
  }
  for (int i = 0; i < rows; ++i) {
    const BlockRow& row = shape.rows[static_cast<std::size_t>(i)];
    const int end = symbol.x + shape.box;
    canvas.text(symbol.x + 1, symbol.y + i, row.pin_in);
    canvas.text(end - 1 - length(row.pin_out), symbol.y + i, row.pin_out);
    if (!row.value_in.empty())
      canvas.text(symbol.x - 1 - length(row.value_in), symbol.y + i, row.value_in + "─");
    if (!row.value_out.empty()) canvas.text(end, symbol.y + i, "─" + row.value_out);
  }
}

void draw(TextCanvas& canvas, const PlacedSymbol& symbol) {
  switch (symbol.kind) {
    case SymbolKind::Contact:
      named(canvas, symbol, symbol.condition->name, glyph(*symbol.condition));
      break;
    case SymbolKind::Coil:
      named(canvas, symbol, symbol.coil->variable, glyph(symbol.coil->kind));
      break;
    case SymbolKind::Box:
      canvas.text(symbol.x, symbol.y, "[" + symbol.text + "]");
      break;
    case SymbolKind::Block:
      draw_block(canvas, symbol);
      break;
    case SymbolKind::Connector:
    case SymbolKind::Jump:
    case SymbolKind::Return:
      canvas.text(symbol.x, symbol.y, symbol.text);
      break;
    case SymbolKind::GoesOn:
      canvas.text(symbol.x, symbol.y, "─> " + symbol.text);
      break;
    case SymbolKind::WentOn:
      canvas.text(symbol.x + 1, symbol.y, symbol.text + " >─");
      break;
  }
}

}  // namespace

std::string draw_ladder_text(const LadderProgram& program, int max_width) {
  LadderMetrics bounded = metrics;
  bounded.max_width = max_width;
  const LadderLayout layout = lay_out(program, bounded);
  TextCanvas canvas;
  canvas.vertical(layout.left_rail, 0, layout.height);
  canvas.vertical(layout.right_rail, 0, layout.height);
  for (const PlacedRung& placed : layout.rungs) {
    if (placed.number > 0) canvas.text(layout.left_rail + 2, placed.top, std::to_string(placed.number));
    for (std::size_t i = 0; i < placed.comment.size(); ++i)
      canvas.text(layout.left_rail + 7, placed.top + static_cast<int>(i), placed.comment[i]);
    for (const PlacedWire& wire : placed.wires) {
      if (wire.y1 == wire.y2) {
        canvas.horizontal(wire.x1, wire.x2, wire.y1);
      } else {
        canvas.vertical(wire.x1, wire.y1, wire.y2);
      }
    }
    for (const PlacedSymbol& symbol : placed.symbols) draw(canvas, symbol);
  }
  return canvas.finish();
}

}  // namespace stepwright::graphic
