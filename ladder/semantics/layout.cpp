// The variables of a POU: which memory each takes and what it starts with (IEC 61131-3, 6.5.2 and 6.6).

#include <algorithm>
#include <utility>

#include "ladder/semantics/internal/declarer.h"

namespace stepwright::semantics::internal {

namespace {

using syntax::VariableDeclaration;

const char* section_name(Section section) {
  static constexpr const char* kNames[] = {"VAR",        "VAR_TEMP",     "VAR_INPUT", "VAR_OUTPUT",
                                           "VAR_IN_OUT", "VAR_EXTERNAL", "VAR_GLOBAL"};
  return kNames[static_cast<std::size_t>(section)];
}

class Layout {
 public:
  Layout(Analysis& analysis, TypeResolver& types, Pou& pou)
      : a_(analysis), types_(types), pou_(pou), expressions_(analysis, &pou) {}

  void run() {
    const syntax::PouDeclaration& declaration = *pou_.declaration;
    if (pou_.kind == PouKind::Function) parameter_slots();
    for (const VariableDeclaration& line : declaration.variables) {
      const Type* type = types_.resolve(*line.type);
      if (type != nullptr && !allowed(line, *type)) type = nullptr;
      for (const syntax::Name& name : line.names) declare(line, name, type);
    }
    if (pou_.type != nullptr) {
      auto* type = const_cast<Type*>(pou_.type);  // complete only now, as the POU is
      // An instance without variables still has an address.
      if (instance_.empty()) instance_.resize(1);
      type->size = static_cast<std::uint32_t>(instance_.size());
      type->initial = std::move(instance_);
    }
  }

 private:
  // The parameters of a function are its first slots, so they are numbered before all other variables.
  void parameter_slots() {
    for (const VariableDeclaration& line : pou_.declaration->variables) {
      if (line.section != Section::Input && line.section != Section::InOut) continue;
      const Type* type = types_.resolve(*line.type);
      for (std::size_t i = 0; i < line.names.size(); ++i) {
        const bool by_value = line.section == Section::Input && type != nullptr && type->is_scalar();
        pou_.slots.push_back(by_value ? slot_type(*type) : bytecode::StackType::Ref);
      }
    }
    pou_.parameter_count = static_cast<std::uint16_t>(std::min<std::size_t>(pou_.slots.size(), 0xFFFF));
    declare_result();
  }

  void declare_result() {
    const syntax::PouDeclaration& declaration = *pou_.declaration;
    if (!declaration.result) {
      a_.error(code::kUnknownType, declaration.name.where, "the function has no result type",
               "write FUNCTION " + pou_.spelling + " : INT");
      return;
    }
    const Type* type = types_.resolve(*declaration.result);
    if (type == nullptr) return;
    if (!type->is_scalar()) {
      a_.error(code::kNotSupported, declaration.result->where,
               "the result of a function must be a single value",
               "return it through VAR_OUTPUT or VAR_IN_OUT");
      return;
    }
    pou_.result = type;
    Variable result;
    result.name = declaration.name.id;
    result.spelling = pou_.spelling;
    result.type = type;
    result.where = declaration.name.where;
    result.place = new_slot(type);
    pou_.result_slot = result.place.slot;
    if (!type->initial.empty()) enter_with(result.place, semantics::load(*type, type->initial), result.where);
    add(std::move(result));
  }

  bool allowed(const VariableDeclaration& line, const Type& type) {
    const bool is_function = pou_.kind == PouKind::Function;
    std::string why;
    if (line.section == Section::Global) {
      why = "VAR_GLOBAL stands in a configuration or outside of POUs";
    } else if (line.section == Section::External && is_function) {
      why = "a function sees no globals through VAR_EXTERNAL";
    } else if (type.kind == TypeKind::Instance && (is_function || line.section == Section::Temp) &&
               line.section != Section::InOut) {
      why = "a function block keeps its state and cannot live in a " +
            std::string(is_function ? "function" : "VAR_TEMP");
    } else if (line.constant && (line.section == Section::InOut || line.section == Section::Output)) {
      why = std::string(section_name(line.section)) + " cannot be CONSTANT";
    } else if (line.address && (pou_.kind != PouKind::Program || line.section != Section::Local)) {
      a_.error(code::kAddressNotHere, line.address_where,
               "an address stands in VAR of a program or in VAR_GLOBAL");
      return false;
    } else if (line.initial && (line.section == Section::InOut || line.section == Section::External)) {
      why = std::string(section_name(line.section)) + " takes no first value";
    }
    if (why.empty()) return true;
    a_.error(code::kBadSection, line.names.front().where, why);
    return false;
  }

  void declare(const VariableDeclaration& line, const syntax::Name& name, const Type* type) {
    Variable variable;
    variable.name = name.id;
    variable.spelling = std::string(name.text);
    variable.type = type;
    variable.section = line.section;
    variable.constant = line.constant;
    variable.retain = line.retain;
    variable.where = name.where;
    variable.place.type = type;
    if (line.section == Section::Input || line.section == Section::InOut) ++next_parameter_;
    if (type != nullptr && !place(line, variable)) variable.type = nullptr;
    add(std::move(variable));
  }

  void add(Variable variable) {
    const auto index = static_cast<std::uint32_t>(pou_.variables.size());
    if (!pou_.scope.try_emplace(variable.name.value, index).second) {
      a_.error(code::kDuplicate, variable.where,
               "there is another variable " + quote(variable.spelling) + " in " + quote(pou_.spelling));
      return;
    }
    pou_.variables.push_back(std::move(variable));
  }

  bool place(const VariableDeclaration& line, Variable& variable) {
    if (line.section == Section::External) return external(variable);
    const Type& type = *variable.type;
    std::vector<std::byte> bytes = type.initial;
    bytes.resize(type.size);
    if (line.initial && !initialise(a_, expressions_, *line.initial, type, bytes)) return false;
    if (type.is_scalar()) {
      const Constant value = semantics::load(type, bytes);
      // An input that is CONSTANT has the value of its argument: it cannot be folded.
      if (variable.constant && line.section != Section::Input) variable.value = value;
      variable.initial = value;
    }
    if (line.address) return locate(a_, line, variable, bytes);
    if (pou_.kind == PouKind::Function) return place_in_function(variable, bytes);
    if (line.section == Section::Temp) return place_temporary(variable, bytes);
    return place_in_instance(variable, bytes);
  }

  bool external(Variable& variable) {
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
    variable.place = ExpressionAnalyzer::copy_direct(global.place);
    variable.constant = variable.constant || global.constant;
    variable.value = global.value;
    return true;
  }

  bool place_in_instance(Variable& variable, const std::vector<std::byte>& bytes) {
    variable.place.offset = static_cast<std::uint32_t>(instance_.size());
    if (variable.section == Section::InOut) {
      variable.place.base = Base::ThisRef;
      instance_.insert(instance_.end(), 4, std::byte{0xFF});  // bytecode::kNullRef
      return true;
    }
    if (instance_.size() > kMaxData - bytes.size()) {
      a_.error(code::kTooLarge, variable.where,
               "the variables of " + quote(pou_.spelling) + " are larger than 32 MiB");
      return false;
    }
    variable.place.base = Base::This;
    instance_.insert(instance_.end(), bytes.begin(), bytes.end());
    return true;
  }

  bool place_in_function(Variable& variable, const std::vector<std::byte>& bytes) {
    const bool is_parameter = variable.section == Section::Input || variable.section == Section::InOut;
    if (!is_parameter && variable.section != Section::Output) return place_temporary(variable, bytes);
    if (is_parameter) {
      const bool by_value = variable.section == Section::Input && variable.type->is_scalar();
      variable.place.base = by_value ? Base::Slot : Base::SlotRef;
      variable.place.slot = next_parameter_ - 1;
      return true;
    }
    variable.place = a_.allocate_place(variable.type, variable.where);
    enter(variable, bytes);
    return true;
  }

  // A variable that begins anew with every call.
  bool place_temporary(Variable& variable, const std::vector<std::byte>& bytes) {
    if (variable.constant && variable.value) {
      // Folded wherever it is used: it needs no memory.
      variable.place.base = Base::Slot;
      return true;
    }
    variable.place = variable.type->is_scalar() ? new_slot(variable.type)
                                                : a_.allocate_place(variable.type, variable.where);
    enter(variable, bytes);
    return true;
  }

  Place new_slot(const Type* type) {
    Place slot;
    slot.base = Base::Slot;
    slot.slot = static_cast<std::uint32_t>(pou_.slots.size());
    slot.type = type;
    pou_.slots.push_back(slot_type(*type));
    return slot;
  }

  // At the start of each run: the first value. Slots are zero by themselves.
  void enter(const Variable& variable, const std::vector<std::byte>& bytes) {
    const bool is_zero =
        std::all_of(bytes.begin(), bytes.end(), [](std::byte b) { return b == std::byte{0}; });
    if (variable.type->is_scalar()) {
      if (!is_zero || variable.place.base != Base::Slot)
        enter_with(variable.place, *variable.initial, variable.where);
      return;
    }
    Place model = a_.allocate_place(variable.type, variable.where);
    std::copy(bytes.begin(), bytes.end(), a_.model.area(Base::Data).begin() + model.offset);
    Statement copy;
    copy.kind = StatementKind::Assign;
    copy.where = variable.where;
    copy.target = ExpressionAnalyzer::copy_direct(variable.place);
    copy.value = ExpressionAnalyzer::load(std::move(model), variable.where);
    pou_.entry.push_back(std::move(copy));
  }

  void enter_with(const Place& place, const Constant& value, Position where) {
    Statement assign;
    assign.kind = StatementKind::Assign;
    assign.where = where;
    assign.target = ExpressionAnalyzer::copy_direct(place);
    assign.value = ExpressionAnalyzer::make_constant(value, place.type, where);
    pou_.entry.push_back(std::move(assign));
  }

  Analysis& a_;
  TypeResolver& types_;
  Pou& pou_;
  ExpressionAnalyzer expressions_;
  std::vector<std::byte> instance_;
  std::uint32_t next_parameter_ = 0;
};

}  // namespace

void TypeResolver::lay_out(Pou& pou) {
  State& state = layouts_[pou.name.value];
  if (state != State::Open) return;
  state = State::Running;
  Layout(a_, *this, pou).run();
  layouts_[pou.name.value] = State::Done;
}

}  // namespace stepwright::semantics::internal
