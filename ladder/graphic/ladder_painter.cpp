#include "ladder/graphic/ladder_painter.h"

#include <algorithm>

#include "ladder/graphic/identifier.h"
#include "ladder/graphic/sfc_layout.h"
#include "ladder/graphic/text_wrap.h"

namespace stepwright::graphic {
namespace {

constexpr LadderMetrics metrics{.margin = 18,
                                .character = 8,
                                .line = 18,
                                .symbol = 24,
                                .symbol_half = 11,
                                .wire = 14,
                                .padding = 8,
                                .branch_gap = 8,
                                .rung_gap = 18,
                                .min_width = 480};

const char* mark_of(const Condition& contact) {
  if (contact.edge == Edge::Rising) return "P";
  if (contact.edge == Edge::Falling) return "N";
  return contact.negated ? "/" : "";
}

const char* mark_of(CoilKind kind) {
  switch (kind) {
    case CoilKind::Normal:
      return "";
    case CoilKind::Negated:
      return "/";
    case CoilKind::Set:
      return "S";
    case CoilKind::Reset:
      return "R";
    case CoilKind::RisingEdge:
      return "P";
    case CoilKind::FallingEdge:
      return "N";
  }
  return "";
}

}  // namespace

LadderMetrics svg_ladder_metrics() {
  return metrics;
}

void LadderPainter::rails(int top, int bottom) {
  svg_.line(layout_.left_rail, top, layout_.left_rail, bottom, "sw-rail");
  svg_.line(layout_.right_rail, top, layout_.right_rail, bottom, "sw-rail");
}

void LadderPainter::rung(const PlacedRung& placed) {
  svg_.open_group("sw-rung", "data-rung", std::to_string(placed.rung + 1));
  const int y = placed.top + 13;
  if (placed.number > 0) svg_.text(layout_.left_rail + 8, y, std::to_string(placed.number), "sw-number");
  for (std::size_t i = 0; i < placed.comment.size(); ++i) {
    svg_.text(layout_.left_rail + 8 + 5 * metrics.character, y + static_cast<int>(i) * metrics.line,
              placed.comment[i], "sw-rung-comment");
  }
  for (const PlacedWire& wire : placed.wires) svg_.line(wire.x1, wire.y1, wire.x2, wire.y2, "sw-wire");
  for (const PlacedSymbol& symbol : placed.symbols) draw(symbol);
  svg_.close_group();
}

void LadderPainter::draw(const PlacedSymbol& symbol) {
  switch (symbol.kind) {
    case SymbolKind::Contact:
      contact(symbol);
      break;
    case SymbolKind::Box:
      svg_.rect(symbol.x, symbol.y - metrics.symbol_half, symbol.width, 2 * metrics.symbol_half, "sw-box");
      svg_.text(symbol.x + symbol.width / 2, symbol.y + 4, symbol.text, "sw-centre");
      break;
    case SymbolKind::Coil:
      coil(symbol);
      break;
    case SymbolKind::Block:
      block(symbol);
      break;
    case SymbolKind::Connector:
    case SymbolKind::Jump:
    case SymbolKind::Return:
      svg_.text(symbol.x + 4, symbol.y + 4, symbol.text, "sw-jump");
      break;
    case SymbolKind::GoesOn:
    case SymbolKind::WentOn:
      goes_on(symbol);
      break;
  }
}

void LadderPainter::contact(const PlacedSymbol& symbol) {
  const int top = symbol.y - metrics.symbol_half;
  const int bottom = symbol.y + metrics.symbol_half;
  const int left = symbol.x + 6;
  const int right = symbol.x + symbol.width - 6;
  const std::string mark = mark_of(*symbol.condition);
  svg_.open_group("sw-contact", "data-variable", symbol.condition->name);
  svg_.line(symbol.x, symbol.y, left, symbol.y, "sw-wire");
  svg_.line(right, symbol.y, symbol.x + symbol.width, symbol.y, "sw-wire");
  svg_.line(left, top, left, bottom, "sw-wire");
  svg_.line(right, top, right, bottom, "sw-wire");
  const bool slash = symbol.condition->negated;
  if (slash) svg_.line(left - 2, bottom - 2, right + 2, top + 2, "sw-wire");
  if (mark != "/") svg_.text(symbol.x + symbol.width / 2, symbol.y + 4, mark, "sw-centre");
  svg_.text(symbol.x + symbol.width / 2, top - 5, symbol.condition->name, "sw-centre");
  if (notes_ != nullptr) note(symbol, notes_->contacts, symbol.condition->name);
  svg_.close_group();
}

void LadderPainter::coil(const PlacedSymbol& symbol) {
  const std::string left =
      std::to_string(symbol.x + 6) + " " + std::to_string(symbol.y - metrics.symbol_half);
  const std::string right =
      std::to_string(symbol.x + symbol.width - 6) + " " + std::to_string(symbol.y - metrics.symbol_half);
  svg_.open_group("sw-coil", "data-variable", symbol.coil->variable);
  svg_.path("M" + left + "q-8 11 0 22", "sw-wire");
  svg_.path("M" + right + "q8 11 0 22", "sw-wire");
  svg_.line(symbol.x, symbol.y, symbol.x + 2, symbol.y, "sw-wire");
  svg_.line(symbol.x + symbol.width - 2, symbol.y, symbol.x + symbol.width, symbol.y, "sw-wire");
  svg_.text(symbol.x + symbol.width / 2, symbol.y + 4, mark_of(symbol.coil->kind), "sw-centre");
  svg_.text(symbol.x + symbol.width / 2, symbol.y - metrics.symbol_half - 5, symbol.coil->variable,
            "sw-centre");
  if (notes_ != nullptr) note(symbol, notes_->coils, symbol.coil->variable);
  svg_.close_group();
}

void LadderPainter::block(const PlacedSymbol& symbol) {
  const BlockShape shape = shape_of(*symbol.block, metrics);
  const int top = symbol.y - metrics.symbol_half - metrics.line;
  const int rows = static_cast<int>(shape.rows.size());
  svg_.open_group("sw-block", "data-variable", shape.instance);
  svg_.rect(symbol.x, top, shape.box, metrics.line * (rows + 1) + metrics.symbol_half, "sw-box");
  svg_.text(symbol.x + shape.box / 2, top + 14, shape.title, "sw-title");
  if (!shape.instance.empty()) svg_.text(symbol.x + shape.box / 2, top - 5, shape.instance, "sw-centre");
  for (std::size_t i = 0; i < shape.rows.size(); ++i) {
    row(shape, shape.rows[i], symbol.x, symbol.y + static_cast<int>(i) * metrics.line);
  }
  svg_.close_group();
}

void LadderPainter::row(const BlockShape& shape, const BlockRow& row, int x, int y) {
  const int end = x + shape.box;
  svg_.text(x + metrics.padding, y + 4, row.pin_in, "sw-pin");
  svg_.text(end - metrics.padding, y + 4, row.pin_out, "sw-end");
  if (!row.value_in.empty()) {
    svg_.line(x - metrics.wire + 4, y, x, y, "sw-wire");
    svg_.text(x - metrics.wire, y + 4, row.value_in, "sw-end");
  }
  if (!row.value_out.empty()) {
    svg_.line(end, y, end + metrics.wire - 4, y, "sw-wire");
    svg_.text(end + metrics.wire, y + 4, row.value_out, "sw-value");
  }
}

void LadderPainter::goes_on(const PlacedSymbol& symbol) {
  const bool leaves = symbol.kind == SymbolKind::GoesOn;
  const int wire_end = leaves ? symbol.x + 8 : symbol.x + symbol.width - 8;
  const std::string start = std::to_string(leaves ? wire_end : wire_end - 9) + " " + std::to_string(symbol.y);
  svg_.line(leaves ? symbol.x : wire_end, symbol.y, leaves ? wire_end : symbol.x + symbol.width, symbol.y,
            "sw-wire");
  svg_.path("M" + start + "m0 -5v10l9 -5z", "sw-arrow");
  svg_.text(leaves ? wire_end + 22 : symbol.x + 18, symbol.y + 4, symbol.text, "sw-centre");
}

// As long as the cell between its neighbours allows.
void LadderPainter::note(const PlacedSymbol& symbol, const std::map<std::string, std::string>& texts,
                         const std::string& variable) {
  const auto found = texts.find(upper(variable));
  if (found == texts.end()) return;
  const int cell =
      std::max(symbol.width, static_cast<int>(length_of(variable)) * metrics.character) + metrics.wire;
  svg_.text(symbol.x + symbol.width / 2, symbol.y + metrics.symbol_half + 10,
            shortened(found->second, static_cast<std::size_t>(cell / 6)), "sw-note");
}

}  // namespace stepwright::graphic
