#include "tests/fuzz/st/extras/extra.h"

#include <algorithm>

#include "tests/fuzz/st/st_writer.h"

namespace stepwright::st_fuzz {

std::string Material::value(Scalar type) {
  return st_expression(*expressions_.unknown(type, 2));
}

std::string Material::between(Scalar type, std::int64_t low, std::int64_t high) {
  if (random.chance(3)) return value(type);
  return "LIMIT(" + literal(type, low, low) + ", " + value(type) + ", " + literal(type, high, high) + ")";
}

std::string Material::literal(Scalar type, std::int64_t low, std::int64_t high) {
  const auto number = static_cast<std::uint64_t>(random.between(low, high));
  return st_literal(*expressions_.elementary(type), extended(type, number));
}

std::string Material::target(Scalar type) {
  std::vector<const Way*> known;
  for (const Way& each : scope_.writable)
    if (each.type->kind == TypeKind::Elementary && each.type->scalar == type) known.push_back(&each);
  return known.empty() ? "" : st_place(expressions_.place(*random.pick(known), 1));
}

std::string Material::plain_target(Scalar type) {
  std::vector<const Way*> known;
  for (const Way& each : scope_.writable) {
    const bool direct = std::ranges::none_of(each.steps, [](const WayStep& s) { return s.array != nullptr; });
    const bool fits = each.type->kind == TypeKind::Elementary && each.type->scalar == type;
    if (fits && direct && each.variable->location.empty()) known.push_back(&each);
  }
  return known.empty() ? "" : st_place(expressions_.place(*random.pick(known), 0));
}

Extras all_extras() {
  Extras out;
  out.push_back(strings());
  out.push_back(wide_strings());
  out.push_back(string_conversions());
  out.push_back(characters());
  out.push_back(dates());
  out.push_back(references());
  out.push_back(open_arrays());
  out.push_back(standard_blocks());
  out.push_back(enables());
  out.push_back(globals());
  out.push_back(retained());
  out.push_back(bit_parts());
  out.push_back(instances());
  out.push_back(aliases());
  out.push_back(ladder());
  return out;
}

}  // namespace stepwright::st_fuzz
