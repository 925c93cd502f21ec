#include "ladder/graphic/ladder_layout.h"

#include <algorithm>

#include "ladder/graphic/sfc_layout.h"
#include "ladder/graphic/text_wrap.h"

namespace stepwright::graphic {
namespace {

struct Size {
  int width = 0;
  int up = 0;    // above the wire
  int down = 0;  // below it
};

class Layouter {
 public:
  Layouter(const LadderProgram& program, const LadderMetrics& metrics) : program_(program), m_(metrics) {}

  LadderLayout run() {
    for (const Rung& rung : program_.rungs) {
      for (const Coil& coil : rung.coils)
        if (!is_connector(coil.variable))
          coil_width_ = std::max(coil_width_, symbol_size(coil.variable).width);
    }
    int width = m_.min_width;
    for (const Rung& rung : program_.rungs) {
      const int output = outputs(rung).width;
      const int parts = measure(rung.condition).width + output + 3 * m_.wire;
      const int comment = text_width(rung.comment) + text_width(rung.label) + 8 * m_.character;
      if (m_.max_width == 0 || std::max(parts, comment) <= m_.max_width) {
        width = std::max({width, parts, comment});
      } else {
        width = std::max(
            {width, m_.max_width, widest_part(rung.condition) + 2 * mark_width(), output + mark_width()});
      }
    }
    out_.left_rail = m_.margin;
    out_.right_rail = m_.margin + width;
    out_.width = width + 2 * m_.margin + 1;
    int y = m_.margin;
    for (std::size_t i = 0; i < program_.rungs.size(); ++i) y = place_rung(i, y);
    out_.height = y + m_.margin;
    return std::move(out_);
  }

 private:
  int mark_width() const { return 6 * m_.character; }

  int inner() const { return out_.right_rail - out_.left_rail; }

  static std::vector<const Condition*> parts_of(const Condition& condition) {
    std::vector<const Condition*> parts;
    if (condition.kind != ConditionKind::All) return {&condition};
    for (const Condition& child : condition.children) parts.push_back(&child);
    return parts;
  }

  int widest_part(const Condition& condition) const {
    int widest = 0;
    for (const Condition* part : parts_of(condition)) widest = std::max(widest, measure(*part).width);
    return widest;
  }

  // The condition in lines that leave room for the marks; the last one also for the outputs.
  std::vector<std::vector<const Condition*>> lines_of_rung(const Condition& condition, int output) const {
    std::vector<std::vector<const Condition*>> lines(1);
    lines[0] = parts_of(condition);
    if (m_.max_width == 0 || measure(condition).width + output <= inner()) return lines;
    lines.assign(1, {});
    int used = 0;
    for (const Condition* part : parts_of(condition)) {
      const int width = measure(*part).width;
      if (!lines.back().empty() && used + width + 2 * mark_width() > inner()) {
        lines.emplace_back();
        used = 0;
      }
      lines.back().push_back(part);
      used += width;
    }
    const int before = lines.size() > 1 ? mark_width() : 0;
    if (before + used + output > inner()) lines.emplace_back();
    return lines;
  }

  int text_width(const std::string& text) const { return static_cast<int>(length_of(text)) * m_.character; }

  Size symbol_size(const std::string& name) const {
    return {std::max(m_.symbol, text_width(name)) + 2 * m_.wire, m_.symbol_half + m_.line,
            m_.symbol_half + m_.note};
  }

  // Its line begins with one that ended in a connector, taken as it is: nothing leads there from the rail.
  static bool begins_anew(const Condition& condition) {
    const auto& children = condition.children;
    if (condition.kind == ConditionKind::All) return !children.empty() && begins_anew(children.front());
    if (condition.kind == ConditionKind::Any) return std::ranges::all_of(children, begins_anew);
    return condition.kind == ConditionKind::Contact && is_connector(condition.name) && !condition.negated &&
           condition.edge == Edge::None;
  }

  static std::string box_text(const Condition& condition) {
    if (condition.kind == ConditionKind::Expression)
      return condition.negated ? to_st(condition) : condition.name;
    return condition.name + " " + to_st(condition.op) + " " + condition.operand;
  }

  Size measure(const Condition& condition) const {
    switch (condition.kind) {
      case ConditionKind::True:
        return {2 * m_.wire, 0, 0};
      case ConditionKind::Contact:
        return symbol_size(condition.name);
      case ConditionKind::Comparison:
      case ConditionKind::Expression:
        return {text_width(box_text(condition)) + 2 * m_.padding + 2 * m_.wire, m_.symbol_half,
                m_.symbol_half};
      case ConditionKind::All:
        return series(condition);
      case ConditionKind::Any:
        return parallel(condition);
    }
    return {};
  }

  Size series(const Condition& condition) const { return series(parts_of(condition)); }

  Size series(const std::vector<const Condition*>& parts) const {
    Size size;
    for (const Condition* each : parts) {
      const Size part = measure(*each);
      size.width += part.width;
      size.up = std::max(size.up, part.up);
      size.down = std::max(size.down, part.down);
    }
    return size;
  }

  Size parallel(const Condition& condition) const {
    Size size;
    for (std::size_t i = 0; i < condition.children.size(); ++i) {
      const Size part = measure(condition.children[i]);
      size.width = std::max(size.width, part.width);
      if (i == 0) size = part;
      if (i > 0) size.down += m_.branch_gap + part.up + part.down;
      if (i > 0) size.down += 1;
    }
    size.width += 2 * m_.wire;
    return size;
  }

  Size block_size(const Block& block) const {
    const BlockShape shape = shape_of(block, m_);
    const int above = m_.line * (shape.instance.empty() ? 1 : 2) + m_.symbol_half + 1;
    const int below = m_.line * static_cast<int>(shape.rows.size());
    return {shape.left + shape.box + shape.right + 2 * m_.wire, above, below};
  }

  // What a rung powers, from top to bottom.
  struct Output {
    Size size;
    PlacedSymbol symbol;
  };

  std::vector<Output> outputs_of(const Rung& rung) const {
    std::vector<Output> list;
    const auto add = [&](SymbolKind kind, Size size) -> PlacedSymbol& {
      list.push_back({size, {}});
      list.back().symbol.kind = kind;
      list.back().symbol.width = size.width;
      return list.back().symbol;
    };
    for (const Block& block : rung.blocks) add(SymbolKind::Block, block_size(block)).block = &block;
    const auto add_text = [&](SymbolKind kind, const std::string& text) {
      add(kind, {text_width(text) + m_.wire, m_.symbol_half, m_.symbol_half}).text = text;
    };
    for (const Coil& coil : rung.coils) {
      if (is_connector(coil.variable)) {
        add_text(SymbolKind::Connector, coil.variable);
        continue;
      }
      // All coils of a program stand below each other.
      Size size = symbol_size(coil.variable);
      size.width = coil_width_;
      add(SymbolKind::Coil, size).coil = &coil;
    }
    if (!rung.jump_to.empty()) add_text(SymbolKind::Jump, ">> " + rung.jump_to);
    if (rung.is_return) add_text(SymbolKind::Return, "<RETURN>");
    return list;
  }

  Size outputs(const Rung& rung) const {
    Size size;
    for (const Output& output : outputs_of(rung)) {
      size.width = std::max(size.width, output.size.width);
      size.up = size.up == 0 ? output.size.up : size.up;
      size.down += output.size.down + output.size.up + m_.branch_gap;
    }
    size.width += m_.wire;
    return size;
  }

  void wire(int x1, int y1, int x2, int y2) {
    if (x1 != x2 || y1 != y2) out_.rungs.back().wires.push_back({x1, y1, x2, y2});
  }

  int place_rung(std::size_t index, int top) {
    const Rung& rung = program_.rungs[index];
    if (!rung.goes_on || number_ == 0) ++number_;
    out_.rungs.push_back({index, rung.goes_on ? 0 : number_, top, 0, comment_lines(rung), {}, {}});
    const Size output = outputs(rung);
    const auto lines = lines_of_rung(rung.condition, output.width);
    const int comment = std::max(1, static_cast<int>(out_.rungs.back().comment.size())) * m_.line;
    int bottom = top + comment + m_.branch_gap;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const bool last = i + 1 == lines.size();
      const Size size = series(lines[i]);
      const int up = std::max(size.up, last ? output.up : 0);
      bottom = place_line(rung, lines[i], i, last, bottom + up) + (last ? 0 : m_.branch_gap + 1);
    }
    out_.rungs.back().bottom = bottom + m_.rung_gap;
    return out_.rungs.back().bottom;
  }

  // One line of a rung with its wire at `y`; returns its lower end.
  int place_line(const Rung& rung, const std::vector<const Condition*>& parts, std::size_t index, bool last,
                 int y) {
    int x = out_.left_rail;
    if (index > 0) x += mark(SymbolKind::WentOn, index, x, y);
    for (const Condition* part : parts) {
      const int width = measure(*part).width;
      place(*part, x, y, width, index == 0 && part == parts.front());
      x += width;
    }
    const int end = out_.right_rail - (last ? outputs(rung).width : mark_width());
    wire(x, y, end, y);
    const int bottom = y + series(parts).down + 1;
    if (last) return std::max(bottom, place_outputs(rung, end, y));
    mark(SymbolKind::GoesOn, index + 1, end, y);
    return bottom;
  }

  // Where a line goes on: the same number at both ends.
  int mark(SymbolKind kind, std::size_t number, int x, int y) {
    PlacedSymbol symbol;
    symbol.kind = kind;
    symbol.x = x;
    symbol.y = y;
    symbol.width = mark_width();
    symbol.text = std::to_string(number);
    out_.rungs.back().symbols.push_back(symbol);
    return mark_width();
  }

  std::vector<std::string> comment_lines(const Rung& rung) const {
    const std::string label = rung.label.empty() ? "" : rung.label + ": ";
    const int width = inner() / m_.character - 8;
    return wrap_words(label + rung.comment, static_cast<std::size_t>(std::max(20, width)));
  }

  int place_outputs(const Rung& rung, int split, int y) {
    int bottom = y;
    int previous = y;
    bool first = true;
    for (Output& output : outputs_of(rung)) {
      const int at = first ? y : bottom + m_.branch_gap + output.size.up;
      first = false;
      wire(split, previous, split, at);
      previous = at;
      bottom = at + output.size.down + 1;
      place_output(output, split, at);
    }
    return bottom;
  }

  void place_output(Output& output, int split, int y) {
    PlacedSymbol& symbol = output.symbol;
    symbol.y = y;
    symbol.x = out_.right_rail - symbol.width;
    if (symbol.kind == SymbolKind::Coil) {
      centre(symbol, split, out_.right_rail);
    } else if (symbol.kind == SymbolKind::Block) {
      const BlockShape shape = shape_of(*symbol.block, m_);
      symbol.x = out_.right_rail - m_.wire - shape.right - shape.box;
      symbol.width = shape.box;
      wire(split, y, symbol.x, y);
      if (shape.passes_power) wire(symbol.x + shape.box, y, out_.right_rail, y);
    } else {
      wire(split, y, symbol.x, y);
    }
    out_.rungs.back().symbols.push_back(symbol);
  }

  // Puts a contact or coil in the middle of its text and wires it to both sides.
  void centre(PlacedSymbol& symbol, int left, int right) {
    const int end = symbol.x + symbol.width;
    symbol.x += (symbol.width - m_.symbol) / 2;
    symbol.width = m_.symbol;
    wire(left, symbol.y, symbol.x, symbol.y);
    wire(symbol.x + m_.symbol, symbol.y, std::max(end, right), symbol.y);
  }

  void place_connector(const Condition& condition, int x, int y, int width) {
    PlacedSymbol symbol;
    symbol.kind = SymbolKind::Connector;
    symbol.x = x + m_.wire;
    symbol.y = y;
    symbol.width = text_width(condition.name) + m_.padding / 2;
    symbol.text = condition.name;
    wire(symbol.x + symbol.width, y, x + width, y);
    out_.rungs.back().symbols.push_back(std::move(symbol));
  }

  // Fills the wire from `x` to `x + width` at `y`. `begins`: nothing stands between it and the rail.
  void place(const Condition& condition, int x, int y, int width, bool begins) {
    const bool is_contact = condition.kind == ConditionKind::Contact;
    if (is_contact && begins && begins_anew(condition)) return place_connector(condition, x, y, width);
    if (condition.kind == ConditionKind::True) wire(x, y, x + width, y);
    if (condition.kind == ConditionKind::All) place_series(condition, x, y, width, begins);
    if (condition.kind == ConditionKind::Any) place_parallel(condition, x, y, width, begins);
    const int own = measure(condition).width;
    PlacedSymbol symbol;
    symbol.x = x;
    symbol.y = y;
    symbol.width = own;
    symbol.condition = &condition;
    if (is_contact) {
      centre(symbol, x, x + width);
      out_.rungs.back().symbols.push_back(symbol);
    }
    if (condition.kind == ConditionKind::Comparison || condition.kind == ConditionKind::Expression) {
      symbol.kind = SymbolKind::Box;
      symbol.text = box_text(condition);
      symbol.x += m_.wire;
      symbol.width -= 2 * m_.wire;
      wire(x, y, symbol.x, y);
      wire(symbol.x + symbol.width, y, x + width, y);
      out_.rungs.back().symbols.push_back(symbol);
    }
  }

  void place_series(const Condition& condition, int x, int y, int width, bool begins) {
    const int end = x + width;
    for (const Condition& child : condition.children) {
      const int own = measure(child).width;
      place(child, x, y, own, begins && &child == &condition.children.front());
      x += own;
    }
    wire(x, y, end, y);
  }

  void place_parallel(const Condition& condition, int x, int y, int width, bool begins) {
    const int left = x + m_.wire;
    const int right = x + measure(condition).width - m_.wire;
    int at = y;
    int bottom = y;
    std::size_t fed = condition.children.size();  // the branches down to the last one that is led to
    while (begins && fed > 0 && begins_anew(condition.children[fed - 1])) --fed;
    for (std::size_t i = 0; i < condition.children.size(); ++i) {
      const Size part = measure(condition.children[i]);
      if (i > 0) {
        const int next = bottom + m_.branch_gap + part.up + 1;
        if (i < fed) wire(left, at, left, next);
        wire(right, at, right, next);
        at = next;
      }
      place(condition.children[i], left, at, right - left, begins);
      bottom = at + part.down;
    }
    if (fed > 0) wire(x, y, left, y);
    wire(right, y, x + width, y);
  }

  const LadderProgram& program_;
  const LadderMetrics& m_;
  LadderLayout out_;
  int coil_width_ = 0;
  std::size_t number_ = 0;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::string line;
  for (const char c : text + "\n") {
    if (c != '\n') {
      line += c;
    } else if (!line.empty()) {
      lines.push_back(std::move(line));
      line.clear();
    }
  }
  return lines;
}

}  // namespace

LadderLayout lay_out(const LadderProgram& program, const LadderMetrics& metrics) {
  return Layouter(program, metrics).run();
}

BlockShape shape_of(const Block& block, const LadderMetrics& metrics) {
  BlockShape shape;
  shape.title = block.type.empty() ? "ST" : block.type;
  shape.instance = block.instance;
  shape.passes_power = block.power_input.empty();
  shape.rows.push_back(
      {"", shape.passes_power ? "EN" : block.power_input, shape.passes_power ? "ENO" : "", ""});
  if (block.type.empty()) {
    for (std::string& line : lines_of(block.st_body)) shape.rows.push_back({"", std::move(line), "", ""});
  }
  const auto row = [&shape](std::size_t index) -> BlockRow& {
    if (shape.rows.size() <= index) shape.rows.resize(index + 1);
    return shape.rows[index];
  };
  std::size_t next = 1;
  for (const auto& [pin, value] : block.inputs) {
    row(next).pin_in = pin;
    row(next++).value_in = value;
  }
  next = shape.passes_power ? 1 : 0;
  for (const auto& [pin, value] : block.outputs) {
    row(next).pin_out = pin;
    row(next++).value_out = value;
  }
  const auto width = [&metrics](const std::string& text) {
    return static_cast<int>(length_of(text)) * metrics.character;
  };
  for (const BlockRow& each : shape.rows) {
    const int between = each.pin_in.empty() || each.pin_out.empty() ? 0 : 2 * metrics.character;
    shape.box = std::max(shape.box, width(each.pin_in) + between + width(each.pin_out));
    if (!each.value_in.empty()) shape.left = std::max(shape.left, width(each.value_in) + metrics.wire);
    if (!each.value_out.empty()) shape.right = std::max(shape.right, width(each.value_out) + metrics.wire);
  }
  shape.box = std::max(shape.box, width(shape.title)) + 2 * metrics.padding;
  // The name of the instance stands above the box and may be wider than it.
  shape.left = std::max(shape.left, (width(shape.instance) - shape.box) / 2);
  shape.right = std::max(shape.right, (width(shape.instance) - shape.box) / 2);
  return shape;
}

}  // namespace stepwright::graphic
