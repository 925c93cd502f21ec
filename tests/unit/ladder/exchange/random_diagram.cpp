#include "tests/unit/ladder/exchange/random_diagram.h"

#include <array>
#include <sstream>

namespace stepwright::exchange {
namespace {

using graphic::Connection;
using graphic::Element;
using graphic::ElementKind;
using graphic::Pin;

class Generator {
 public:
  explicit Generator(std::mt19937& random) : random_(random), ordered_(pick(4) == 0) {}

  graphic::Diagram run() {
    diagram_.language = graphic::DiagramLanguage::FunctionBlocks;
    const int count = 3 + pick(10);
    for (int i = 0; i < count; ++i) {
      const int roll = pick(10);
      if (roll < 6) block();
      if (roll == 6) connector();
      if (roll == 7) note();
      if (roll > 7) target(pick(2) == 0);
    }
    target(true);
    target(false);
    return std::move(diagram_);
  }

 private:
  struct Output {
    std::uint64_t id = 0;
    std::string pin;
  };

  int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  bool one_in(int count) { return pick(count) == 0; }

  std::string any_text() {
    constexpr std::array<const char*, 6> texts{"a note",
                                               "<&>\"'",
                                               "gr\xC3\xB6\xC3\x9F"
                                               "er",
                                               "two\nlines\t",
                                               " blanks around ",
                                               "]]> ends"};
    return texts[static_cast<std::size_t>(pick(6))];
  }

  Element& add(ElementKind kind) {
    Element& element = diagram_.elements.emplace_back();
    element.kind = kind;
    element.id = next_id_ += 1 + static_cast<std::uint64_t>(pick(3));
    element.position = {pick(80) / 4.0 * 10, pick(4000) / 4.0};
    if (!one_in(4) || kind == ElementKind::Comment) {
      element.width = 10.0 + pick(100);
      element.height = 0.5 + pick(100);
    }
    if (one_in(5)) element.documentation = any_text();
    return element;
  }

  // Numbers that the file gives; what it computes first goes first.
  void number(Element& element) {
    if (ordered_) element.order = ++order_;
  }

  Output variable(bool boolean) {
    Element& element = add(ElementKind::InVariable);
    const std::string index = std::to_string(pick(4));
    element.name.text = (boolean ? "b" : "n") + index;
    if (one_in(4)) element.name.text = boolean ? "b" + index + " AND n0 < 5" : "n" + index + " * 2";
    if (one_in(6)) element.name.text = boolean ? "TRUE" : std::to_string(pick(50));
    element.modifier.negated = boolean && one_in(5);
    element.outputs.emplace_back();
    if (one_in(3)) element.outputs.back().position = graphic::Place{70, 13.5};
    return {element.id, ""};
  }

  Output source(bool boolean) {
    const std::vector<Output>& known = boolean ? booleans_ : integers_;
    if (known.empty() || one_in(3)) return variable(boolean);
    return known[static_cast<std::size_t>(pick(static_cast<int>(known.size())))];
  }

  Pin input(const std::string& name, bool boolean) {
    const Output from = source(boolean);
    Pin pin;
    pin.name = name;
    Connection& connection = pin.connections.emplace_back();
    connection.from = from.id;
    connection.output = from.pin;
    for (int i = pick(3); i > 0; --i) connection.path.push_back({10.0 * pick(9), 0.25 * pick(99)});
    if (one_in(3)) pin.position = graphic::Place{0, 1.0 * pick(60)};
    pin.modifier.negated = boolean && one_in(5);
    if (boolean && one_in(7)) pin.modifier.edge = one_in(2) ? graphic::Edge::Rising : graphic::Edge::Falling;
    if (one_in(12)) pin.documentation = any_text();
    return pin;
  }

  void block() {
    struct Shape {
      const char* type;
      const char* inputs;  // B or N for each
      const char* names;
      bool boolean;
    };
    constexpr std::array<Shape, 12> shapes{{{"AND", "BB", "IN", true},
                                            {"OR", "BBB", "IN", true},
                                            {"XOR", "BB", "IN", true},
                                            {"NOT", "B", "IN", true},
                                            {"GT", "NN", "IN", true},
                                            {"EQ", "NN", "IN", true},
                                            {"ADD", "NNN", "IN", false},
                                            {"SUB", "NN", "IN", false},
                                            {"MAX", "NN", "IN", false},
                                            {"SEL", "BNN", "G", false},
                                            {"MOVE", "N", "IN", false},
                                            {"TON", "B", "IN", true}}};
    const Shape& shape = shapes[static_cast<std::size_t>(pick(12))];
    const bool timer = std::string(shape.type) == "TON";
    std::vector<Pin> pins;
    const bool enabled = !timer && one_in(6);
    if (enabled) pins.push_back(input("EN", true));
    for (std::size_t i = 0; shape.inputs[i] != '\0'; ++i) {
      std::string name = shape.names;
      if (name == "G") name = i == 0 ? "G" : "IN" + std::to_string(i - 1);
      if (name == "IN" && shape.inputs[1] != '\0') name += std::to_string(i + 1);
      pins.push_back(input(name, shape.inputs[i] == 'B'));
    }
    if (timer) {
      Element& time = add(ElementKind::InVariable);
      time.name.text = "T#30ms";
      time.outputs.emplace_back();
      Pin& pin = pins.emplace_back();
      pin.name = "PT";
      pin.connections.emplace_back().from = time.id;
    }
    Element& element = add(ElementKind::Block);
    element.name.text = shape.type;
    if (timer) element.instance = "t" + std::to_string(pick(2));
    number(element);
    element.inputs = std::move(pins);
    if (enabled) element.outputs.emplace_back().name = "ENO";
    const std::string out = timer ? "Q" : "OUT";
    element.outputs.emplace_back().name = out;
    element.outputs.back().modifier.negated = shape.boolean && one_in(8);
    (shape.boolean ? booleans_ : integers_).push_back({element.id, out});
    // An input that nothing leads to is nothing that editors draw, but some outputs have no point.
    if (timer) {
      element.outputs.emplace_back().name = "ET";
      element.outputs.back().has_point = one_in(2);
    }
  }

  void connector() {
    const bool boolean = one_in(2);
    const Output from = source(boolean);
    const std::string name = "link" + std::to_string(next_id_);
    Element& connector = add(ElementKind::Connector);
    connector.name.text = name;
    connector.inputs.emplace_back().connections.emplace_back().from = from.id;
    connector.inputs.back().connections.back().output = from.pin;
    Element& continuation = add(ElementKind::Continuation);
    continuation.name.text = name;
    continuation.outputs.emplace_back();
    (boolean ? booleans_ : integers_).push_back({continuation.id, ""});
  }

  void note() { add(ElementKind::Comment).name.text = any_text(); }

  void target(bool boolean) {
    Pin pin = input("", boolean);
    pin.modifier = {};
    pin.documentation.clear();
    const bool both = !ordered_ && one_in(4);
    Element& element = add(both ? ElementKind::InOutVariable : ElementKind::OutVariable);
    element.name.text = (boolean ? "b" : "n") + std::to_string(pick(4));
    number(element);
    element.inputs.push_back(std::move(pin));
    if (boolean && one_in(3)) element.modifier.negated = true;
    if (!both) {
      if (boolean && one_in(5)) element.modifier.storage = graphic::Storage::Set;
      return;
    }
    element.outputs.emplace_back();
    (boolean ? booleans_ : integers_).push_back({element.id, ""});
  }

  std::mt19937& random_;
  bool ordered_;
  graphic::Diagram diagram_;
  std::vector<Output> booleans_;
  std::vector<Output> integers_;
  std::uint64_t next_id_ = 0;
  std::uint64_t order_ = 0;
};

// Writes a body down.
class Describer {
 public:
  std::string run(const graphic::DrawnBody& drawn) {
    body(drawn.body);
    for (const auto* list : {&drawn.actions, &drawn.transitions}) {
      for (const graphic::NamedBody& each : *list) {
        field(each.name);
        field(each.documentation);
        body(each.body);
      }
      out_ << "---\n";
    }
    out_ << drawn.final_scan;
    return out_.str();
  }

 private:
  void field(const std::string& text) { out_ << '[' << text << ']'; }
  void field(const std::optional<graphic::Place>& place) {
    if (place) out_ << '(' << place->x << ',' << place->y << ')';
  }
  void field(const graphic::Modifier& modifier) {
    out_ << modifier.negated << static_cast<int>(modifier.edge) << static_cast<int>(modifier.storage);
  }
  void field(const graphic::Extra& extra) {
    for (const auto& [name, value] : extra.attributes) field(name + "=" + value);
    field(extra.children);
  }

  void body(const graphic::DiagramBody& body) {
    out_ << static_cast<int>(body.language) << static_cast<int>(body.diagram.language);
    field(body.text.text);
    field(body.documentation);
    field(body.extra);
    for (const Element& each : body.diagram.elements) element(each);
  }

  void pin(const Pin& pin) {
    field(pin.name);
    field(pin.modifier);
    field(pin.expression.text);
    field(pin.position);
    out_ << pin.has_point;
    field(pin.documentation);
    field(pin.extra);
    field(pin.point_extra);
    for (const Connection& each : pin.connections) {
      out_ << " <- " << each.from;
      field(each.output);
      for (const graphic::Place& place : each.path) field(std::optional(place));
      field(each.extra);
    }
  }

  void element(const Element& each) {
    out_ << '\n' << graphic::to_string(each.kind) << ' ' << each.id;
    field(std::optional(each.position));
    out_ << each.width.value_or(-1) << ' ' << each.height.value_or(-1) << ' '
         << static_cast<std::int64_t>(each.order.value_or(0)) << each.order.has_value();
    field(each.name.text);
    field(each.instance);
    field(each.modifier);
    field(each.output_modifier);
    for (const auto* list : {&each.inputs, &each.in_outs, &each.outputs}) {
      out_ << "\n  ";
      for (const Pin& one : *list) pin(one);
    }
    out_ << each.initial << each.action_output.has_value() << each.priority.value_or(0);
    field(each.documentation);
    field(each.extra);
  }

  std::ostringstream out_;
};

}  // namespace

graphic::Pou random_diagram(std::mt19937& random) {
  graphic::Pou pou;
  pou.name = "main";
  for (const char* name : {"b0", "b1", "b2", "b3"}) pou.variables.push_back({name, "BOOL"});
  for (const char* name : {"n0", "n1", "n2", "n3"}) pou.variables.push_back({name, "INT"});
  for (const char* name : {"t0", "t1"}) pou.variables.push_back({name, "TON"});
  graphic::DrawnBody drawn;
  drawn.body.language = graphic::BodyLanguage::Diagram;
  drawn.body.diagram = Generator(random).run();
  pou.body = std::move(drawn);
  return pou;
}

std::string text_of(const graphic::DrawnBody& body) {
  return Describer().run(body);
}

}  // namespace stepwright::exchange
