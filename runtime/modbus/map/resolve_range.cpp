#include "runtime/modbus/map/resolve_range.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "runtime/bytecode/reader/resolve_name.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/naming/direct_address.h"

namespace stepwright::modbus::map {
namespace {

using bytecode::ElementaryType;
using reader::ProgramInfo;
using reader::Tag;

// Values that follow each other.
struct Values {
  reader::Variable first;
  std::uint32_t available = 1;  // values that follow each other from the first on
  std::uint32_t whole = 1;      // of them, without a count
  bool constant = false;
};

std::uint32_t size_of(const reader::Variable& variable) {
  return variable.bit != bytecode::kNoBit ? 1 : bytecode::size_of(bytecode::mem_type(variable.type));
}

bool same_letters(std::string_view left, std::string_view right) {
  return left.size() == right.size() &&
         std::equal(left.begin(), left.end(), right.begin(),
                    [](char a, char b) { return naming::to_upper(a) == naming::to_upper(b); });
}

// The array that an element belongs to: what stands before its indexes. Of anything else the whole name.
std::string_view array_of(std::string_view name) {
  if (!name.ends_with(']')) return name;
  std::size_t end = name.size();
  while (end > 0 && name[end - 1] == ']') end = name.rfind('[', end - 1);
  return name.substr(0, end);
}

// How many elements of the same array lie one behind the other from this tag on.
std::uint32_t run_from(const std::vector<Tag>& tags, std::size_t at) {
  const Tag& first = tags[at];
  const std::string_view array = array_of(first.name);
  if (array.size() == first.name.size()) return 1;
  std::uint32_t count = 1;
  for (std::size_t i = at + 1; i < tags.size(); ++i, ++count) {
    const Tag& tag = tags[i];
    const bool next = array_of(tag.name) == array && tag.variable.type == first.variable.type &&
                      tag.variable.address == first.variable.address + count * size_of(first.variable);
    if (!next) break;
  }
  return count;
}

// A map that was not read from a file has no places of keys.
const result::Location& place(const RangeConfig& range, const result::Location& key) {
  return key.file.empty() ? range.where : key;
}

result::Result<Values> direct(const RangeConfig& range, const ProgramInfo& info) {
  auto named = reader::resolve_name(info, range.variable, "C0501", place(range, range.at_name));
  if (!named) return result::forward(named);
  const auto address = naming::parse_direct_address(range.variable);
  const bytecode::SizesRecord& sizes = info.sizes();
  const std::uint32_t area = address->area == naming::Area::Input    ? sizes.input_bytes
                             : address->area == naming::Area::Output ? sizes.output_bytes
                                                                     : sizes.marker_bytes;
  Values values;
  values.first = named->variable;
  const std::uint32_t rest = area - address->byte;
  values.available = address->bits == 1 ? rest * 8 - address->bit : rest / (address->bits / 8u);
  return values;
}

result::Result<Values> by_name(const RangeConfig& range, const ProgramInfo& info) {
  const std::vector<Tag>& tags = info.tags();
  Values values;
  const auto found = std::find_if(tags.begin(), tags.end(), [&](const Tag& tag) {
    return same_letters(tag.name, range.variable) ||
           (tag.name.size() > range.variable.size() && same_letters(array_of(tag.name), range.variable));
  });
  if (found == tags.end()) {
    auto named = reader::resolve_name(info, range.variable, "C0501", place(range, range.at_name));
    if (!named) return result::forward(named);
    values.first = named->variable;  // spelled with blanks, say
    return values;
  }
  values.first = found->variable;
  values.available = run_from(tags, static_cast<std::size_t>(found - tags.begin()));
  values.whole = same_letters(found->name, range.variable) ? 1 : values.available;
  values.constant = (found->flags & bytecode::kSymbolConstant) != 0;
  return values;
}

Kind kind_of(const reader::Variable& variable) {
  if (variable.bit != bytecode::kNoBit) return Kind::Bits;
  if (variable.type == ElementaryType::Bool) return Kind::Bools;
  switch (size_of(variable)) {
    case 1:
      return Kind::Byte;
    case 2:
      return Kind::Word;
    case 4:
      return Kind::Dword;
    default:
      return Kind::Lword;
  }
}

// Why clients must not write there; empty: they may.
const char* refuses_writes(const RangeConfig& range, const Values& values, const ProgramInfo& info) {
  if (!may_be_written(range.table)) return "clients can write coils and holding registers only";
  if (values.constant) return "it is a constant";
  if (values.first.address < info.sizes().input_bytes) return "inputs are the I/O driver's";
  return "";
}

}  // namespace

result::Result<Segment> resolve_range(const RangeConfig& range, const ProgramInfo& info) {
  const auto refused = [&](const char* code, const result::Location& key, const std::string& message,
                           const std::string& hint = {}) {
    return result::fail(code, place(range, key), "`" + range.variable + "`: " + message, hint);
  };
  auto values = range.variable.starts_with('%') ? direct(range, info) : by_name(range, info);
  if (!values) return result::forward(values);
  if (bytecode::is_string(values->first.type))
    return refused("C0505", range.at_name, "strings have no place in a table",
                   "map an array of BYTE or WORD");
  const std::uint32_t count = range.count == 0 ? values->whole : range.count;
  if (count > values->available)
    return refused("C0502", range.at_count,
                   "there are " + std::to_string(values->available) + " values from there on, not " +
                       std::to_string(count));
  if (const std::string why = range.writable ? refuses_writes(range, *values, info) : ""; !why.empty())
    return refused("C0504", range.at_writable, "it cannot be writable: " + why);
  Segment segment;
  segment.first = range.first;
  segment.address = values->first.address;
  segment.kind = kind_of(values->first);
  segment.bit = segment.kind == Kind::Bits ? values->first.bit : std::uint8_t{0};
  segment.is_signed = values->first.type == ElementaryType::Sint;
  segment.writable = range.writable;
  segment.byte_order = range.byte_order;
  segment.word_order = range.word_order;
  segment.count = count * registers_of(segment.kind);
  if (holds_bits(range.table) && segment.kind != Kind::Bits && segment.kind != Kind::Bools) {
    segment.count = count * bytes_of(segment.kind) * 8;
    segment.kind = Kind::Bits;
  }
  if (segment.count > kAddresses || segment.end() > kAddresses)
    return refused("C0502", range.at_first,
                   "its last address would be " + std::to_string(std::uint64_t{segment.end()} - 1),
                   "tables end at 65535");
  return segment;
}

}  // namespace stepwright::modbus::map
