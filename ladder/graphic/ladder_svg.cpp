// The SVG of a ladder diagram; see ladder_drawing.h.

#include "ladder/graphic/ladder_drawing.h"
#include "ladder/graphic/ladder_layout.h"
#include "ladder/graphic/svg_writer.h"

namespace stepwright::graphic {
namespace {

constexpr const char* style =
    R"(.sw-drawing text{font-family:ui-monospace,'DejaVu Sans Mono','Liberation Mono',Menlo,Consolas,monospace;font-size:12px;fill:#222}
.sw-drawing text.sw-centre{text-anchor:middle}
.sw-drawing text.sw-title{text-anchor:middle;font-weight:bold}
.sw-drawing text.sw-end{text-anchor:end}
.sw-drawing text.sw-number{font-size:11px;fill:#777}
.sw-drawing text.sw-comment{font-size:11px;fill:#555}
.sw-paper{fill:#f4f4f4}
.sw-rail{stroke:#111;stroke-width:3.5}
.sw-wire{stroke:#333;stroke-width:1.5;fill:none}
.sw-box{fill:#fff;stroke:#333;stroke-width:1.5}
.sw-active .sw-wire{stroke:#0b5394;stroke-width:3}
.sw-active .sw-box{fill:#bcd9f2}
)";

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

class SvgDrawing {
 public:
  explicit SvgDrawing(const LadderProgram& program)
      : program_(program),
        layout_(lay_out(program, metrics)),
        svg_(layout_.width, layout_.height, "Ladder diagram", style) {}

  std::string draw() {
    const int bottom = layout_.height - metrics.margin;
    svg_.line(layout_.left_rail, metrics.margin, layout_.left_rail, bottom, "sw-rail");
    svg_.line(layout_.right_rail, metrics.margin, layout_.right_rail, bottom, "sw-rail");
    for (const PlacedRung& rung : layout_.rungs) draw(rung);
    return svg_.finish();
  }

 private:
  void draw(const PlacedRung& placed) {
    const Rung& rung = program_.rungs[placed.rung];
    svg_.open_group("sw-rung", "data-rung", std::to_string(placed.rung + 1));
    const int y = placed.top + 13;
    const std::string label = rung.label.empty() ? "" : rung.label + ": ";
    svg_.text(layout_.left_rail + 8, y, std::to_string(placed.rung + 1), "sw-number");
    svg_.text(layout_.left_rail + 8 + 5 * metrics.character, y, label + rung.comment, "sw-comment");
    for (const PlacedWire& wire : placed.wires) svg_.line(wire.x1, wire.y1, wire.x2, wire.y2, "sw-wire");
    for (const PlacedSymbol& symbol : placed.symbols) draw(symbol);
    svg_.close_group();
  }

  void draw(const PlacedSymbol& symbol) {
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
      case SymbolKind::Jump:
      case SymbolKind::Return:
        svg_.text(symbol.x + 4, symbol.y + 4, symbol.text, "sw-jump");
        break;
    }
  }

  void contact(const PlacedSymbol& symbol) {
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
    svg_.close_group();
  }

  void coil(const PlacedSymbol& symbol) {
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
    svg_.close_group();
  }

  void block(const PlacedSymbol& symbol) {
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

  void row(const BlockShape& shape, const BlockRow& row, int x, int y) {
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

  const LadderProgram& program_;
  LadderLayout layout_;
  SvgWriter svg_;
};

}  // namespace

std::string draw_ladder_svg(const LadderProgram& program) {
  return SvgDrawing(program).draw();
}

}  // namespace stepwright::graphic
