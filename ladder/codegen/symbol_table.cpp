#include "ladder/codegen/symbol_table.h"

#include <algorithm>
#include <utility>

#include "runtime/bytecode/member_bit.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::codegen {

using bytecode::SymbolSection;
using semantics::Base;
using semantics::Pou;
using semantics::Retention;
using semantics::Type;
using semantics::TypeKind;
using semantics::Variable;

namespace {

std::uint16_t flags_of(const Variable& variable) {
  std::uint16_t flags = 0;
  if (variable.retain) flags |= bytecode::kSymbolRetain;
  if (variable.address) flags |= bytecode::kSymbolLocated;
  if (variable.constant) flags |= bytecode::kSymbolConstant;
  return flags;
}

// Lies in the instance of its POU, with a value of its own.
bool is_member(const Variable& variable) {
  return variable.place.base == Base::This && variable.section != semantics::Section::External;
}

bool holds_blocks(const Type& type) {
  if (type.kind == TypeKind::Array) return holds_blocks(*type.element);
  if (type.kind == TypeKind::Instance) return true;
  return std::any_of(type.fields.begin(), type.fields.end(),
                     [](const semantics::Field& each) { return holds_blocks(*each.type); });
}

const Pou* block_of(const Type& type) {
  if (type.kind == TypeKind::Array) return block_of(*type.element);
  return type.kind == TypeKind::Instance ? type.pou : nullptr;
}

std::unordered_map<std::string, const Variable*> variables_by_name(const Pou& pou) {
  std::unordered_map<std::string, const Variable*> variables;
  for (const Variable& each : pou.variables) variables.try_emplace(naming::upper(each.spelling), &each);
  return variables;
}

}  // namespace

// Two types of one name (structures without a name) get different ones.
std::uint32_t SymbolTable::add(writer::Type type) {
  constexpr std::size_t kLongestName = bytecode::kMaxStringBytes - 16;  // with room for a number
  type.name = ContainerLimits::name(std::move(type.name), kLongestName);
  const std::uint32_t same = names_[type.name]++;
  if (same > 0) type.name += "#" + std::to_string(same + 1);
  out_.types.push_back(std::move(type));
  return static_cast<std::uint32_t>(out_.types.size() - 1);
}

std::uint32_t SymbolTable::type(const Type& type) {
  if (const auto known = types_.find(&type); known != types_.end()) return known->second;
  std::uint32_t index = 0;
  if (type.kind == TypeKind::Array) {
    index = array_type(type, 0);
  } else if (type.kind == TypeKind::Struct || type.kind == TypeKind::Instance) {
    index = member_type(type);
  } else if (type.kind == TypeKind::Enumeration) {
    index = enumeration_type(type);
  } else if (type.kind == TypeKind::Subrange) {
    index = subrange_type(type);
  } else if (type.kind == TypeKind::Reference) {
    index = reference_type(type);
  } else if (type.kind == TypeKind::String) {
    index = add(writer::string_type(type.elementary, type.capacity));
  } else {
    index = add(writer::elementary(type.elementary));
  }
  types_.emplace(&type, index);
  return index;
}

// Several dimensions are arrays of arrays, the last dimension innermost.
std::uint32_t SymbolTable::array_type(const Type& type, std::size_t dimension) {
  const bool innermost = dimension + 1 == type.dimensions.size();
  writer::Type out;
  out.element = innermost ? this->type(*type.element) : array_type(type, dimension + 1);
  const semantics::Dimension& bounds = type.dimensions[dimension];
  out.kind = bytecode::TypeKind::Array;
  out.count = bounds.count();
  out.lower = bounds.lower;
  out.size = out.count * out_.types[out.element].size;
  out.name = "ARRAY[" + std::to_string(bounds.lower) + ".." + std::to_string(bounds.upper) + "] OF " +
             out_.types[out.element].name;
  return add(std::move(out));
}

std::uint32_t SymbolTable::enumeration_type(const Type& type) {
  writer::Type out;
  out.name = type.name;
  out.kind = bytecode::TypeKind::Enumeration;
  out.elementary = type.elementary;
  out.size = type.size;
  for (const semantics::Enumerator& each : type.enumerators)
    out.members.push_back({each.spelling, 0, static_cast<std::uint32_t>(each.value)});
  return add(std::move(out));
}

std::uint32_t SymbolTable::subrange_type(const Type& type) {
  writer::Type out;
  out.name = type.name;
  out.kind = bytecode::TypeKind::Subrange;
  out.elementary = type.elementary;
  out.size = type.size;
  out.lower = static_cast<std::int64_t>(type.range.low);
  out.upper = static_cast<std::int64_t>(type.range.high);
  return add(std::move(out));
}

std::uint32_t SymbolTable::reference_type(const Type& type) {
  writer::Type out;
  out.name = type.name;
  out.kind = bytecode::TypeKind::Reference;
  out.size = type.size;
  const std::uint32_t index = add(std::move(out));
  references_.emplace_back(index, type.element);
  return index;
}

void SymbolTable::add_member(const Variable& variable, std::vector<writer::Member>& out) {
  // An input that is CONSTANT has the value of its latest argument.
  const bool constant = variable.constant && variable.section != semantics::Section::Input;
  const std::uint32_t type = this->type(*variable.type);
  const std::uint32_t offset = variable.place.offset;
  out.push_back({variable.spelling, type, offset, constant ? bytecode::kMemberConstant : 0u});
  // R_EDGE, F_EDGE: behind the input lies what it was at the call before.
  if (variable.edge == syntax::Edge::None) return;
  out.push_back({variable.spelling + "#BEFORE", type, offset + variable.type->size, bytecode::kMemberHidden});
}

std::uint32_t SymbolTable::member_type(const Type& type) {
  writer::Type out;
  out.name = type.name;
  out.size = type.size;
  out.kind = type.kind == TypeKind::Struct ? bytecode::TypeKind::Struct : bytecode::TypeKind::Instance;
  for (const semantics::Field& each : type.fields)
    out.members.push_back({each.spelling, this->type(*each.type), each.offset,
                           each.bit == bytecode::kNoBit ? 0u : bytecode::bit_member(each.bit)});
  if (type.pou != nullptr) {
    for (const Variable& each : type.pou->variables)
      // VAR_CONFIG gives an open address a symbol of its own.
      if (is_member(each) && !each.open_address) add_member(each, out.members);
  }
  return add(std::move(out));
}

void SymbolTable::variable(const Variable& variable, const std::string& path, SymbolSection section) {
  layout_.limits->check_path(path, variable.where);
  writer::Symbol symbol;
  symbol.name = path;
  symbol.type = type(*variable.type);
  symbol.address = layout_.address(variable.place);
  symbol.bit = variable.place.bit;
  symbol.section = section;
  symbol.flags = flags_of(variable);
  if (variable.address) symbol.direct_address = syntax::to_string(*variable.address);
  if (variable.place.base != Base::Input) retain(variable, symbol.address, Retention::Unsaid);
  out_.symbols.push_back(std::move(symbol));
}

void SymbolTable::globals() {
  for (const Variable& each : model_.globals) variable(each, each.spelling, SymbolSection::Global);
}

void SymbolTable::configured() {
  for (const Variable& each : model_.configured) variable(each, each.spelling, SymbolSection::Local);
}

std::uint32_t SymbolTable::trigger(const semantics::Trigger& trigger) {
  writer::Symbol symbol;
  symbol.name = ContainerLimits::name(trigger.name);
  symbol.type = type(*trigger.place.type);
  symbol.address = layout_.address(trigger.place);
  symbol.bit = trigger.place.bit;
  symbol.section = SymbolSection::Global;
  for (std::size_t i = 0; i < out_.symbols.size(); ++i) {
    const writer::Symbol& known = out_.symbols[i];
    if (known.type == symbol.type && known.address == symbol.address && known.bit == symbol.bit)
      return static_cast<std::uint32_t>(i);
  }
  out_.symbols.push_back(std::move(symbol));
  return static_cast<std::uint32_t>(out_.symbols.size() - 1);
}

// A word of the variable itself counts more than that of the block or program around it (6.5.6.1).
void SymbolTable::retain(const Variable& variable, std::uint32_t address, Retention retention) {
  if (variable.retain) retention = Retention::Kept;
  if (variable.non_retain) retention = Retention::Lost;
  retain(*variable.type, address, retention);
  // The memory of an edge lies behind its input.
  if (retention == Retention::Kept && variable.edge != syntax::Edge::None)
    out_.retain.push_back({address, 3u * variable.type->size});
}

void SymbolTable::retain(const Type& type, std::uint32_t address, Retention retention) {
  const Pou* block = block_of(type);
  if (retention != Retention::Kept &&
      (block == nullptr ? type.kind != TypeKind::Struct : !speaks_of_retain(*block)))
    return;
  if (!holds_blocks(type)) {
    if (retention == Retention::Kept) out_.retain.push_back({address, type.size});
    return;
  }
  if (type.kind == TypeKind::Array) {
    for (std::uint32_t at = 0; at < type.size; at += type.element->size)
      retain(*type.element, address + at, retention);
  }
  for (const semantics::Field& each : type.fields) retain(*each.type, address + each.offset, retention);
  if (type.kind != TypeKind::Instance) return;
  for (const Variable& each : type.pou->variables)
    if (is_member(each)) retain(each, address + each.place.offset, retention);
}

void SymbolTable::instance(const semantics::ProgramInstance& instance,
                           const std::vector<ChartOrigin>& charts) {
  const Pou& pou = *instance.program;
  const std::uint32_t address = layout_.bases[static_cast<std::size_t>(Base::Data)] + instance.offset;
  writer::Symbol symbol;
  symbol.name = instance.name;
  symbol.type = type(*pou.type);
  symbol.address = address;
  out_.symbols.push_back(std::move(symbol));
  for (const Variable& each : pou.variables) {
    const bool located = each.address.has_value();
    if (located) variable(each, instance.name + "." + each.spelling, SymbolSection::Local);
  }
  retain(*pou.type, address, instance.retention);
  walk(instance.name, pou, address, charts);
}

bool SymbolTable::holds_charts(const Pou& pou, const std::vector<ChartOrigin>& charts) {
  if (const auto known = holds_charts_.find(&pou); known != holds_charts_.end()) return known->second;
  bool holds =
      std::any_of(charts.begin(), charts.end(), [&](const ChartOrigin& each) { return each.pou == &pou; });
  for (const Variable& each : pou.variables)
    if (!holds && is_member(each) && each.type->kind == TypeKind::Instance)
      holds = holds_charts(*each.type->pou, charts);
  holds_charts_[&pou] = holds;
  return holds;
}

bool SymbolTable::speaks_of_retain(const Pou& pou) {
  if (const auto known = speaks_of_retain_.find(&pou); known != speaks_of_retain_.end()) return known->second;
  bool speaks = false;
  for (const Variable& each : pou.variables) {
    if (speaks || !is_member(each)) continue;
    const Pou* block = block_of(*each.type);
    speaks = each.retain || each.non_retain || (block != nullptr && speaks_of_retain(*block));
  }
  speaks_of_retain_[&pou] = speaks;
  return speaks;
}

void SymbolTable::walk(const std::string& path, const Pou& pou, std::uint32_t address,
                       const std::vector<ChartOrigin>& charts) {
  if (!holds_charts(pou, charts)) return;
  for (const ChartOrigin& each : charts)
    if (each.pou == &pou) chart(path, each, address);
  for (const Variable& each : pou.variables) {
    if (!is_member(each)) continue;
    if (each.type->kind == TypeKind::Instance)
      walk(path + "." + each.spelling, *each.type->pou, address + each.place.offset, charts);
  }
}

void SymbolTable::chart(const std::string& path, const ChartOrigin& origin, std::uint32_t address) {
  ContainerLimits& limits = *layout_.limits;
  limits.check_path(path, origin.pou->where);
  writer::SfcChart out;
  out.name = path;
  const auto variables = variables_by_name(*origin.pou);
  const auto place = [&](const std::string& name) {
    const auto found = variables.find(naming::upper(name));
    return found != variables.end() && found->second->place.base == Base::This
               ? address + found->second->place.offset
               : bytecode::kNoIndex;
  };
  for (const ChartStep& step : origin.steps) {
    const std::uint32_t active = place(step.variable);
    // A chart whose steps cannot be found in the image would mislead a viewer.
    if (active == bytecode::kNoIndex) return;
    out.steps.push_back({step.name, limits.text(step.comment), active, bytecode::kNoBit, step.initial});
  }
  for (const ChartTransition& each : origin.transitions)
    out.transitions.push_back({each.name, limits.text(each.condition), each.sources, each.targets,
                               place(each.variable), bytecode::kNoBit});
  out_.charts.push_back(std::move(out));
}

void SymbolTable::finish() {
  // Completing one may bring another.
  for (std::size_t i = 0; i < references_.size(); ++i) {
    const auto [index, target] = references_[i];
    const std::uint32_t element = type(*target);
    out_.types[index].element = element;
  }
  auto& retain = out_.retain;
  std::sort(retain.begin(), retain.end(), [](const auto& l, const auto& r) { return l.address < r.address; });
  std::vector<bytecode::RetainRecord> joined;
  for (const bytecode::RetainRecord& each : retain) {
    if (!joined.empty() && each.address <= joined.back().address + joined.back().size) {
      const std::uint32_t end =
          std::max(joined.back().address + joined.back().size, each.address + each.size);
      joined.back().size = end - joined.back().address;
    } else {
      joined.push_back(each);
    }
  }
  retain = std::move(joined);
}

}  // namespace stepwright::codegen
