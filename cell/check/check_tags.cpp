#include "cell/check/check_tags.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "cell/check/extent.h"

namespace stepwright::check {
namespace {

using bytecode::ElementaryType;
using modbus::client::ImageType;
using modbus::client::Tag;
using modbus::client::WireType;
using result::Severity;

// What a number is made of: bits of the same width mean something else in another family.
enum class Family : std::uint8_t { Bits, Signed, Unsigned, Float };

Family family_of(ImageType type) {
  switch (type) {
    case ImageType::Bool:
      return Family::Bits;
    case ImageType::Real:
    case ImageType::Lreal:
      return Family::Float;
    case ImageType::Sint:
    case ImageType::Int:
    case ImageType::Dint:
    case ImageType::Lint:
      return Family::Signed;
    default:
      return Family::Unsigned;
  }
}

Family family_of(ElementaryType type) {
  switch (type) {
    case ElementaryType::Real:
    case ElementaryType::Lreal:
      return Family::Float;
    case ElementaryType::Sint:
    case ElementaryType::Int:
    case ElementaryType::Dint:
    case ElementaryType::Lint:
      return Family::Signed;
    case ElementaryType::Usint:
    case ElementaryType::Uint:
    case ElementaryType::Udint:
    case ElementaryType::Ulint:
      return Family::Unsigned;
    default:
      return Family::Bits;  // bit strings and what else takes any bits
  }
}

// A device's number of another sign than the tag's is out of range where the sign counts.
Family family_of(WireType type) {
  switch (type) {
    case WireType::Bool:
      return Family::Bits;
    case WireType::Real:
    case WireType::Lreal:
      return Family::Float;
    case WireType::Int16:
    case WireType::Int32:
    case WireType::Int64:
      return Family::Signed;
    default:
      return Family::Unsigned;
  }
}

const char* word(ImageType type) {
  constexpr std::array kWords = {"BOOL",  "SINT", "USINT", "INT",  "UINT", "DINT",
                                 "UDINT", "LINT", "ULINT", "REAL", "LREAL"};
  return kWords[static_cast<std::size_t>(type)];
}

// The type of the same width and another family, to say what was meant.
const char* word(Family family, std::uint32_t bytes) {
  const std::size_t width = bytes == 1 ? 0 : bytes == 2 ? 1 : bytes == 4 ? 2 : 3;
  constexpr const char* kSigned[] = {"SINT", "INT", "DINT", "LINT"};
  constexpr const char* kUnsigned[] = {"USINT", "UINT", "UDINT", "ULINT"};
  constexpr const char* kFloat[] = {"REAL", "REAL", "REAL", "LREAL"};
  return family == Family::Float    ? kFloat[width]
         : family == Family::Signed ? kSigned[width]
                                    : kUnsigned[width];
}

Extent tag_extent(const Tag& tag, std::uint32_t area) {
  const std::uint64_t first = (std::uint64_t{area} + tag.field.byte) * 8;
  if (tag.field.type == ImageType::Bool) return {first + tag.field.bit, first + tag.field.bit + 1};
  return {first, first + 8 * std::uint64_t{modbus::client::bytes_of(tag.field.type)}};
}

class TagCheck {
 public:
  TagCheck(const reader::ProgramInfo& info, result::Diagnostics& problems)
      : info_(info), problems_(problems) {}

  void check(const Tag& tag, bool output) {
    const bytecode::SizesRecord& sizes = info_.sizes();
    const std::uint32_t area = output ? sizes.input_bytes : 0;
    const std::uint64_t area_end =
        std::uint64_t{8} * (output ? area + sizes.output_bytes : sizes.input_bytes);
    const Extent extent = tag_extent(tag, area);
    bool any = false;
    for (const reader::Tag& variable : info_.tags()) {
      const Extent other = extent_of(variable.variable);
      if (extent.end > area_end || !overlap(extent, other)) continue;
      any = true;
      if (other == extent) compare(tag, variable);
    }
    if (!any)
      problems_.push_back({"C0529", Severity::Warning, tag.where,
                           std::string("the program has no variable at ") + tag.address,
                           output ? "nothing drives this tag" : "nothing reads this tag"});
  }

 private:
  void compare(const Tag& tag, const reader::Tag& variable) {
    const Family here = family_of(tag.field.type);
    const Family there = family_of(variable.variable.type);
    if (here == there || here == Family::Bits || there == Family::Bits) return;
    const bool wrong = here == Family::Float || there == Family::Float;
    // A sign is a matter of reading the same bits, as long as nothing is computed with the number.
    const bool moved =
        tag.scale.plain() && family_of(tag.wire) == here &&
        modbus::client::bytes_of(tag.field.type) == 2u * modbus::client::registers_of(tag.wire);
    if (!wrong && moved) return;
    problems_.push_back(
        {"C0528", wrong ? Severity::Error : Severity::Warning, tag.where,
         "the tag is a " + std::string(word(tag.field.type)) + " at " + tag.address + ", where " +
             variable.name + " of the program is another type",
         "iec = \"" + std::string(word(there, modbus::client::bytes_of(tag.field.type))) + "\""});
  }

  const reader::ProgramInfo& info_;
  result::Diagnostics& problems_;
};

}  // namespace

result::Diagnostics check_tags(const modbus::client::ClientSettings& client,
                               const reader::ProgramInfo& info) {
  result::Diagnostics problems;
  TagCheck check(info, problems);
  for (const modbus::client::Device& device : client.devices) {
    for (const modbus::client::Group& group : device.groups) {
      for (const Tag& tag : group.inputs) check.check(tag, false);
      for (const Tag& tag : group.outputs) check.check(tag, true);
    }
  }
  return problems;
}

}  // namespace stepwright::check
