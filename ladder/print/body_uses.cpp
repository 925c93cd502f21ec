#include "ladder/print/body_uses.h"

#include <utility>

namespace stepwright::print {

namespace {

using graphic::Condition;
using graphic::ConditionKind;

class Walker {
 public:
  std::vector<BodyUse> take() { return std::move(uses_); }

  void add(const graphic::Listing& listing) {
    std::string text;
    for (const std::string& line : listing.lines) text += line + "\n";
    statements(text);
  }

  void add(const graphic::LadderProgram& program) {
    for (const graphic::Rung& rung : program.rungs) {
      add(rung.condition);
      for (const graphic::Block& block : rung.blocks) add(block);
      for (const graphic::Coil& coil : rung.coils) symbol(coil.variable, true);
      ++block_;
    }
  }

  void add(const graphic::SfcChart& chart) {
    for (const graphic::Step& step : chart.steps) {
      for (const graphic::ActionBlock& action : step.actions) {
        named(action.target);
        expression(action.duration);
        expression(action.indicator);
      }
      ++block_;
    }
    for (const graphic::Transition& transition : chart.transitions) {
      statements(condition_text(transition.condition));
      ++block_;
    }
    for (const graphic::Action& action : chart.actions) {
      statements(action.st_body);
      ++block_;
    }
  }

  void add(const graphic::Diagram& diagram) {
    std::uint32_t line = 0;
    for (const graphic::Element& element : diagram.elements) {
      const std::size_t first = uses_.size();
      ++line;
      add(element);
      for (std::size_t i = first; i < uses_.size(); ++i) uses_[i].use.line = line;
    }
  }

 private:
  void add(const graphic::Element& element) {
    using graphic::ElementKind;
    const std::string& name = element.name.text;
    if (element.kind == ElementKind::Block && !element.instance.empty()) {
      call(element.instance);
    }
    if (element.kind == ElementKind::InVariable || element.kind == ElementKind::InOutVariable)
      expression(name);
    if (element.kind == ElementKind::Contact) symbol(name, false);
    if (element.kind == ElementKind::OutVariable || element.kind == ElementKind::InOutVariable ||
        element.kind == ElementKind::Coil)
      symbol(name, true);
    for (const graphic::Pin& pin : element.inputs) expression(pin.expression.text);
    for (const graphic::Pin& pin : element.outputs) expression(pin.expression.text);
  }

  void statements(const std::string& text) {
    for (TextUse& use : texts_.of(text)) uses_.push_back({std::move(use), block_, false});
  }

  // Text that stands on a symbol.
  void expression(const std::string& text) {
    for (TextUse& use : texts_.of(text)) {
      use.line = use.column = use.length = 0;
      uses_.push_back({std::move(use), block_, false});
    }
  }

  // What an action block drives: a variable or an action.
  void named(const std::string& name) {
    uses_.push_back({{.name = name, .path = name, .line = 0, .column = 0, .write = true}, block_, false});
  }

  // The variable of a contact, coil or pin; what stands in its indexes is read.
  void symbol(const std::string& variable, bool write) {
    const std::size_t first = uses_.size();
    expression(variable);
    if (uses_.size() == first) return;
    uses_[first].use.write = write;
    uses_[first].drawn = true;
  }

  void call(const std::string& instance) {
    const std::size_t first = uses_.size();
    symbol(instance, true);
    if (uses_.size() > first) uses_[first].use.call = true;
  }

  void add(const Condition& condition) {
    if (condition.kind == ConditionKind::Contact) symbol(condition.name, false);
    if (condition.kind == ConditionKind::Comparison || condition.kind == ConditionKind::Expression) {
      expression(condition.name);
      expression(condition.operand);
    }
    for (const Condition& child : condition.children) add(child);
  }

  void add(const graphic::Block& block) {
    if (!block.instance.empty()) {
      call(block.instance);
    }
    for (const auto& [pin, value] : block.inputs) expression(value);
    for (const auto& [pin, value] : block.outputs)
      if (!value.empty()) symbol(value, true);
    expression(block.st_body);
  }

  std::vector<BodyUse> uses_;
  std::uint32_t block_ = 0;
  TextUses texts_;
};

}  // namespace

std::string condition_text(const Condition& condition) {
  const bool as_written = condition.kind == ConditionKind::Expression && !condition.negated;
  return as_written ? condition.name : to_st(condition);
}

std::vector<BodyUse> body_uses(const graphic::Sheet& sheet) {
  Walker walker;
  std::visit([&walker](const auto& body) { walker.add(body); }, sheet.body);
  return walker.take();
}

std::vector<BodyUse> diagram_uses(const graphic::Diagram& diagram) {
  Walker walker;
  walker.add(diagram);
  return walker.take();
}

std::vector<std::uint32_t> network_numbers(const graphic::LadderProgram& program) {
  std::vector<std::uint32_t> numbers;
  for (const graphic::Rung& rung : program.rungs) {
    const std::uint32_t last = numbers.empty() ? 0 : numbers.back();
    numbers.push_back(rung.goes_on && last > 0 ? last : last + 1);
  }
  return numbers;
}

}  // namespace stepwright::print
