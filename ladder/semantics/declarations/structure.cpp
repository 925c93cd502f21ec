// Structures (IEC 61131-3, 6.4.4.6), with places of their members and OVERLAP (6.4.4.7).

#include <algorithm>
#include <utility>

#include "ladder/semantics/declarations/declarer.h"

namespace stepwright::semantics::internal {

namespace {

using syntax::VariableDeclaration;

// Bits of the structure that a member takes, as [first, last).
struct MemberExtent {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  const Field* field = nullptr;  // of the structure, in their order
  const VariableDeclaration* line = nullptr;
  bool shares = false;
};

MemberExtent extent_of(const Field& field, const VariableDeclaration& line) {
  const bool is_bit = field.bit != bytecode::kNoBit;
  const std::uint64_t first = std::uint64_t{field.offset} * 8 + (is_bit ? field.bit : 0);
  return {first, first + (is_bit ? 1 : std::uint64_t{field.type->size} * 8), &field, &line};
}

// Whatever bits others leave in it are a value of the type. A BOOL byte is 0 or 1, an enumeration and a
// subrange have values that they are not, dates have bounds, references and strings lead to memory.
bool is_any_bits(const Type& type) {
  switch (type.kind) {
    case TypeKind::Elementary:
      return !type.is_bool() && !type.is_date();
    case TypeKind::Array:
      return is_any_bits(*type.element);
    case TypeKind::Struct:
      return std::ranges::all_of(type.fields, [](const Field& each) {
        return each.bit != bytecode::kNoBit || is_any_bits(*each.type);
      });
    default:
      return false;
  }
}

// At its place, or at `next` if it has none.
Field field_of(const syntax::Name& name, const VariableDeclaration& line, const Type* type,
               std::uint32_t next) {
  Field field{name.id, std::string(name.text), type, next};
  if (line.relative) field.offset = line.relative->byte;
  if (line.relative && line.relative->bits == 1) field.bit = line.relative->bit;
  return field;
}

// Fills in what a member starts with. What was not written down by the declaration itself says nothing where
// it is zero: another member may lie there.
void put(const Field& field, std::span<const std::byte> bytes, bool is_written, std::span<std::byte> memory) {
  if (field.bit != bytecode::kNoBit) {
    if (is_written || bytes[0] != std::byte{0}) set_bit(memory[field.offset], field.bit, bytes[0]);
    return;
  }
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (is_written || bytes[i] != std::byte{0}) memory[field.offset + i] = bytes[i];
}

}  // namespace

void set_bit(std::byte& byte, std::uint8_t bit, std::byte value) {
  const std::byte mask = std::byte{1} << bit;
  byte = value != std::byte{0} ? byte | mask : byte & ~mask;
}

const Type* TypeResolver::structure(const syntax::TypeSpec& spec, Type& out) {
  Type* type = &out;
  type->size = 0;
  const bool has_places =
      std::ranges::any_of(spec.fields, [](const auto& each) { return each.relative.has_value(); });
  ExpressionAnalyzer expressions(a_, scope_);
  std::vector<const VariableDeclaration*> lines;  // of the fields
  struct Written {
    std::size_t field = 0;
    std::vector<std::byte> bytes;
  };
  std::vector<Written> written;
  bool sound = true;
  for (const VariableDeclaration& line : spec.fields) {
    const Type* field_type = resolve(*line.type);
    sound = field_type != nullptr && is_member_line(line, *field_type) &&
            (!has_places || is_placed(line, *field_type)) && sound;
    if (field_type == nullptr) continue;
    type->nesting = std::max(type->nesting, field_type->nesting + 1);
    if (!is_shallow(*type, line.type->where)) return nullptr;
    std::vector<std::byte> bytes = initial_of(*line.type, *field_type);
    if (line.initial) sound = initialise(a_, expressions, *line.initial, *field_type, bytes) && sound;
    for (const syntax::Name& each : line.names) {
      const Field field = field_of(each, line, field_type, spec.overlap ? 0 : type->size);
      if (field.offset > kMaxData - field_type->size) {
        a_.error(code::kTooLarge, each.where, "the structure is larger than 32 MiB");
        return nullptr;
      }
      if (!type->add(field)) {
        a_.error(code::kDuplicate, each.where, "there is another member " + quote(each.text));
        continue;
      }
      const std::uint32_t end = std::max(type->size, field.offset + field_type->size);
      if (!affords(end - type->size, line.type->where)) return nullptr;
      type->size = end;
      type->initial.resize(end);
      lines.push_back(&line);
      if (line.initial && spec.overlap)
        written.push_back({type->fields.size() - 1, bytes});
      else
        put(field, bytes, line.initial != nullptr, type->initial);
    }
  }
  if (type->fields.empty() && sound) {
    a_.error(code::kTooLarge, spec.where, "the structure has no members");
    return nullptr;
  }
  for (const Written& each : written) put(type->fields[each.field], each.bytes, true, type->initial);
  if (sound && (has_places || spec.overlap)) sound = share_soundly(*type, lines, spec.overlap);
  return sound ? type : nullptr;
}

bool TypeResolver::is_member_line(const VariableDeclaration& line, const Type& type) {
  if (type.kind == TypeKind::Instance) {
    a_.error(code::kBadSection, line.type->where, "a structure cannot hold function blocks",
             "it can hold a REF_TO one");
  } else if (line.address || line.open_address) {
    a_.error(code::kAddressNotHere, line.address_where, "a member of a structure has no address of its own",
             "its place in the structure is written like %B4 or %X4.0");
  } else if (line.edge != syntax::Edge::None) {
    a_.error(code::kBadSection, line.type->where,
             "R_EDGE and F_EDGE stand in VAR_INPUT of a function block or a program");
  } else {
    return true;
  }
  return false;
}

// Whether the place suits the type. %B counts bytes and takes every type but BOOL; the other sizes say how
// large the member is.
bool TypeResolver::is_placed(const VariableDeclaration& line, const Type& type) {
  if (!line.relative) {
    if (!line.names.empty())
      a_.error(code::kMemberPlace, line.names.front().where,
               quote(line.names.front().text) + " has no place, but other members of the structure have",
               "give a place to all members or to none");
    return false;
  }
  if (line.names.size() > 1) {
    a_.error(code::kBadAddress, line.address_where, "a place belongs to one member",
             "declare each member with its own place");
    return false;
  }
  const unsigned bits = line.relative->bits;
  const bool fits = type.is_bool() || bits == 1 ? type.is_bool() && bits == 1
                                                : bits == 8 || !type.is_scalar() || bits == type.bit_count();
  if (!fits)
    a_.error(code::kAddressSize, line.address_where,
             type.name + " does not fit to " + syntax::to_string(*line.relative) + ", which has " +
                 std::to_string(bits) + (bits == 1 ? " bit" : " bits"),
             type.is_bool() ? "a BOOL has a place like %X0.0"
                            : "write %B" + std::to_string(line.relative->byte) +
                                  ", which says where a member of any other type begins");
  return fits;
}

// Members lie apart, or share memory because OVERLAP says so and their types allow it.
bool TypeResolver::share_soundly(const Type& structure, const std::vector<const VariableDeclaration*>& lines,
                                 bool overlap) {
  std::vector<MemberExtent> extents;
  for (std::size_t i = 0; i < lines.size(); ++i) extents.push_back(extent_of(structure.fields[i], *lines[i]));
  std::ranges::stable_sort(extents, {}, &MemberExtent::first);
  bool sound = true;
  MemberExtent* reach = nullptr;  // the one that reaches farthest so far
  for (MemberExtent& each : extents) {
    if (reach != nullptr && each.first < reach->last) {
      each.shares = reach->shares = true;
      if (!overlap) {
        sound = false;
        const auto [first, second] =
            each.field < reach->field ? std::pair(&each, reach) : std::pair(reach, &each);
        a_.error(code::kMemberPlace, second->line->address_where,
                 quote(second->field->spelling) + " at " + syntax::to_string(*second->line->relative) +
                     " overlaps " + quote(first->field->spelling) + " at " +
                     syntax::to_string(*first->line->relative),
                 "write STRUCT OVERLAP if they are to share memory");
      }
    }
    if (reach == nullptr || each.last > reach->last) reach = &each;
  }
  for (const MemberExtent& each : extents) {
    const bool is_bit = each.field->bit != bytecode::kNoBit;
    if (!overlap || !each.shares || is_bit || is_any_bits(*each.field->type)) continue;
    sound = false;
    a_.error(code::kMemberPlace, each.line->type->where,
             quote(each.field->spelling) + " is " + each.field->type->name + ", which cannot share memory",
             "integers, bit strings, reals, TIME, CHAR and WCHAR can, a BOOL at a place like %X0.0, and "
             "arrays and structures of them");
  }
  return sound;
}

}  // namespace stepwright::semantics::internal
