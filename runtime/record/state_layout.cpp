#include "runtime/record/state_layout.h"

#include <cstring>
#include <utility>

#include "runtime/base/byte_reader.h"
#include "runtime/base/hash64.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::record {
namespace {

using bytecode::TypeKind;

void append_bytes(std::vector<std::byte>& out, const void* from, std::size_t count) {
  const std::size_t at = out.size();
  out.resize(at + count);
  if (count > 0) std::memcpy(out.data() + at, from, count);
}

template <typename T>
void append(std::vector<std::byte>& out, T value) {
  append_bytes(out, &value, sizeof value);
}

void append_text(std::vector<std::byte>& out, const std::string& text) {
  append(out, static_cast<std::uint32_t>(text.size()));
  append_bytes(out, text.data(), text.size());
}

std::string read_text(base::ByteReader& in) {
  const auto bytes = in.read_bytes(in.read<std::uint32_t>());
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Bytes that a record takes at least: a count beyond what is left is refused before memory is taken for it.
constexpr std::size_t kTypeBytes = 30;
constexpr std::size_t kVariableBytes = 24;

StateType read_type(base::ByteReader& in) {
  StateType type;
  type.kind = static_cast<TypeKind>(in.read<std::uint8_t>());
  type.elementary = static_cast<bytecode::ElementaryType>(in.read<std::uint8_t>());
  type.size = in.read<std::uint32_t>();
  type.capacity = in.read<std::uint32_t>();
  type.lower = in.read<std::int64_t>();
  type.upper = in.read<std::int64_t>();
  type.text = read_text(in);
  return type;
}

StateVariable read_variable(base::ByteReader& in) {
  StateVariable variable;
  variable.path = read_text(in);
  variable.type = in.read<std::uint32_t>();
  variable.address = in.read<std::uint32_t>();
  variable.count = in.read<std::uint32_t>();
  variable.lower = in.read<std::int32_t>();
  variable.is_array = in.read<std::uint8_t>() != 0;
  variable.bit = in.read<std::uint8_t>();
  variable.flags = in.read<std::uint16_t>();
  return variable;
}

bool well_formed_type(const StateType& type) {
  const auto elementary = static_cast<std::uint8_t>(type.elementary);
  if (elementary >= bytecode::kElementaryTypeCount || type.size == 0) return false;
  const bool text = bytecode::is_string(type.elementary);
  switch (type.kind) {
    case TypeKind::String:
      return text && type.capacity <= bytecode::kMaxStringCapacity &&
             type.size == bytecode::string_bytes(type.elementary, type.capacity);
    case TypeKind::Reference:
      return type.size == bytecode::size_of(bytecode::MemType::Ref);
    case TypeKind::Elementary:
    case TypeKind::Enumeration:
    case TypeKind::Subrange:
      return !text && type.size == bytecode::size_of(bytecode::mem_type(type.elementary));
    default:
      return false;
  }
}

}  // namespace

bool takes(const StateType& to, const StateType& from) {
  if (to.kind != from.kind || to.elementary != from.elementary) return false;
  switch (to.kind) {
    case TypeKind::Enumeration:
      return to.text.starts_with(from.text);
    case TypeKind::Subrange:
      if (bytecode::is_unsigned(to.elementary)) {
        return static_cast<std::uint64_t>(to.lower) <= static_cast<std::uint64_t>(from.lower) &&
               static_cast<std::uint64_t>(from.upper) <= static_cast<std::uint64_t>(to.upper);
      }
      return to.lower <= from.lower && from.upper <= to.upper;
    case TypeKind::String:
      return true;
    default:
      return to.size == from.size && to.text == from.text;
  }
}

StateLayout::StateLayout(std::vector<StateType> types, std::vector<StateVariable> variables,
                         std::uint32_t size)
    : types_(std::move(types)), variables_(std::move(variables)), size_(size) {
  index();
}

void StateLayout::index() {
  by_path_.reserve(variables_.size());
  for (std::uint32_t i = 0; i < variables_.size(); ++i)
    by_path_.try_emplace(naming::upper(variables_[i].path), i);
}

const StateVariable* StateLayout::find(std::string_view path) const {
  const auto found = by_path_.find(naming::upper(path));
  return found == by_path_.end() ? nullptr : &variables_[found->second];
}

std::uint64_t StateLayout::digest() const {
  return base::hash_bytes(encoded());
}

std::vector<std::byte> StateLayout::encoded() const {
  std::vector<std::byte> out;
  append(out, size_);
  append(out, areas_.inputs);
  append(out, areas_.outputs);
  append(out, areas_.markers);
  append(out, static_cast<std::uint32_t>(types_.size()));
  for (const StateType& type : types_) {
    append(out, static_cast<std::uint8_t>(type.kind));
    append(out, static_cast<std::uint8_t>(type.elementary));
    append(out, type.size);
    append(out, type.capacity);
    append(out, type.lower);
    append(out, type.upper);
    append_text(out, type.text);
  }
  append(out, static_cast<std::uint32_t>(variables_.size()));
  for (const StateVariable& variable : variables_) {
    append_text(out, variable.path);
    append(out, variable.type);
    append(out, variable.address);
    append(out, variable.count);
    append(out, variable.lower);
    append(out, static_cast<std::uint8_t>(variable.is_array));
    append(out, variable.bit);
    append(out, variable.flags);
  }
  return out;
}

result::Result<StateLayout> StateLayout::decode(std::span<const std::byte> bytes) {
  const auto refuse = [] { return result::fail("R0022", {}, "the names of the stored values are damaged"); };
  base::ByteReader in(bytes);
  StateLayout layout;
  layout.size_ = in.read<std::uint32_t>();
  layout.areas_.inputs = in.read<std::uint32_t>();
  layout.areas_.outputs = in.read<std::uint32_t>();
  layout.areas_.markers = in.read<std::uint32_t>();
  const auto types = in.read<std::uint32_t>();
  if (!in.ok() || types > in.remaining() / kTypeBytes) return refuse();
  for (std::uint32_t i = 0; i < types; ++i) layout.types_.push_back(read_type(in));
  const auto variables = in.read<std::uint32_t>();
  if (!in.ok() || variables > in.remaining() / kVariableBytes) return refuse();
  for (std::uint32_t i = 0; i < variables; ++i) layout.variables_.push_back(read_variable(in));
  if (!in.ok() || !in.at_end() || !layout.well_formed()) return refuse();
  layout.index();
  return layout;
}

bool StateLayout::well_formed() const {
  const std::uint64_t areas = std::uint64_t{areas_.inputs} + areas_.outputs + areas_.markers;
  if (areas > size_) return false;
  for (const StateType& type : types_) {
    if (!well_formed_type(type)) return false;
  }
  for (const StateVariable& variable : variables_) {
    if (variable.type >= types_.size() || variable.count == 0) return false;
    if (!variable.is_array && variable.count != 1) return false;
    const std::uint64_t bytes = std::uint64_t{variable.count} * types_[variable.type].size;
    if (variable.address > size_ || bytes > size_ - variable.address) return false;
    if (variable.bit == bytecode::kNoBit) continue;
    const StateType& type = types_[variable.type];
    const bool is_bool =
        type.kind == TypeKind::Elementary && type.elementary == bytecode::ElementaryType::Bool;
    if (variable.bit > 7 || variable.count != 1 || !is_bool) return false;
  }
  return true;
}

}  // namespace stepwright::record
