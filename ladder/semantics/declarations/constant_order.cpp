#include "ladder/semantics/declarations/constant_order.h"

#include <numeric>
#include <utility>

namespace stepwright::semantics::internal {

namespace {

using syntax::Expression;
using syntax::ExpressionKind;
using syntax::TypeSpec;

// The names in a declaration: of variables, and of types.
class Names {
 public:
  std::vector<NameId> variables;
  std::vector<NameId> types;

  void add(const TypeSpec& first) {
    specs_.push_back(&first);
    while (!specs_.empty()) {
      const TypeSpec& spec = *specs_.back();
      specs_.pop_back();
      types.push_back(spec.name.id);
      for (const syntax::ArrayRange& each : spec.ranges) {
        add(each.low.get());
        add(each.high.get());
      }
      add(spec.length.get());
      for (const syntax::Enumerator& each : spec.enumerators) add(each.value.get());
      for (const syntax::VariableDeclaration& each : spec.fields) {
        if (each.type) specs_.push_back(each.type.get());
        add(each.initial.get());
      }
      if (spec.element) specs_.push_back(spec.element.get());
    }
  }

  void add(const Expression* first) {
    if (first != nullptr) expressions_.push_back(first);
    while (!expressions_.empty()) {
      const Expression& each = *expressions_.back();
      expressions_.pop_back();
      if (each.kind == ExpressionKind::Variable) variables.push_back(each.name.id);
      for (const auto& operand : each.operands)
        if (operand) expressions_.push_back(operand.get());
      for (const syntax::Argument& argument : each.arguments)
        if (argument.value) expressions_.push_back(argument.value.get());
    }
  }

 private:
  std::vector<const TypeSpec*> specs_;
  std::vector<const Expression*> expressions_;
};

// A depth-first walk over the lines and types; its own stack holds it, as a source decides how long a chain
// of constants is.
class Walk {
 public:
  Walk(Analysis& analysis, Lines lines, std::span<const syntax::TypeDeclaration> types)
      : a_(analysis), lines_(lines), types_(types), states_(lines.size() + types.size(), State::Open) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      // An input that is CONSTANT has the value of its argument.
      if (!lines[i]->constant || lines[i]->section == Section::Input) continue;
      for (const syntax::Name& name : lines[i]->names) constants_.try_emplace(name.id.value, i);
    }
    for (std::size_t i = 0; i < types.size(); ++i)
      type_nodes_.try_emplace(types[i].name.id.value, lines.size() + i);
    result_.broken.resize(lines.size());
  }

  ConstantOrder run() {
    if (constants_.empty()) {
      result_.order.resize(lines_.size());
      std::iota(result_.order.begin(), result_.order.end(), std::size_t{0});
      return std::move(result_);
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) visit(i);
    return std::move(result_);
  }

 private:
  enum class State : std::uint8_t { Open, Running, Done };
  struct Frame {
    std::size_t node = 0;  // a line or, behind those, a type
    std::vector<std::size_t> needs;
    std::size_t next = 0;
  };

  void enter(std::size_t node) {
    states_[node] = State::Running;
    Names names;
    if (node < lines_.size()) {
      if (lines_[node]->type) names.add(*lines_[node]->type);
      names.add(lines_[node]->initial.get());
    } else {
      const syntax::TypeDeclaration& type = types_[node - lines_.size()];
      if (type.type) names.add(*type.type);
      names.add(type.initial.get());
    }
    Frame frame{node, {}, 0};
    for (const NameId each : names.variables)
      if (const auto found = constants_.find(each.value); found != constants_.end())
        frame.needs.push_back(found->second);
    for (const NameId each : names.types)
      if (const auto found = type_nodes_.find(each.value); found != type_nodes_.end())
        frame.needs.push_back(found->second);
    frames_.push_back(std::move(frame));
  }

  void visit(std::size_t line) {
    if (states_[line] != State::Open) return;
    enter(line);
    while (!frames_.empty()) {
      Frame& top = frames_.back();
      if (top.next < top.needs.size()) {
        const std::size_t need = top.needs[top.next++];
        if (states_[need] == State::Running && need != top.node) report_cycle(need);
        if (states_[need] == State::Open) enter(need);
        continue;
      }
      const std::size_t done = top.node;
      frames_.pop_back();
      states_[done] = State::Done;
      if (done < lines_.size() && !result_.broken[done]) result_.order.push_back(done);
    }
  }

  // Types may lead back to themselves through references.
  void report_cycle(std::size_t node) {
    if (node >= lines_.size() || result_.broken[node]) return;
    const syntax::Name& name = lines_[node]->names.front();
    a_.error(code::kRecursion, name.where,
             "the value of the constant " + quote(name.text) + " depends on itself, through other constants",
             "give one of them a value that names none of the others");
    result_.broken[node] = true;
    result_.order.push_back(node);
  }

  Analysis& a_;
  Lines lines_;
  std::span<const syntax::TypeDeclaration> types_;
  std::unordered_map<std::uint32_t, std::size_t> constants_;   // NameId -> line
  std::unordered_map<std::uint32_t, std::size_t> type_nodes_;  // NameId -> node
  std::vector<State> states_;
  std::vector<Frame> frames_;
  ConstantOrder result_;
};

}  // namespace

ConstantOrder constant_order(Analysis& analysis, Lines lines,
                             std::span<const syntax::TypeDeclaration> types) {
  return Walk(analysis, lines, types).run();
}

}  // namespace stepwright::semantics::internal
