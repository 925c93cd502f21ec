// Variables and their parts (IEC 61131-3, 6.5).

#include <utility>

#include "ladder/semantics/analysis/hierarchical_address.h"
#include "ladder/semantics/expressions/places.h"
#include "ladder/source/suggestion.h"

namespace stepwright::semantics::internal {

using syntax::Expression;
using syntax::ExpressionKind;

namespace {

// Of the areas, or behind a reference: what others may know by another name.
bool is_outside(const Place& place) {
  for (const PlaceStep& each : place.steps)
    if (each.follow) return true;
  return place.base <= Base::Data || place.base == Base::ThisRef;
}

}  // namespace

const Variable* Places::find_variable(NameId name) const {
  if (pou_ != nullptr && !pou_->own_hidden) {
    if (const Variable* found = pou_->find(name)) return found;
  }
  const auto global = a_.globals.find(name.value);
  return global == a_.globals.end() ? nullptr : &a_.model.globals[global->second];
}

void Places::report_unknown(const syntax::Name& name) {
  if (a_.pous.count(name.id.value) != 0) {
    a_.error(code::kNotAVariable, name.where, quote(name.text) + " is a POU, not a variable",
             "declare an instance of a function block, or call the function with (...)");
    return;
  }
  const std::string& folded = a_.names.folded(name.id);
  if (folded == "THIS" || folded == "SUPER")
    return a_.error(code::kNotSupported, name.where,
                    quote(name.text) + " belongs to classes and methods, which are not supported",
                    "a block names its own variables as they are, and other blocks by their instances");
  if (a_.sink.is_full()) return a_.error(code::kUndeclared, name.where, {});
  std::vector<std::string_view> candidates;
  if (pou_ != nullptr && !pou_->own_hidden)
    for (const Variable& each : pou_->variables) candidates.push_back(each.spelling);
  for (const Variable& each : a_.model.globals) candidates.push_back(each.spelling);
  a_.unknown_name(code::kUndeclared, pou_, name.where, quote(name.text) + " is not declared",
                  source::did_you_mean(name.text, candidates));
}

namespace {

constexpr const char* kPlantHint = "what the plant measures is read; commands go to an output (%Q)";

}  // namespace

Places::Protection Places::protection(const Variable& variable) const {
  if (variable.constant) return {"is a constant", "declare it without CONSTANT to write it"};
  // Who tests a program plays its plant.
  if (in_test()) return {};
  const bool at_input = variable.open_address == syntax::Area::Input;
  if (at_input || variable.place.base == Base::Input) return {"is an input of the plant (%I)", kPlantHint};
  if (variable.section != Section::Input) return {};
  // An edge is sensed from the input itself, an ARRAY[*] is the caller's.
  const bool own = variable.edge == syntax::Edge::None && !(variable.type != nullptr && variable.type->open);
  std::string hint = "copy it into a variable of VAR or VAR_TEMP and write that";
  if (own) hint = source::with_dialects(std::move(hint), &source::Dialect::written_inputs);
  return {"is an input (VAR_INPUT)", std::move(hint), own && a_.dialect->written_inputs};
}

void Places::protect(Position where, std::string why, std::string hint) {
  read_only_ = {std::move(why), std::move(hint)};
  read_only_where_ = where;
}

std::optional<Place> Places::place(const Expression& expression, Access access) {
  // Indexes hold expressions of their own, so the state is that of the outer place again afterwards.
  Protection outer = std::exchange(read_only_, {});
  const Position outer_where = read_only_where_;
  std::optional<Place> found = part(expression);
  if (found && access == Access::Write && read_only_.tolerated) {
    tolerate(*found);
  } else if (found && access == Access::Write && !read_only_.why.empty()) {
    a_.error(code::kReadOnly, read_only_where_, read_only_.why + " and cannot be written", read_only_.hint);
    found.reset();
  }
  if (found && access == Access::Write && pou_ != nullptr && is_outside(*found)) {
    pou_->writes_outside = true;
    if (pou_->watches)
      a_.error(code::kReadOnly, expression.where, "what watches a program writes nothing of it");
  }
  read_only_ = std::move(outer);
  read_only_where_ = outer_where;
  return found;
}

// An input that its own POU writes. A function that writes one in memory works on a copy.
void Places::tolerate(Place& written) {
  a_.sink.warning(code::kInputWritten, read_only_where_, read_only_.why + " and is written here",
                  "its callers see no change; a variable of VAR says so");
  if (written.base == Base::SlotRef && pou_ != nullptr) pou_->writes_outside = true;
}

std::optional<Place> Places::part(const Expression& expression) {
  switch (expression.kind) {
    case ExpressionKind::Variable:
      return variable_place(expression.name);
    case ExpressionKind::Direct:
      return direct_place(expression);
    case ExpressionKind::Field:
      return field_place(expression);
    case ExpressionKind::Index:
      return index_place(expression);
    case ExpressionKind::Dereference:
      return followed_place(expression);
    case ExpressionKind::Part:
      return partial_place(expression);
    case ExpressionKind::Error:
      return std::nullopt;
    case ExpressionKind::Call:
      if (const Variable* called =
              expression.operands.empty() ? find_variable(expression.name.id) : nullptr) {
        if (called->type == nullptr) return std::nullopt;
        a_.error(code::kNeedsVariable, expression.where, "a variable is needed here, and no call",
                 index_hint(expression.name.text, *called->type));
        return std::nullopt;
      }
      [[fallthrough]];
    default:
      a_.error(code::kNeedsVariable, expression.where, "a variable is needed here");
      return std::nullopt;
  }
}

std::string Places::index_hint(std::string_view name, const Type& type) {
  const char* const part = type.kind == TypeKind::Array ? "an element"
                           : type.is_string()           ? "a character"
                                                        : nullptr;
  return part == nullptr ? "" : std::string(part) + " is written " + std::string(name) + "[...]";
}

std::optional<Place> Places::variable_place(const syntax::Name& name) {
  const Variable* found = find_variable(name.id);
  if (found == nullptr) {
    std::optional<Place> instance = sees_instances() ? program_instance(name) : std::nullopt;
    if (!instance && !is_unconfigured(name)) report_unknown(name);
    return instance;
  }
  if (found->deduced && found->type == nullptr)
    a_.error(code::kBadDiagram, name.where, "this is read before it is computed, so that it has no type",
             "connect it through a variable");
  if (found->type == nullptr) return std::nullopt;
  return known_place(*found, name);
}

Place Places::known_place(const Variable& variable, const syntax::Name& name) {
  const Variable* const found = &variable;
  Protection kept = protection(variable);
  if (!kept.why.empty()) {
    protect(name.where, quote(name.text) + " " + kept.why, std::move(kept.hint));
    read_only_.tolerated = kept.tolerated;
  }
  // The body reads the edge of an input with R_EDGE, its callers write the input itself.
  const bool senses = found->edge != syntax::Edge::None;
  Place place = copy_direct(senses ? found->edge_place : found->place);
  if (found->type->open) place.open = found;
  return place;
}

std::optional<Place> Places::field_place(const Expression& expression) {
  if (sees_instances()) {
    if (auto flag = step_flag(expression)) return flag;
  }
  if (const Variable* global = qualified_global(expression)) {
    if (global->type == nullptr) return std::nullopt;
    return known_place(*global, expression.name);
  }
  std::optional<Place> base = part(*expression.operands[0]);
  if (!base) return std::nullopt;
  const Type& type = *base->type;
  if (type.kind == TypeKind::Instance && sees_instances()) return inner_place(std::move(*base), expression);
  std::optional<Member> member;
  if (type.kind == TypeKind::Struct) {
    member = struct_member(type, expression.name);
  } else if (type.kind == TypeKind::Instance) {
    member = instance_member(type, expression.name);
  } else {
    a_.error(
        code::kUnknownMember, expression.name.where, type.name + " has no members",
        type.is_reference() ? "follow the reference first: ref^." + std::string(expression.name.text) : "");
  }
  if (!member) return std::nullopt;
  advance(*base, member->offset);
  base->type = member->type;
  base->bit = member->bit;
  return base;
}

std::optional<Places::Member> Places::struct_member(const Type& type, const syntax::Name& name) {
  if (const Field* field = type.find_field(name.id)) return Member{field->type, field->offset, field->bit};
  std::vector<std::string_view> candidates;
  if (!a_.sink.is_full())
    for (const Field& each : type.fields) candidates.push_back(each.spelling);
  a_.unknown_name(code::kUnknownMember, pou_, name.where,
                  quote(type.name) + " has no member " + quote(name.text),
                  source::did_you_mean(name.text, candidates));
  return std::nullopt;
}

std::optional<Places::Member> Places::instance_member(const Type& type, const syntax::Name& name) {
  // Writing a member writes into the block, not to the variable that holds it: t.IN := x, t being an input.
  read_only_ = {};
  const Variable* found = type.pou->find(name.id);
  if (found == nullptr) {
    std::vector<std::string_view> candidates;
    for (const Variable& each : type.pou->variables)
      if (!a_.sink.is_full() && (each.section == Section::Input || each.section == Section::Output))
        candidates.push_back(each.spelling);
    a_.unknown_name(code::kUnknownMember, pou_, name.where,
                    quote(type.name) + " has no member " + quote(name.text),
                    source::did_you_mean(name.text, candidates));
    return std::nullopt;
  }
  if (found->type == nullptr) return std::nullopt;
  const bool own = found->section == Section::Local && found->place.base == Base::This && !found->constant;
  const bool visible = found->section == Section::Input || found->section == Section::Output;
  const bool seen = (visible && found->place.base == Base::This) || (own && a_.dialect->open_blocks);
  if (!seen) {
    a_.error(code::kUnknownMember, name.where,
             quote(name.text) + " is internal to " + type.name + "; only its inputs and outputs can be seen",
             own ? source::with_dialects({}, &source::Dialect::open_blocks) : "");
    return std::nullopt;
  }
  if (found->section == Section::Output) {
    protect(name.where, quote(name.text) + " is an output of " + type.name,
            "only the block writes its outputs; callers give it inputs");
  }
  return Member{found->type, found->place.offset};
}

// %QX0.3 used in place: a BOOL or a bit string of the size that it names.
std::optional<Place> Places::direct_place(const Expression& expression) {
  const syntax::DirectAddress& address = expression.address;
  if (address.area == syntax::Area::Input && !in_test()) {
    protect(expression.where, quote(syntax::to_string(address)) + " is an input of the plant", kPlantHint);
  }
  if (pou_ == nullptr) {
    a_.error(code::kNotConstant, expression.where, "the value must be known when the program is compiled");
    return std::nullopt;
  }
  Place place;
  place.base = static_cast<Base>(address.area);
  place.offset = address.byte;
  if (address.bits == 1) place.bit = address.bit;
  const ElementaryType which = address.bits == 1    ? ElementaryType::Bool
                               : address.bits == 8  ? ElementaryType::Byte
                               : address.bits == 16 ? ElementaryType::Word
                               : address.bits == 32 ? ElementaryType::Dword
                                                    : ElementaryType::Lword;
  place.type = a_.type_table().elementary(which);
  for (const auto& [declared, type] : a_.direct_types)
    if (declared == address) place.type = type;
  if (address.byte >= syntax::kHierarchical) {
    place.offset = hierarchical_offset(a_, address, place.type->size, expression.where);
    return place;
  }
  auto& area = a_.model.area(place.base);
  const std::size_t end = std::size_t{address.byte} + place.type->size;
  if (area.size() < end) area.resize(end);
  return place;
}

// r^
std::optional<Place> Places::followed_place(const Expression& expression) {
  std::optional<Place> base = part(*expression.operands[0]);
  if (!base) return std::nullopt;
  // A constant or an input that holds a reference can be followed and what it leads to written.
  read_only_ = {};
  if (!base->type->is_reference()) {
    a_.error(code::kTypeMismatch, expression.where, base->type->name + " is no reference",
             "'^' follows a REF_TO");
    return std::nullopt;
  }
  PlaceStep step;
  step.follow = true;
  base->steps.push_back(std::move(step));
  base->type = base->type->element;
  return base;
}

}  // namespace stepwright::semantics::internal
