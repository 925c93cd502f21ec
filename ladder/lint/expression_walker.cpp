// Expressions: which variables they read and write.

#include <algorithm>

#include "ladder/lint/internal/body_walker.h"
#include "ladder/source/codes.h"

namespace stepwright::lint::internal {

namespace code = source::code;
using semantics::Section;
using semantics::Type;
using syntax::Expression;
using syntax::ExpressionKind;

const Expression& root_of(const Expression& place) {
  const Expression* each = &place;
  while ((each->kind == ExpressionKind::Field || each->kind == ExpressionKind::Index ||
          each->kind == ExpressionKind::Part || each->kind == ExpressionKind::Dereference) &&
         !each->operands.empty())
    each = each->operands[0].get();
  return *each;
}

void BodyWalker::expression(const Expression& each) {
  switch (each.kind) {
    case ExpressionKind::Variable:
    case ExpressionKind::Direct:
    case ExpressionKind::Field:
    case ExpressionKind::Index:
    case ExpressionKind::Dereference:
    case ExpressionKind::Part:
      return place(each, Access::Read);
    case ExpressionKind::Call:
      return call(each);
    default:
      for (const auto& operand : each.operands)
        if (operand) expression(*operand);
  }
}

// Indexes and references on the way to a place are read, whatever happens to the place.
void BodyWalker::place(const Expression& each, Access access, bool keeps) {
  bool whole = true;
  const Expression* at = &each;
  while (at->kind != ExpressionKind::Variable && at->kind != ExpressionKind::Direct) {
    if (at->operands.empty()) return;
    whole = false;
    for (std::size_t i = 1; i < at->operands.size(); ++i)
      if (at->operands[i]) expression(*at->operands[i]);
    if (at->kind == ExpressionKind::Dereference) {
      if (access != Access::Read) last_unknown_ = ++writes_;
      access = Access::Read;
    } else if (at->kind == ExpressionKind::Call) {
      return call(*at);
    }
    at = at->operands[0].get();
  }
  variable(*at, access, whole, keeps);
}

void BodyWalker::variable(const Expression& root, Access access, bool whole, bool keeps) {
  if (root.kind == ExpressionKind::Direct) {
    if (access == Access::Read) return;
    DirectUse& direct = uses_.directs[range_of(root.address)];
    direct.text = syntax::to_string(root.address);
    direct.sites.push_back({&pou_, root.where, keeps, false});
    uses_.has_side_effects[index_] = true;
    return;
  }
  VariableUse* use = uses_.find(index_, root.name.id);
  if (use == nullptr) return;
  use->named = true;
  // What is passed as VAR_IN_OUT may be an output only: it is written first.
  if (access != Access::Read) {
    write(*use, root.where);
    if (whole) note_site(*use, root.where, keeps || access == Access::Both);
    const bool own = pou_.find(root.name.id) != nullptr && use->variable->section != Section::Global;
    if (!own || use->variable->section == Section::InOut || use->variable->section == Section::Output)
      uses_.has_side_effects[index_] = true;
  }
  if (access != Access::Write) read(*use, root.where);
}

void BodyWalker::read(VariableUse& use, Position where) {
  if (use.reads++ == 0) use.first_read = where;
  if (use.writes > 0 || use.referred || use.initialised || use.doubtful_loop || !speaks_of(where)) return;
  const semantics::Variable& variable = *use.variable;
  const bool lives_shortly =
      variable.section == Section::Temp ||
      (pou_.kind == semantics::PouKind::Function && variable.section == Section::Local);
  const bool simple = variable.type != nullptr && (variable.type->is_scalar() || variable.type->is_string());
  if (!lives_shortly || !simple || variable.constant || use.reads > 1) return;
  if (loops_.empty()) {
    sink_.warning(code::kNeverWritten, where,
                  quote(variable.spelling) + " is read before anything was written to it",
                  "give it a first value where it is declared");
    return;
  }
  use.doubtful_loop = outer_loops_;
  use.doubtful_where = where;
  doubtful_.push_back(&use);
}

void BodyWalker::write(VariableUse& use, Position where) {
  ++use.writes;
  use.last_write = ++writes_;
  use.last_write_where = where;
  use.doubtful_loop.reset();
}

void BodyWalker::note_site(VariableUse& use, Position where, bool keeps) {
  const semantics::Variable& variable = *use.variable;
  if (variable.type == nullptr || use.generated) return;
  const bool located = variable.address && variable.address->area != syntax::Area::Input;
  const bool coil = pou_.declaration->origin == syntax::BodyOrigin::Ladder && variable.type->is_bool();
  if (located || coil) use.sites.push_back({&pou_, where, keeps, coil});
}

const Type* BodyWalker::type_of(const Expression& each) {
  if (each.kind == ExpressionKind::Variable) {
    const VariableUse* use = uses_.find(index_, each.name.id);
    return use == nullptr ? nullptr : use->variable->type;
  }
  if (each.operands.empty()) return nullptr;
  const Type* base = type_of(*each.operands[0]);
  if (base == nullptr) return nullptr;
  if (each.kind == ExpressionKind::Index || each.kind == ExpressionKind::Dereference) return base->element;
  if (each.kind != ExpressionKind::Field) return nullptr;
  if (base->kind == semantics::TypeKind::Instance) {
    const semantics::Variable* member = base->pou->find(each.name.id);
    return member == nullptr ? nullptr : member->type;
  }
  const semantics::Field* field = base->find_field(each.name.id);
  return field == nullptr ? nullptr : field->type;
}

const semantics::Pou* BodyWalker::callee_of(const Expression& each) {
  if (!each.operands.empty()) {
    const Type* type = type_of(*each.operands[0]);
    return type == nullptr ? nullptr : type->pou;
  }
  if (const VariableUse* instance = uses_.find(index_, each.name.id);
      instance != nullptr && instance->variable->type != nullptr && instance->variable->type->pou != nullptr)
    return instance->variable->type->pou;
  const auto found = uses_.pou_index.find(each.name.id.value);
  return found == uses_.pou_index.end() ? nullptr : uses_.model.pous[found->second].get();
}

void BodyWalker::call(const Expression& each) {
  if (const Expression* target = referred_by(each))
    if (VariableUse* use = uses_.find(index_, root_of(*target).name.id)) use->referred = true;
  const semantics::Pou* callee = callee_of(each);
  if (!each.operands.empty()) {
    place(*each.operands[0], Access::Both);
  } else if (callee == nullptr || callee->kind != semantics::PouKind::Function) {
    VariableUse* instance = uses_.find(index_, each.name.id);
    if (instance != nullptr) {
      instance->named = true;
      write(*instance, each.where);
      read(*instance, each.where);
    }
  }
  std::size_t position = 0;
  for (const syntax::Argument& each_argument : each.arguments) argument(each_argument, callee, position);
  if (each.enable && each.enable->value) expression(*each.enable->value);
  if (each.enabled && each.enabled->value) place(*each.enabled->value, Access::Write);
  if (callee != nullptr) last_foreign_ = ++writes_;
}

// What the parameter is decides how the argument is used; functions that are not POUs only read.
void BodyWalker::argument(const syntax::Argument& each, const semantics::Pou* callee, std::size_t& position) {
  if (!each.value) return;
  Access access = each.is_output ? Access::Write : Access::Read;
  if (callee != nullptr) {
    const semantics::Variable* parameter = each.formal ? callee->find(each.formal->id) : nullptr;
    if (!each.formal) {
      std::size_t seen = 0;
      for (const semantics::Variable& variable : callee->variables) {
        const bool is_parameter = variable.section == Section::Input || variable.section == Section::Output ||
                                  variable.section == Section::InOut;
        if (is_parameter && seen++ == position) parameter = &variable;
      }
      ++position;
    }
    if (parameter != nullptr && parameter->section == Section::InOut) access = Access::Both;
    if (parameter != nullptr && parameter->section == Section::Output) access = Access::Write;
  }
  const ExpressionKind kind = each.value->kind;
  const bool is_place = kind == ExpressionKind::Variable || kind == ExpressionKind::Direct ||
                        kind == ExpressionKind::Field || kind == ExpressionKind::Index ||
                        kind == ExpressionKind::Dereference || kind == ExpressionKind::Part;
  if (access == Access::Read || !is_place) return expression(*each.value);
  place(*each.value, access);
}

}  // namespace stepwright::lint::internal
