// What a TEST reads and writes: the variables of program instances under the names that every viewer uses
// (INSTANCE.block.variable), also those that are internal to their POU, and inputs of the plant. A program
// that watches others (ladder/semantics/internal/watcher.h) reads the same.

#include <algorithm>

#include "ladder/semantics/expressions/places.h"
#include "ladder/source/suggestion.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::semantics::internal {

using syntax::Expression;
using syntax::ExpressionKind;

namespace {

// "MAIN.pump.start"
std::string path_of(const Expression& expression) {
  if (expression.kind == ExpressionKind::Variable) return std::string(expression.name.text);
  if (expression.kind != ExpressionKind::Field) return {};
  return path_of(*expression.operands[0]) + "." + std::string(expression.name.text);
}

}  // namespace

std::optional<Place> Places::program_instance(const syntax::Name& name) {
  for (std::uint32_t k = 0; k < a_.model.instances.size(); ++k) {
    const ProgramInstance& each = a_.model.instances[k];
    if (!naming::same_name(each.name, name.text)) continue;
    if (pou_->watches && std::ranges::find(pou_->watched, k) == pou_->watched.end())
      pou_->watched.push_back(k);
    Place place;
    place.base = Base::Data;
    place.offset = each.offset;
    place.type = each.program->type;
    return place;
  }
  return std::nullopt;
}

bool Places::is_unconfigured(const syntax::Name& name) const {
  const auto found = a_.pous.find(name.id.value);
  return in_test() && a_.model.instances.empty() && a_.sink.has_errors() && found != a_.pous.end() &&
         found->second->kind == PouKind::Program;
}

// The lowering of a chart keeps S.X in the variable S_X.
std::optional<Place> Places::step_flag(const Expression& expression) {
  const std::string& flag = a_.names.folded(expression.name.id);
  const Expression& step = *expression.operands[0];
  if ((flag != "X" && flag != "T") || step.kind != ExpressionKind::Field) return std::nullopt;
  const auto name = a_.names.find(a_.names.folded(step.name.id) + "_" + flag);
  if (!name) return std::nullopt;
  std::optional<Place> owner = part(*step.operands[0]);
  if (!owner || owner->type->kind != TypeKind::Instance) return std::nullopt;
  const Pou& pou = *owner->type->pou;
  const Variable* found = pou.find(*name);
  const bool is_flag = found != nullptr && found->type != nullptr && found->place.base == Base::This &&
                       pou.find(step.name.id) == nullptr;
  if (!is_flag) return std::nullopt;
  advance(*owner, found->place.offset);
  owner->type = found->type;
  return owner;
}

std::optional<Place> Places::inner_place(Place base, const Expression& expression) {
  const syntax::Name& name = expression.name;
  const Variable* found = base.type->pou->find(name.id);
  if (found == nullptr) {
    std::vector<std::string_view> candidates;
    for (const Variable& each : base.type->pou->variables) candidates.push_back(each.spelling);
    a_.error(code::kUnknownMember, name.where,
             quote(base.type->name) + " has no variable " + quote(name.text),
             source::did_you_mean(name.text, candidates));
    return std::nullopt;
  }
  if (found->type == nullptr) return std::nullopt;
  read_only_ = {};
  if (found->constant) {
    protect(name.where, quote(name.text) + " is a constant", "declare it without CONSTANT to write it");
  }
  if (found->open_address) {
    // Of an instance that runs, the place that VAR_CONFIG gave it.
    const std::string path = path_of(expression);
    const auto given = std::ranges::find_if(
        a_.model.configured, [&](const Variable& each) { return naming::same_name(each.spelling, path); });
    if (given != a_.model.configured.end()) return copy_direct(given->place);
  }
  switch (found->place.base) {
    case Base::This:
      advance(base, found->place.offset);
      base.type = found->type;
      return base;
    case Base::Input:
    case Base::Output:
    case Base::Marker:
    case Base::Data:
      return copy_direct(found->place);
    case Base::ThisRef: {
      if (found->type->open) break;
      advance(base, found->place.offset);
      PlaceStep step;
      step.follow = true;
      base.steps.push_back(std::move(step));
      base.type = found->type;
      return base;
    }
    default:
      break;
  }
  a_.error(code::kUnknownMember, name.where,
           quote(name.text) + " of " + base.type->name + " is there only while the POU runs",
           "copy it to a variable that keeps its value");
  return std::nullopt;
}

}  // namespace stepwright::semantics::internal
