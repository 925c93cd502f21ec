// The variables of functions: parameters in slots, the rest in slots and in the frame.

#include <algorithm>
#include <utility>

#include "ladder/semantics/declarations/layout.h"

namespace stepwright::semantics::internal {

using syntax::VariableDeclaration;

// The parameters of a function are its first slots, so they are numbered before all other variables. See
// model.h for their order.
void Layout::number_parameters() {
  const auto& lines = pou_.declaration->variables;
  const auto add_slots = [&](bool outputs) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Section section = lines[i].section;
      const bool wanted =
          outputs ? section == Section::Output : section == Section::Input || section == Section::InOut;
      if (!wanted) continue;
      const Type* type = line_types_[i];
      const bool by_value = section == Section::Input && type != nullptr && type->is_scalar();
      for (std::size_t name = 0; name < lines[i].names.size(); ++name) {
        pou_.slots.push_back(by_value ? slot_type(*type) : bytecode::StackType::Ref);
        if (type != nullptr && type->open)
          pou_.slots.insert(pou_.slots.end(), 2 * type->dimensions.size(), bytecode::StackType::I32);
      }
    }
  };
  add_slots(false);
  next_output_ = static_cast<std::uint32_t>(pou_.slots.size());
  add_slots(true);
}

void Layout::declare_result() {
  const syntax::PouDeclaration& declaration = *pou_.declaration;
  const Type* type = declaration.result ? types_.resolve(*declaration.result) : nullptr;
  if (type != nullptr && type->kind == TypeKind::Instance) {
    a_.error(code::kBadSection, declaration.result->where,
             "a function cannot have a function block as result");
    type = nullptr;
  }
  const bool in_memory = type != nullptr && !type->is_scalar();
  if (in_memory) pou_.slots.push_back(bytecode::StackType::Ref);
  pou_.parameter_count = static_cast<std::uint16_t>(std::min<std::size_t>(pou_.slots.size(), 0xFFFF));
  pou_.has_result = declaration.result != nullptr;
  if (!pou_.has_result) return;
  pou_.result = type;
  Variable result;
  result.name = declaration.name.id;
  result.spelling = pou_.spelling;
  result.type = type;
  result.where = declaration.name.where;
  if (type == nullptr) return add(std::move(result));
  const std::vector<std::byte> bytes = types_.initial_of(*declaration.result, *type);
  if (in_memory) {
    result.place = slot_place(static_cast<std::uint32_t>(pou_.slots.size() - 1), type);
    result.place.base = Base::SlotRef;
  } else {
    result.place = new_slot(type);
    result.initial = semantics::load(*type, bytes);
  }
  pou_.result_slot = result.place.slot;
  enter(result, bytes);
  add(std::move(result));
}

bool Layout::place_in_function(Variable& variable, const std::vector<std::byte>& bytes) {
  if (variable.section == Section::Input || variable.section == Section::InOut) {
    place_parameter(variable, bytes);
    return true;
  }
  if (variable.section != Section::Output) return place_temporary(variable, bytes);
  variable.place = slot_place(next_output_++, variable.type);
  variable.place.base = Base::SlotRef;
  enter(variable, bytes);
  return true;
}

void Layout::place_parameter(Variable& variable, const std::vector<std::byte>& bytes) {
  const Type& type = *variable.type;
  const bool by_value = variable.section == Section::Input && type.is_scalar();
  variable.place = slot_place(next_parameter_++, variable.type);
  if (by_value) return;
  variable.place.base = Base::SlotRef;
  if (type.open) {
    const Type* bound = a_.type_table().elementary(ElementaryType::Dint);
    for (std::size_t i = 0; i < 2 * type.dimensions.size(); ++i)
      variable.bounds.push_back(slot_place(next_parameter_++, bound));
  } else if (variable.section == Section::Input) {
    variable.first = a_.allocate_place(variable.type, bytes, variable.where);
  }
}

}  // namespace stepwright::semantics::internal
