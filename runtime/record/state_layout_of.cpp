// The layout of a program: the symbols of its container, expanded.

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "runtime/bytecode/member_bit.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/record/retain_area.h"
#include "runtime/record/state_layout.h"

namespace stepwright::record {
namespace {

using bytecode::ContainerView;
using bytecode::Section;
using bytecode::TypeKind;

class Expander {
 public:
  Expander(const ContainerView& view, std::vector<StateType>& types, std::vector<StateVariable>& variables)
      : view_(view), types_(types), variables_(variables) {}

  // False if there are too many variables. A container may nest types deeply: each level is a part of the
  // one around it and types lead to earlier ones only, so that the depth ends with the table of types.
  bool add(const std::string& path, std::uint32_t type_index, std::uint32_t address, std::uint8_t bit,
           std::uint16_t flags) {
    if (++visited_ > kMaxVisits || path.size() > kMaxPathBytes) return false;
    const auto type = view_.record<Section::Types>(type_index);
    if (type.size == 0) return true;  // a struct without members
    switch (static_cast<TypeKind>(type.kind)) {
      case TypeKind::Array:
        return add_array(path, type, address, flags);
      case TypeKind::Struct:
      case TypeKind::Instance:
        return add_members(path, type, address, flags);
      default:
        return add_value({path, type_of(type_index, type), address, 1, 0, false, bit, flags});
    }
  }

 private:
  // A hostile container may nest what has long names without end.
  static constexpr std::uint32_t kMaxVisits = 4 * StateLayout::kMaxVariables;
  static constexpr std::size_t kMaxPathBytes = 16u << 10;
  static constexpr std::size_t kMaxTextBytes = 256u << 20;  // of all paths

  bool add_array(const std::string& path, const bytecode::TypeRecord& type, std::uint32_t address,
                 std::uint16_t flags) {
    const auto element = view_.record<Section::Types>(type.first);
    const auto kind = static_cast<TypeKind>(element.kind);
    if (element.size == 0) return true;
    if (kind != TypeKind::Array && kind != TypeKind::Struct && kind != TypeKind::Instance) {
      return add_value({path, type_of(type.first, element), address, type.count,
                        static_cast<std::int32_t>(type.lower), true, bytecode::kNoBit, flags});
    }
    for (std::uint32_t i = 0; i < type.count; ++i) {
      const std::string each = path + "[" + std::to_string(type.lower + i) + "]";
      if (!add(each, type.first, address + i * element.size, bytecode::kNoBit, flags)) return false;
    }
    return true;
  }

  bool add_members(const std::string& path, const bytecode::TypeRecord& type, std::uint32_t address,
                   std::uint16_t flags) {
    for (std::uint32_t i = 0; i < type.count; ++i) {
      const auto member = view_.record<Section::Members>(type.first + i);
      std::uint16_t own = flags;
      if ((member.flags & bytecode::kMemberConstant) != 0) own |= kStateConstant;
      if ((member.flags & bytecode::kMemberHidden) != 0) own |= kStateHidden;
      if (!add(path + "." + reader::text_of(view_, member.name), member.type, address + member.offset,
               bytecode::member_bit(member.flags), own)) {
        return false;
      }
    }
    return true;
  }

  // The trigger of a task may name what another symbol holds already.
  bool add_value(StateVariable variable) {
    text_bytes_ += variable.path.size();
    if (variables_.size() == StateLayout::kMaxVariables || text_bytes_ > kMaxTextBytes) return false;
    const std::string path = variable.path;
    for (std::uint32_t same = 2;; ++same) {
      const auto [known, is_new] =
          known_.try_emplace(naming::upper(variable.path), static_cast<std::uint32_t>(variables_.size()));
      if (is_new) break;
      const StateVariable& other = variables_[known->second];
      if (other.address == variable.address && other.bit == variable.bit) return true;
      variable.path = path + "#" + std::to_string(same);
    }
    variables_.push_back(std::move(variable));
    return true;
  }

  std::uint32_t type_of(std::uint32_t index, const bytecode::TypeRecord& record) {
    const auto [known, is_new] = type_index_.try_emplace(index, static_cast<std::uint32_t>(types_.size()));
    if (!is_new) return known->second;
    StateType type;
    type.kind = static_cast<TypeKind>(record.kind);
    type.elementary = static_cast<bytecode::ElementaryType>(record.elementary);
    type.size = record.size;
    if (type.kind == TypeKind::String) type.capacity = record.count;
    if (type.kind == TypeKind::Subrange) {
      type.lower = record.lower;
      type.upper = record.upper;
    }
    if (type.kind == TypeKind::Enumeration) type.text = enumerators(record);
    if (type.kind == TypeKind::Reference)
      type.text = reader::text_of(view_, view_.record<Section::Types>(record.first).name);
    types_.push_back(std::move(type));
    return known->second;
  }

  std::string enumerators(const bytecode::TypeRecord& type) const {
    std::string text;
    for (std::uint32_t i = 0; i < type.count; ++i) {
      const auto member = view_.record<Section::Members>(type.first + i);
      const std::string name = naming::upper(reader::text_of(view_, member.name));
      text += name + "=" + std::to_string(static_cast<std::int32_t>(member.offset)) + ",";
    }
    return text;
  }

  const ContainerView& view_;
  std::vector<StateType>& types_;
  std::vector<StateVariable>& variables_;
  std::map<std::uint32_t, std::uint32_t> type_index_;  // of the container -> of the layout
  std::unordered_map<std::string, std::uint32_t> known_;
  std::uint32_t visited_ = 0;
  std::size_t text_bytes_ = 0;
};

using Places = std::map<std::pair<std::uint32_t, std::uint8_t>, std::uint16_t>;

// The activities of steps, by their place.
Places steps_of(const ContainerView& view) {
  Places steps;
  for (std::uint32_t i = 0; i < view.count<Section::SfcSteps>(); ++i) {
    const auto step = view.record<Section::SfcSteps>(i);
    const bool initial = (step.flags & bytecode::kStepInitial) != 0;
    steps[{step.address, step.bit}] =
        initial ? kStateStep | kStateInitialStep : static_cast<std::uint16_t>(kStateStep);
  }
  return steps;
}

std::uint16_t symbol_flags(const bytecode::SymbolRecord& symbol) {
  std::uint16_t flags = 0;
  if ((symbol.flags & bytecode::kSymbolLocated) != 0) flags |= kStateLocated;
  if ((symbol.flags & bytecode::kSymbolConstant) != 0) flags |= kStateConstant;
  // The map retains whole bytes: of a bit only its declaration says it.
  const bool bit = symbol.bit != bytecode::kNoBit;
  if (bit && (symbol.flags & bytecode::kSymbolRetain) != 0) flags |= kStateRetain;
  return flags;
}

}  // namespace

result::Result<StateLayout> StateLayout::of(const bytecode::Program& program) {
  const ContainerView& view = program.container();
  StateLayout layout;
  if (view.section(Section::Sizes).empty()) return layout;  // no program
  const bytecode::SizesRecord sizes = program.sizes();
  layout.areas_ = {sizes.input_bytes, sizes.output_bytes, sizes.marker_bytes};
  layout.size_ = program.image_size();
  Expander expander(view, layout.types_, layout.variables_);
  for (std::uint32_t i = 0; i < view.count<Section::Symbols>(); ++i) {
    const auto symbol = view.record<Section::Symbols>(i);
    if (!expander.add(reader::text_of(view, symbol.name), symbol.type, symbol.address, symbol.bit,
                      symbol_flags(symbol))) {
      return result::fail("R0021", {},
                          "the program has more than " + std::to_string(kMaxVariables) + " variables",
                          "make arrays of single values of them");
    }
  }
  const Places steps = steps_of(view);
  const RetainArea retained = RetainArea::of(program);
  for (StateVariable& variable : layout.variables_) {
    const std::uint32_t bytes = variable.count * layout.type_of(variable).size;
    if (variable.address + bytes <= sizes.input_bytes) variable.flags |= kStateInput;
    if (!retained.holds(variable.address, bytes)) {
      variable.flags &= static_cast<std::uint16_t>(~kStateRetain);
    } else if (variable.bit == bytecode::kNoBit) {
      variable.flags |= kStateRetain;
    }
    const auto step = steps.find({variable.address, variable.bit});
    if (step != steps.end()) variable.flags |= step->second;
  }
  layout.index();
  return layout;
}

}  // namespace stepwright::record
