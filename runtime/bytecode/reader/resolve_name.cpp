#include "runtime/bytecode/reader/resolve_name.h"

#include <algorithm>
#include <array>
#include <vector>

#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/naming/direct_address.h"
#include "runtime/ground/result/closest.h"

namespace stepwright::reader {
namespace {

using bytecode::ElementaryType;

// Without blanks; an index of several dimensions as one index after the other.
std::string plain_path(std::string_view name) {
  std::string path;
  int brackets = 0;
  for (const char c : name) {
    if (c == '[') ++brackets;
    if (c == ']') --brackets;
    if (c == ' ' || c == '\t') continue;
    if (c == ',' && brackets > 0) {
      path += "][";
    } else {
      path += c;
    }
  }
  return path;
}

std::uint32_t size_of(const Variable& variable) {
  return bytecode::is_string(variable.type) ? 0 : bytecode::size_of(bytecode::mem_type(variable.type));
}

struct AreaPlace {
  std::uint32_t begin;
  std::uint32_t bytes;
  const char* name;
};

AreaPlace place_of(naming::Area area, const bytecode::SizesRecord& sizes) {
  switch (area) {
    case naming::Area::Input:
      return {0, sizes.input_bytes, "inputs"};
    case naming::Area::Output:
      return {sizes.input_bytes, sizes.output_bytes, "outputs"};
    case naming::Area::Marker:
      break;
  }
  return {sizes.input_bytes + sizes.output_bytes, sizes.marker_bytes, "markers"};
}

// The variable that is declared there; null if none is.
const Tag* tag_at(const ProgramInfo& info, std::uint32_t address, std::uint8_t bit, std::uint8_t size) {
  for (const Tag& tag : info.tags()) {
    const bool same = tag.variable.address == address && tag.variable.bit == bit;
    if (same && size_of(tag.variable) == size) return &tag;
  }
  return nullptr;
}

// Both in upper case.
bool is_inside(std::string_view name, std::string_view whole) {
  return name.size() > whole.size() && name.starts_with(whole) &&
         (name[whole.size()] == '[' || name[whole.size()] == '.');
}

// `n` of `MAIN.n`. Both in upper case.
bool is_end_of(std::string_view name, std::string_view end) {
  return name.size() > end.size() && name.ends_with(end) && name[name.size() - end.size() - 1] == '.';
}

// What to do about a name that is none.
std::string hint_for(const ProgramInfo& info, const std::string& path) {
  if (!info.complete()) {
    return "the program has more values than can be named: " + std::to_string(info.tags().size()) +
           " of them are";
  }
  const std::string wanted = naming::upper(path);
  std::vector<std::string> names;
  names.reserve(info.tags().size());
  for (const Tag& tag : info.tags()) {
    names.push_back(naming::upper(tag.name));
    if (is_inside(names.back(), wanted))
      return "it has several values: name one of them, e.g. `" + tag.name + "`";
  }
  const auto whole =
      std::ranges::find_if(names, [&](const std::string& name) { return is_end_of(name, wanted); });
  if (whole != names.end())
    return "did you mean `" + info.tags()[static_cast<std::size_t>(whole - names.begin())].name + "`?";
  // One slip in three letters, rounded up.
  if (const std::string* meant = result::closest(wanted, names, (wanted.size() + 2) / 3)) {
    const std::size_t index = static_cast<std::size_t>(meant - names.data());
    return "did you mean `" + info.tags()[index].name + "`?";
  }
  return "variables are named INSTANCE.variable, e.g. MAIN.level or MAIN.table[3]";
}

}  // namespace

result::Result<NamedVariable> resolve_name(const ProgramInfo& info, std::string_view name, const char* code,
                                           const result::Location& where) {
  const std::string path = plain_path(name);
  if (path.starts_with('%')) {
    const auto address = naming::parse_direct_address(path);
    if (!address) {
      return result::fail(code, where, "`" + path + "` is no address",
                          "addresses look like %IX0.0, %QW3 or %MD5");
    }
    const AreaPlace area = place_of(address->area, info.sizes());
    const std::uint32_t bytes = address->bits == 1 ? 1 : address->bits / 8u;
    if (address->byte + bytes > area.bytes) {
      return result::fail(code, where, "`" + path + "` lies beyond the " + area.name + " of the program",
                          "it has " + std::to_string(area.bytes) + " bytes of them");
    }
    const std::uint8_t bit = address->bits == 1 ? address->bit : bytecode::kNoBit;
    const auto size = static_cast<std::uint8_t>(bytes);
    return NamedVariable{path, variable_of_place(info, area.begin + address->byte, bit, size)};
  }
  if (const Tag* tag = info.find_tag(path)) return NamedVariable{tag->name, tag->variable};
  return result::fail(code, where, "there is no variable `" + path + "` with a single value",
                      hint_for(info, path));
}

result::Result<std::vector<NamedVariable>> resolve_values(const ProgramInfo& info, std::string_view name,
                                                          const char* code, const result::Location& where) {
  auto single = resolve_name(info, name, code, where);
  if (single) return std::vector{*std::move(single)};
  const std::string whole = naming::upper(plain_path(name));
  std::vector<NamedVariable> inside;
  for (const Tag& tag : info.tags()) {
    if (is_inside(naming::upper(tag.name), whole)) inside.push_back({tag.name, tag.variable});
  }
  if (inside.empty()) return result::forward(single);
  return inside;
}

Variable variable_of_place(const ProgramInfo& info, std::uint32_t address, std::uint8_t bit,
                           std::uint8_t size) {
  if (const Tag* tag = tag_at(info, address, bit, size)) return tag->variable;
  Variable variable;
  variable.address = address;
  variable.bit = bit;
  if (bit != bytecode::kNoBit) return variable;
  variable.type = size == 1   ? ElementaryType::Byte
                  : size == 2 ? ElementaryType::Word
                  : size == 4 ? ElementaryType::Dword
                              : ElementaryType::Lword;
  return variable;
}

std::string name_of_place(const ProgramInfo& info, std::uint32_t address, std::uint8_t bit,
                          std::uint8_t size) {
  if (const Tag* tag = tag_at(info, address, bit, size)) return tag->name;
  constexpr std::array kAreas = {naming::Area::Input, naming::Area::Output, naming::Area::Marker};
  for (const naming::Area area : kAreas) {
    const AreaPlace place = place_of(area, info.sizes());
    if (address < place.begin || address + size > place.begin + place.bytes) continue;
    const std::uint32_t byte = address - place.begin;
    std::string text = std::string("%") + "IQM"[static_cast<std::size_t>(area)];
    if (bit != bytecode::kNoBit) return text + "X" + std::to_string(byte) + "." + std::to_string(bit);
    if (byte % size != 0) break;
    text += size == 1 ? 'B' : size == 2 ? 'W' : size == 4 ? 'D' : 'L';
    return text + std::to_string(byte / size);
  }
  return std::to_string(size) + " bytes at byte " + std::to_string(address) + " of the image";
}

}  // namespace stepwright::reader
