#include "ladder/semantics/declarations/layout.h"
#include "ladder/semantics/declarations/constant_order.h"

#include <algorithm>
#include <utility>

namespace stepwright::semantics::internal {

using syntax::VariableDeclaration;

namespace {

// First bytes of a test's instance (TestHeader).
std::vector<std::byte> test_header(Analysis& a) {
  std::vector<std::byte> header(TestHeader::kMessage);
  const Type* message = a.type_table().string(ElementaryType::String, TestHeader::kMessageCapacity);
  header.insert(header.end(), message->initial.begin(), message->initial.end());
  header.resize(TestHeader::kMessage + message->size);
  return header;
}

}  // namespace

void Layout::run() {
  const syntax::PouDeclaration& declaration = *pou_.declaration;
  if (pou_.test != nullptr) append(test_header(a_));
  line_types_.resize(declaration.variables.size());
  // The parameters of a function are numbered before its variables are declared.
  const auto is_numbered = [&](const VariableDeclaration& line) {
    return pou_.kind == PouKind::Function &&
           (line.section == Section::Input || line.section == Section::Output ||
            line.section == Section::InOut);
  };
  for (std::size_t i = 0; i < line_types_.size(); ++i)
    if (is_numbered(declaration.variables[i])) line_types_[i] = type_of(declaration.variables[i]);
  if (pou_.kind == PouKind::Function) {
    number_parameters();
    declare_result();
  }
  std::vector<const VariableDeclaration*> lines;
  for (const VariableDeclaration& each : declaration.variables) lines.push_back(&each);
  // One after the other, behind the constants that it names: a bound may be one.
  const ConstantOrder ordered = constant_order(a_, lines, {});
  for (const std::size_t i : ordered.order) {
    const VariableDeclaration& line = declaration.variables[i];
    if (ordered.broken[i]) {
      line_types_[i] = nullptr;
    } else if (!is_numbered(line)) {
      line_types_[i] = type_of(line);
    }
    if (line.names.empty() && line_types_[i] != nullptr)
      declare_direct(a_, types_, expressions_, line, *line_types_[i]);
    for (const syntax::Name& name : line.names) declare(line, name, line_types_[i]);
  }
  guard_body();
  if (pou_.type == nullptr) return;
  auto* type = const_cast<Type*>(pou_.type);  // complete only now, as the POU is
  // An instance without variables still has an address.
  if (instance_.empty()) instance_.resize(1);
  type->size = static_cast<std::uint32_t>(instance_.size());
  for (const Variable& each : pou_.variables)
    if (each.type != nullptr && each.place.base == Base::This)
      type->nesting = std::max(type->nesting, each.type->nesting + 1);
  if (!types_.affords(instance_.size(), declaration.name.where)) return;
  type->initial = std::move(instance_);
}

const Type* Layout::type_of(const VariableDeclaration& line) {
  if (line.type->kind == syntax::TypeKind::Deduced) return nullptr;
  const bool is_parameter =
      line.section == Section::InOut || (line.section == Section::Input && pou_.kind == PouKind::Function);
  const Type* type = is_parameter ? types_.resolve_parameter(*line.type) : types_.resolve(*line.type);
  return type != nullptr && allowed(line, *type) ? type : nullptr;
}

void Layout::declare(const VariableDeclaration& line, const syntax::Name& name, const Type* type) {
  Variable variable;
  variable.name = name.id;
  variable.spelling = std::string(name.text);
  variable.type = type;
  variable.section = line.section;
  variable.any_integer = type != nullptr && types_.is_any_integer(*line.type);
  variable.deduced = line.type->kind == syntax::TypeKind::Deduced;
  variable.constant = line.constant;
  variable.retain = line.retain;
  variable.non_retain = line.non_retain;
  variable.edge = line.edge;
  variable.where = name.where;
  variable.place.type = type;
  if (type != nullptr && !place(line, variable)) variable.type = nullptr;
  add(std::move(variable));
}

void Layout::add(Variable variable) {
  const auto index = static_cast<std::uint32_t>(pou_.variables.size());
  if (!pou_.scope.try_emplace(variable.name.value, index).second) {
    a_.error(code::kDuplicate, variable.where,
             "there is another variable " + quote(variable.spelling) + " in " + quote(pou_.spelling));
    return;
  }
  pou_.variables.push_back(std::move(variable));
}

bool Layout::place(const VariableDeclaration& line, Variable& variable) {
  if (line.section == Section::External) return external(variable);
  const Type& type = *variable.type;
  std::vector<std::byte> bytes = types_.initial_of(*line.type, type);
  // A call that does not mention EN is enabled.
  const bool enables =
      line.section == Section::Input && type.is_bool() && a_.names.folded(variable.name) == "EN";
  if (enables) bytes[0] = std::byte{1};
  if (line.initial && !initialise(a_, expressions_, *line.initial, type, bytes)) return false;
  if (type.is_scalar()) {
    const Constant value = semantics::load(type, bytes);
    variable.initial = value;
  }
  // An input that is CONSTANT has the value of its argument: it cannot be folded.
  if (variable.constant && line.section != Section::Input) variable.value = a_.folded_value(type, bytes);
  if (line.address) return locate(a_, line, variable, bytes);
  variable.open_address = line.open_address;
  if (pou_.kind == PouKind::Function) return place_in_function(variable, bytes);
  if (line.section == Section::Temp) return place_temporary(variable, bytes);
  return place_in_instance(variable, bytes);
}

bool Layout::external(Variable& variable) {
  const auto found = a_.globals.find(variable.name.value);
  if (found == a_.globals.end()) {
    a_.error(code::kMissingExternal, variable.where,
             "there is no global variable " + quote(variable.spelling));
    return false;
  }
  const Variable& global = a_.model.globals[found->second];
  if (global.type == nullptr) return false;
  if (global.type != variable.type) {
    a_.error(code::kTypeMismatch, variable.where,
             "the global " + quote(variable.spelling) + " is " + global.type->name + ", not " +
                 variable.type->name);
    return false;
  }
  variable.place = copy_direct(global.place);
  variable.constant = variable.constant || global.constant;
  variable.value = global.value;
  return true;
}

std::uint32_t Layout::append(const std::vector<std::byte>& bytes) {
  const auto offset = static_cast<std::uint32_t>(instance_.size());
  instance_.insert(instance_.end(), bytes.begin(), bytes.end());
  return offset;
}

bool Layout::place_in_instance(Variable& variable, const std::vector<std::byte>& bytes) {
  if (variable.section == Section::InOut) {
    place_reference(variable);
    return true;
  }
  if (variable.is_referred()) {
    variable.first = a_.allocate_place(variable.type, bytes, variable.where);
    place_reference(variable);
    return true;
  }
  if (instance_.size() > kMaxData - bytes.size()) {
    a_.error(code::kTooLarge, variable.where,
             "the variables of " + quote(pou_.spelling) + " are larger than 32 MiB");
    return false;
  }
  variable.place.base = Base::This;
  variable.place.offset = append(bytes);
  if (variable.edge != syntax::Edge::None) sense_edge(variable);
  return true;
}

// VAR_IN_OUT: the address of the argument, and the bounds of a variable-length array behind it.
void Layout::place_reference(Variable& variable) {
  variable.place.base = Base::ThisRef;
  variable.place.offset = append(std::vector<std::byte>(4, std::byte{0xFF}));  // bytecode::kNullRef
  if (!variable.type->open) return;
  const Type* bound = a_.type_table().elementary(ElementaryType::Dint);
  for (std::size_t i = 0; i < 2 * variable.type->dimensions.size(); ++i) {
    Place place;
    place.base = Base::This;
    place.offset = append(std::vector<std::byte>(bound->size));
    place.type = bound;
    variable.bounds.push_back(std::move(place));
  }
}

// BOOL R_EDGE (6.6.3.4.1): the body reads whether the input rose since the call before, as R_TRIG says it;
// BOOL F_EDGE the same of its fall, which the first call never sees.
void Layout::sense_edge(Variable& variable) {
  const bool rising = variable.edge == syntax::Edge::Rising;
  const Position where = variable.where;
  const auto bit = [&](bool first) {
    Place place;
    place.base = Base::This;
    place.offset = append({first ? std::byte{1} : std::byte{0}});
    place.type = variable.type;
    return place;
  };
  const Place before = bit(!rising);
  variable.edge_place = bit(false);
  const auto value_of = [&](const Place& place, bool negated) {
    ValuePtr value = load(copy_direct(place), where);
    if (!negated) return value;
    ValuePtr inverse = make(ValueKind::Unary, variable.type, where);
    inverse->op = syntax::Operator::Not;
    inverse->operands.push_back(std::move(value));
    return inverse;
  };
  const auto assign = [&](const Place& target, ValuePtr value) {
    Statement statement;
    statement.kind = StatementKind::Assign;
    statement.where = where;
    statement.target = copy_direct(target);
    statement.value = std::move(value);
    pou_.entry.push_back(std::move(statement));
  };
  // `before` holds the input (rising) or its inverse (falling), as the M of R_TRIG and F_TRIG does.
  ValuePtr changed = make(ValueKind::Binary, variable.type, where);
  changed->op = syntax::Operator::And;
  changed->operands.push_back(value_of(variable.place, !rising));
  changed->operands.push_back(value_of(before, true));
  assign(variable.edge_place, std::move(changed));
  assign(before, value_of(variable.place, !rising));
}

// A variable that begins anew with every run.
bool Layout::place_temporary(Variable& variable, const std::vector<std::byte>& bytes) {
  if (variable.constant && variable.value && variable.type->is_scalar()) {
    // Folded wherever it is used: it needs no memory.
    variable.place.base = Base::Slot;
    return true;
  }
  variable.place = variable.type->is_scalar() ? new_slot(variable.type) : frame_place(pou_, variable.type);
  enter(variable, bytes);
  return true;
}

Place Layout::slot_place(std::uint32_t slot, const Type* type) const {
  Place place;
  place.base = Base::Slot;
  place.slot = slot;
  place.type = type;
  return place;
}

Place Layout::new_slot(const Type* type) {
  pou_.slots.push_back(slot_type(*type));
  return slot_place(static_cast<std::uint32_t>(pou_.slots.size() - 1), type);
}

void Layout::enter(const Variable& variable, const std::vector<std::byte>& bytes) {
  const bool is_zero = std::all_of(bytes.begin(), bytes.end(), [](std::byte b) { return b == std::byte{0}; });
  if (variable.type->is_scalar()) {
    // Slots are zero by themselves.
    if (!is_zero || variable.place.base != Base::Slot)
      enter_with(variable.place, *variable.initial, variable.where);
    return;
  }
  Statement copy;
  copy.kind = StatementKind::Assign;
  copy.where = variable.where;
  copy.target = copy_direct(variable.place);
  copy.value = load(a_.allocate_place(variable.type, bytes, variable.where), variable.where);
  copy.initial = true;
  pou_.entry.push_back(std::move(copy));
}

void Layout::enter_with(const Place& place, const Constant& value, Position where) {
  Statement assign;
  assign.kind = StatementKind::Assign;
  assign.where = where;
  assign.target = copy_direct(place);
  assign.value = expressions_.first_value(value, place.type, where);
  pou_.entry.push_back(std::move(assign));
}

void TypeResolver::lay_out(Pou& pou) {
  State& state = layouts_[pou.name.value];
  if (state != State::Open) return;
  state = State::Running;
  Pou* const outer = std::exchange(scope_, &pou);
  Layout(a_, *this, pou).run();
  scope_ = outer;
  layouts_[pou.name.value] = State::Done;
}

}  // namespace stepwright::semantics::internal
