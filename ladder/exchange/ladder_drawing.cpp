#include "ladder/exchange/ladder_drawing.h"

#include <algorithm>

#include "ladder/exchange/drawing.h"
#include "ladder/exchange/st_assignments.h"
#include "ladder/source/codes.h"

namespace stepwright::exchange {
namespace {

using graphic::Coil;
using graphic::CoilKind;
using graphic::CompareOp;
using graphic::Condition;
using graphic::ConditionKind;
using graphic::Element;
using graphic::ElementKind;

const char* function_of(CompareOp op) {
  constexpr const char* names[] = {"EQ", "NE", "LT", "LE", "GT", "GE"};
  return names[static_cast<std::size_t>(op)];
}

graphic::Modifier modifier_of(CoilKind kind) {
  graphic::Modifier modifier;
  modifier.negated = kind == CoilKind::Negated;
  if (kind == CoilKind::RisingEdge) modifier.edge = graphic::Edge::Rising;
  if (kind == CoilKind::FallingEdge) modifier.edge = graphic::Edge::Falling;
  if (kind == CoilKind::Set) modifier.storage = graphic::Storage::Set;
  if (kind == CoilKind::Reset) modifier.storage = graphic::Storage::Reset;
  return modifier;
}

class LadderDrawing {
 public:
  explicit LadderDrawing(const std::string& pou) : pou_(pou), drawing_(graphic::DiagramLanguage::Ladder) {}

  result::Result<graphic::Diagram> draw(const graphic::LadderProgram& ladder) {
    Element& left = drawing_.add(ElementKind::LeftPowerRail, 20, 20, 3, 40);
    left.outputs.push_back(output_pin());
    rail_ = left.id;
    for (std::size_t i = 0; i < ladder.rungs.size(); ++i) rung(ladder.rungs[i], i);
    if (!diagnostics_.empty()) return tl::unexpected(std::move(diagnostics_));
    const int height = std::max(40, y_ - 20);
    Element& right = drawing_.add(ElementKind::RightPowerRail, 900, 20, 3, height);
    for (const Source& end : ends_) right.inputs.push_back(input_from({end}));
    drawing_.at(rail_).height = height;
    return drawing_.take();
  }

 private:
  struct Power {
    std::vector<Source> sources;  // several are a wired OR
    int x = 0;
  };

  bool at_rail(const Power& power) const { return power.sources.size() == 1 && power.sources[0].id == rail_; }

  void rung(const graphic::Rung& rung, std::size_t index) {
    if (!rung.comment.empty()) {
      drawing_.add(ElementKind::Comment, 40, y_, 400, 20).name = plain_text(rung.comment);
      y_ += 30;
    }
    if (!rung.label.empty()) {
      drawing_.add(ElementKind::Label, 40, y_, 80, 20).name = plain_text(rung.label);
      y_ += 30;
    }
    row_ = y_;
    const Power power = condition(rung.condition, {{{rail_, ""}}, 60});
    for (const graphic::Block& each : rung.blocks) block(each, power, index);
    for (const Coil& each : rung.coils) coil(each, power);
    if (!rung.jump_to.empty()) leave(ElementKind::Jump, rung.jump_to, power);
    if (rung.is_return) leave(ElementKind::Return, {}, power);
    y_ = std::max(y_, row_) + 20;
  }

  void leave(ElementKind kind, const std::string& label, const Power& power) {
    Element& element = drawing_.add(kind, 820, row_, 60, 20);
    element.name = plain_text(label);
    element.inputs.push_back(input_from(power.sources));
    next_row(40);
  }

  void next_row(int height) {
    row_ += height;
    y_ = std::max(y_, row_);
  }

  Power condition(const Condition& node, Power in) {
    switch (node.kind) {
      case ConditionKind::True:
        return in;
      case ConditionKind::Contact:
        return contact(node, in);
      case ConditionKind::Comparison:
        return joined(comparison(node, in.x), in);
      case ConditionKind::Expression:
        return joined(value(graphic::to_st(node), in.x, row_), in);
      case ConditionKind::All:
        for (const Condition& child : node.children) in = condition(child, in);
        return in;
      case ConditionKind::Any:
        return parallel(node, in);
    }
    return in;
  }

  Power parallel(const Condition& node, const Power& in) {
    Power out{{}, in.x};
    const int top = row_;
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      if (i > 0) next_row(60);
      const Power branch = condition(node.children[i], in);
      out.sources.insert(out.sources.end(), branch.sources.begin(), branch.sources.end());
      out.x = std::max(out.x, branch.x);
    }
    next_row(40);
    row_ = top;
    return out;
  }

  Power contact(const Condition& node, const Power& in) {
    Element& contact = drawing_.add(ElementKind::Contact, in.x, row_, 20, 20);
    contact.name = plain_text(node.name);
    contact.modifier.negated = node.negated;
    contact.modifier.edge = node.edge;
    contact.inputs.push_back(input_from(in.sources));
    contact.outputs.push_back(output_pin());
    y_ = std::max(y_, row_ + 40);
    return {{{contact.id, ""}}, in.x + 100};
  }

  Source value(const std::string& expression, int x, int y) {
    Element& variable = drawing_.add(ElementKind::InVariable, x, y, 80, 20);
    variable.name = plain_text(expression);
    variable.outputs.push_back(output_pin());
    return {variable.id, ""};
  }

  // A function of inputs IN1, IN2, ... without EN.
  Source function(const char* name, const std::vector<Source>& inputs, int x) {
    Element& block = drawing_.add(ElementKind::Block, x, row_, 60, 40);
    block.name = plain_text(name);
    for (std::size_t i = 0; i < inputs.size(); ++i)
      block.inputs.push_back(input_from({inputs[i]}, "IN" + std::to_string(i + 1)));
    block.outputs.push_back(output_pin("OUT"));
    y_ = std::max(y_, row_ + 60);
    return {block.id, "OUT"};
  }

  Source comparison(const Condition& node, int x) {
    const Source left = value(node.name, x, row_);
    const Source right = value(node.operand, x, row_ + 20);
    return function(function_of(node.op), {left, right}, x + 100);
  }

  // `test` and the power: the test alone at the rail, else an AND.
  Power joined(const Source& test, const Power& in) {
    if (at_rail(in)) return {{test}, in.x + 200};
    return {{function("AND", {single(in), test}, in.x + 200)}, in.x + 300};
  }

  // Inputs of blocks take one connection: parallel branches go through an OR.
  Source single(const Power& power) {
    if (power.sources.size() == 1) return power.sources[0];
    return function("OR", power.sources, power.x);
  }

  void coil(const Coil& coil, const Power& power) {
    Element& element = drawing_.add(ElementKind::Coil, 820, row_, 20, 20);
    element.name = plain_text(coil.variable);
    element.modifier = modifier_of(coil.kind);
    element.inputs.push_back(input_from(power.sources));
    element.outputs.push_back(output_pin());
    ends_.push_back({element.id, ""});
    next_row(40);
  }

  void block(const graphic::Block& block, const Power& power, std::size_t rung) {
    if (!block.type.empty()) {
      call(block, power);
      return;
    }
    const auto assignments = assignments_of(block.st_body);
    if (!assignments) {
      result::Diagnostic& diagnostic = diagnostics_.emplace_back();
      diagnostic.code = source::code::kNoRungForm;
      diagnostic.message = "POU '" + pou_ + "', rung " + std::to_string(rung + 1) +
                           ": PLCopen ladder diagrams cannot hold the statements \"" + block.st_body + "\"";
      diagnostic.hint = "export the chart, or keep the statements to assignments";
      return;
    }
    for (const Assignment& assignment : *assignments) {
      graphic::Block move;
      move.type = "MOVE";
      move.inputs.emplace_back("IN", assignment.expression);
      move.outputs.emplace_back("OUT", assignment.target);
      call(move, power);
    }
  }

  void call(const graphic::Block& block, const Power& power) {
    const bool enabled = block.power_input.empty();
    std::vector<std::pair<std::string, Source>> inputs{{enabled ? "EN" : block.power_input, single(power)}};
    for (const auto& [pin, expression] : block.inputs)
      inputs.emplace_back(pin, value(expression, power.x + 60, row_ + 20 * static_cast<int>(inputs.size())));
    const int height = 20 + 20 * static_cast<int>(std::max(inputs.size(), block.outputs.size() + 1));
    Element& element = drawing_.add(ElementKind::Block, power.x + 160, row_, 80, height);
    element.name = plain_text(block.type);
    element.instance = block.instance;
    for (const auto& [pin, source] : inputs) element.inputs.push_back(input_from({source}, pin));
    if (enabled) element.outputs.push_back(output_pin("ENO"));
    for (const auto& [pin, variable] : block.outputs) element.outputs.push_back(output_pin(pin));
    const std::uint64_t id = element.id;
    int at = row_;
    for (const auto& [pin, variable] : block.outputs) {
      Element& target = drawing_.add(ElementKind::OutVariable, power.x + 260, at, 80, 20);
      target.name = plain_text(variable);
      target.inputs.push_back(input_from({{id, pin}}));
      at += 20;
    }
    next_row(height + 20);
  }

  const std::string& pou_;
  Drawing drawing_;
  std::uint64_t rail_ = 0;
  std::vector<Source> ends_;
  int y_ = 40;    // below everything so far
  int row_ = 40;  // of what is drawn now
  result::Diagnostics diagnostics_;
};

}  // namespace

result::Result<graphic::Diagram> draw_ladder(const graphic::LadderProgram& ladder, const std::string& pou) {
  return LadderDrawing(pou).draw(ladder);
}

}  // namespace stepwright::exchange
