#include "hmi_web/api/internal/shared_places.h"

#include <algorithm>
#include <cstdint>

#include "runtime/bytecode/reader/resolve_name.h"

namespace stepwright::api {
namespace {

// Bits of the memory image.
struct Place {
  std::uint64_t from = 0;
  std::uint64_t to = 0;  // behind the last
};

Place place_of(const reader::Variable& variable) {
  const std::uint64_t first = 8 * std::uint64_t{variable.address};
  if (variable.bit != bytecode::kNoBit) return {first + variable.bit, first + variable.bit + 1};
  const std::uint32_t bytes = bytecode::is_string(variable.type)
                                  ? bytecode::string_bytes(variable.type, variable.capacity)
                                  : bytecode::size_of(bytecode::mem_type(variable.type));
  return {first, first + 8 * std::uint64_t{bytes}};
}

}  // namespace

std::vector<std::string> shared_places(const reader::ProgramInfo& program, std::string_view forced) {
  const auto values = reader::resolve_values(program, forced);
  if (!values) return {};
  std::vector<std::string> names;
  for (const reader::Tag& tag : program.tags()) {
    const Place place = place_of(tag.variable);
    const auto is_itself = [&](const reader::NamedVariable& value) { return value.name == tag.name; };
    const auto is_over = [&](const reader::NamedVariable& value) {
      const Place other = place_of(value.variable);
      return place.from < other.to && other.from < place.to;
    };
    if (std::ranges::none_of(*values, is_itself) && std::ranges::any_of(*values, is_over))
      names.push_back(tag.name);
  }
  return names;
}

}  // namespace stepwright::api
