#include "ladder/semantics/analysis/analysis.h"

#include <algorithm>

namespace stepwright::semantics::internal {

std::optional<std::uint32_t> Analysis::allocate(std::uint32_t size, Position where) {
  auto& data = model.area(Base::Data);
  if (size > kMaxData || data.size() > kMaxData - size) {
    error(code::kTooLarge, where, "the variables of the program are larger than 32 MiB");
    return std::nullopt;
  }
  const auto offset = static_cast<std::uint32_t>(data.size());
  data.resize(data.size() + size);
  return offset;
}

Place Analysis::allocate_place(const Type* type, Position where) {
  return allocate_place(type, type->initial, where);
}

Place Analysis::allocate_place(const Type* type, std::span<const std::byte> initial, Position where) {
  Place place;
  place.base = Base::Data;
  place.type = type;
  const auto offset = allocate(type->size, where);
  if (!offset) return place;
  place.offset = *offset;
  std::copy(initial.begin(), initial.end(), model.area(Base::Data).begin() + *offset);
  note_references(*type, initial, Base::Data, *offset, where);
  return place;
}

std::optional<Constant> Analysis::folded_value(const Type& type, std::span<const std::byte> bytes) const {
  if (!type.is_scalar() && !type.is_string()) return std::nullopt;
  Constant value = semantics::load(type, bytes);
  if (first_target(value, type) != nullptr) return std::nullopt;
  return value;
}

Place frame_place(Pou& pou, const Type* type) {
  Place place;
  place.base = Base::Frame;
  place.offset = pou.frame_size;
  place.type = type;
  // Far more than a container may have, which is told when it is written.
  pou.frame_size = std::min(pou.frame_size, std::uint32_t{1} << 31) + type->size;
  return place;
}

const std::string& plain_name(const Type& type) {
  static const std::string kString = "STRING";
  static const std::string kWstring = "WSTRING";
  if (!type.is_string()) return type.name;
  return type.elementary == ElementaryType::Wstring ? kWstring : kString;
}

std::string quote(std::string_view name) {
  return "'" + std::string(name) + "'";
}

}  // namespace stepwright::semantics::internal
