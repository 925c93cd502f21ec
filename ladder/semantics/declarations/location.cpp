// Variables with addresses of %I, %Q and %M (IEC 61131-3, 6.5.5).

#include <algorithm>

#include "ladder/semantics/analysis/hierarchical_address.h"
#include "ladder/semantics/declarations/declarer.h"

namespace stepwright::semantics::internal {

namespace {

// Grows the area to hold the address and its type; false after a report.
bool fits_address(Analysis& a, const syntax::VariableDeclaration& line, const Type& type) {
  const syntax::DirectAddress& address = *line.address;
  if (type.kind == TypeKind::Instance) {
    a.error(code::kAddressSize, line.address_where, "a function block has no address");
    return false;
  }
  const unsigned bits = type.is_scalar() ? type.bit_count() : 0;
  // An array or a structure begins at a byte address; a value has an address of its own size.
  const bool sound = bits != 0 ? bits == address.bits : address.bits != 1;
  const bool smaller = bits > 1 && bits < address.bits;
  const char* const hint = bits == 1    ? "a BOOL has an address like %IX0.0"
                           : bits == 8  ? "use an address like %IB0"
                           : bits == 16 ? "use an address like %IW0"
                           : bits == 32 ? "use an address like %ID0"
                                        : "use an address like %IL0";
  if (!sound && !(smaller && a.dialect->loose_addresses)) {
    a.error(code::kAddressSize, line.address_where,
            type.name + " does not fit to " + syntax::to_string(address) + ", which has " +
                std::to_string(address.bits) + (address.bits == 1 ? " bit" : " bits"),
            smaller ? source::with_dialects(hint, &source::Dialect::loose_addresses) : hint);
    return false;
  }
  const std::size_t first = address.byte < syntax::kHierarchical ? address.byte : 0;
  if (first + type.size > syntax::kAreaLimit) {
    a.error(code::kBadAddress, line.address_where, "the variable reaches beyond the area's 64 KiB");
    return false;
  }
  return true;
}

// Bits of the area that a variable takes, as [first, last).
struct Extent {
  Base area;
  std::uint64_t first;
  std::uint64_t last;
  const Variable* variable;
};

Extent extent_of(const Variable& variable) {
  const Place& place = variable.place;
  const std::uint64_t first =
      std::uint64_t{place.offset} * 8 + (place.bit == bytecode::kNoBit ? 0 : place.bit);
  const std::uint64_t bits = place.bit == bytecode::kNoBit ? std::uint64_t{place.type->size} * 8 : 1;
  return {place.base, first, first + bits, &variable};
}

}  // namespace

bool locate(Analysis& a, const syntax::VariableDeclaration& line, Variable& variable,
            std::span<const std::byte> initial) {
  const Type& type = *variable.type;
  if (line.names.size() > 1) {
    a.error(code::kBadAddress, line.address_where, "an address belongs to one variable",
            "declare each variable with its own address");
    return false;
  }
  if (!fits_address(a, line, type)) return false;
  syntax::DirectAddress address = *line.address;
  // A smaller value is at the address of its own size that begins there (Dialect::loose_addresses).
  if (type.is_scalar()) address.bits = static_cast<std::uint8_t>(type.bit_count());
  variable.address = address;
  variable.place.base = static_cast<Base>(address.area);
  variable.place.bit = address.bits == 1 ? address.bit : bytecode::kNoBit;
  if (address.byte >= syntax::kHierarchical) {
    variable.place.offset = hierarchical_offset(a, address, type.size, line.address_where);
    auto& first =
        a.model.hierarchical[(variable.place.offset - kHierarchicalPlace) / kHierarchicalStride].first;
    std::copy(initial.begin(), initial.end(), first.begin());
    a.note_references(type, initial, variable.place.base, variable.place.offset, variable.where);
    return true;
  }
  variable.place.offset = address.byte;
  auto& area = a.model.area(variable.place.base);
  const std::size_t end = std::size_t{address.byte} + type.size;
  if (area.size() < end) area.resize(end);
  if (address.bits == 1) {
    if (initial[0] != std::byte{0}) area[address.byte] |= std::byte{1} << address.bit;
  } else {
    std::copy(initial.begin(), initial.end(), area.begin() + address.byte);
    a.note_references(type, initial, variable.place.base, address.byte, variable.where);
  }
  return true;
}

void declare_direct(Analysis& a, TypeResolver& types, ExpressionAnalyzer& expressions,
                    const syntax::VariableDeclaration& line, const Type& type) {
  if (!line.address) return;
  Variable variable;
  variable.type = variable.place.type = &type;
  variable.where = line.address_where;
  std::vector<std::byte> bytes = types.initial_of(*line.type, type);
  if (line.initial && !initialise(a, expressions, *line.initial, type, bytes)) return;
  if (locate(a, line, variable, bytes)) a.direct_types.emplace_back(*line.address, &type);
}

void check_overlaps(Analysis& a) {
  std::vector<Extent> extents;
  for (const Variable& each : a.model.globals)
    if (each.address && each.type != nullptr) extents.push_back(extent_of(each));
  for (const Variable& each : a.model.configured) extents.push_back(extent_of(each));
  // A test gives names of its own to the places of the program.
  for (const auto& pou : a.model.pous)
    for (const Variable& each : pou->variables)
      if (pou->test == nullptr && each.address && each.type != nullptr) extents.push_back(extent_of(each));
  std::stable_sort(extents.begin(), extents.end(), [](const Extent& l, const Extent& r) {
    return l.area != r.area ? l.area < r.area : l.first < r.first;
  });
  const Extent* reach = nullptr;  // the one that reaches farthest so far
  for (const Extent& each : extents) {
    const bool overlaps = reach != nullptr && reach->area == each.area && each.first < reach->last;
    if (overlaps) {
      const bool written = each.area == Base::Output;
      a.sink.warning(code::kOverlap, each.variable->where,
                     quote(each.variable->spelling) + " at " + syntax::to_string(*each.variable->address) +
                         " overlaps " + quote(reach->variable->spelling) + " at " +
                         syntax::to_string(*reach->variable->address) +
                         (written ? ": both write the same byte" : ""),
                     "if that is not meant, declare an address once, in VAR_GLOBAL if several POUs use it");
    }
    if (reach == nullptr || reach->area != each.area || each.last > reach->last) reach = &each;
  }
}

}  // namespace stepwright::semantics::internal
