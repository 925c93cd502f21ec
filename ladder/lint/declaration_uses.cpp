// Names in declarations.

#include "ladder/lint/internal/body_walker.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::lint::internal {

namespace {

using syntax::Expression;
using syntax::ExpressionKind;

class DeclarationWalker {
 public:
  // `pou`: the index of the one that declares; nothing for what stands outside of POUs.
  DeclarationWalker(Uses& uses, std::optional<std::size_t> pou) : uses_(uses), pou_(pou) {}

  void lines(const std::vector<syntax::VariableDeclaration>& list) {
    for (const syntax::VariableDeclaration& line : list) {
      if (line.type) type(*line.type);
      if (line.initial) expression(*line.initial);
    }
  }

  void type(const syntax::TypeSpec& spec) {
    for (const syntax::ArrayRange& each : spec.ranges) {
      if (each.low) expression(*each.low);
      if (each.high) expression(*each.high);
    }
    if (spec.element) type(*spec.element);
    if (spec.length) expression(*spec.length);
    for (const syntax::Enumerator& each : spec.enumerators)
      if (each.value) expression(*each.value);
    lines(spec.fields);
  }

  void expression(const Expression& each) {
    if (each.kind == ExpressionKind::Variable)
      if (VariableUse* use = find(each)) use->named = true;
    if (const Expression* target = referred_by(each))
      if (VariableUse* use = find(root_of(*target))) use->referred = true;
    for (const auto& operand : each.operands)
      if (operand) expression(*operand);
    for (const syntax::Argument& argument : each.arguments)
      if (argument.value) expression(*argument.value);
  }

 private:
  VariableUse* find(const Expression& root) {
    if (pou_) return uses_.find(*pou_, root.name.id);
    const auto found = uses_.global_index.find(root.name.id.value);
    return found == uses_.global_index.end() ? nullptr : &uses_.of_globals[found->second];
  }

  Uses& uses_;
  std::optional<std::size_t> pou_;
};

}  // namespace

const Expression* referred_by(const Expression& call) {
  const bool refers = call.kind == ExpressionKind::Call && call.operands.empty() &&
                      naming::same_name(call.name.text, "REF") && call.arguments.size() == 1;
  return refers ? call.arguments[0].value.get() : nullptr;
}

void name_declarations(Uses& uses) {
  for (std::size_t i = 0; i < uses.user_pous; ++i) {
    const syntax::PouDeclaration& pou = *uses.model.pous[i]->declaration;
    DeclarationWalker walker(uses, i);
    walker.lines(pou.variables);
    if (pou.result) walker.type(*pou.result);
  }
  DeclarationWalker outside(uses, std::nullopt);
  for (const syntax::TypeDeclaration& each : uses.unit.types) {
    if (each.type) outside.type(*each.type);
    if (each.initial) outside.expression(*each.initial);
  }
  outside.lines(uses.unit.globals);
  for (const syntax::Configuration& configuration : uses.unit.configurations) {
    outside.lines(configuration.globals);
    for (const syntax::Resource& resource : configuration.resources) {
      outside.lines(resource.globals);
      for (const syntax::TaskDeclaration& task : resource.tasks) {
        if (task.single) outside.expression(*task.single);
        if (task.interval) outside.expression(*task.interval);
        if (task.priority) outside.expression(*task.priority);
      }
      for (const syntax::ProgramDeclaration& program : resource.programs)
        for (const syntax::Argument& each : program.connections)
          if (each.value) outside.expression(*each.value);
    }
    for (const syntax::ConfiguredVariable& each : configuration.configured)
      if (each.initial) outside.expression(*each.initial);
  }
}

}  // namespace stepwright::lint::internal
