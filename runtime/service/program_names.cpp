#include "runtime/service/program_names.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "runtime/bytecode/reader/parse_string.h"
#include "runtime/bytecode/reader/parse_value.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/bytecode/reader/resolve_name.h"
#include "runtime/host/limits.h"
#include "runtime/image/image_bits.h"

namespace stepwright::service {
namespace {

constexpr const char* kNoSuchValue = "R0058";

host::ImageBits bits_of(const reader::Variable& variable, std::uint64_t value) {
  if (variable.bit != bytecode::kNoBit)
    return {variable.address, std::uint64_t{1} << variable.bit, value << variable.bit};
  const std::uint32_t size = bytecode::size_of(bytecode::mem_type(variable.type));
  const std::uint64_t mask = size == 8 ? ~std::uint64_t{0} : (std::uint64_t{1} << 8 * size) - 1;
  return {variable.address, mask, value};
}

// An image up to the value's end, with nothing else in it.
std::vector<std::byte> image_with(std::uint32_t address, std::uint64_t value, std::size_t size) {
  std::vector<std::byte> image(address + sizeof value);
  std::memcpy(image.data() + address, &value, size);
  return image;
}

// Bytes from an address on, up to 8 in a part.
std::vector<host::ImageBits> parts_of(std::uint32_t address, std::span<const std::byte> bytes) {
  std::vector<host::ImageBits> parts;
  while (!bytes.empty()) {
    const std::size_t size = std::min(bytes.size(), sizeof(std::uint64_t));
    host::ImageBits part{address, ~std::uint64_t{0} >> 8 * (sizeof(std::uint64_t) - size), 0};
    std::memcpy(&part.value, bytes.data(), size);
    parts.push_back(part);
    bytes = bytes.subspan(size);
    address += static_cast<std::uint32_t>(size);
  }
  return parts;
}

// The code has its value: whatever stands in the image, the program goes on with that.
result::Result<reader::NamedVariable> writable(const reader::ProgramInfo& info, std::string_view name) {
  auto found = reader::resolve_name(info, name);
  if (!found) return found;
  const reader::Tag* const tag = info.find_tag(found->name);
  if (tag == nullptr || (tag->flags & bytecode::kSymbolConstant) == 0) return found;
  return result::fail(kNoSuchValue, {found->name, 0, 0}, "`" + found->name + "` is a constant of the program",
                      "a variable without CONSTANT can be written and forced");
}

}  // namespace

std::string ForcedValue::text() const {
  return reader::read_text(variable, image);
}

result::Result<NamedBits> ProgramNames::value(std::string_view name, std::string_view text) const {
  auto found = writable(info_, name);
  if (!found) return result::forward(found);
  const reader::Variable& variable = found->variable;
  auto parsed = reader::parse_value(variable, text, kNoSuchValue, {found->name, 0, 0});
  if (!parsed) return result::forward(parsed);
  const host::ImageBits bits = bits_of(variable, *parsed);
  std::string spelled =
      reader::read_text(variable, image_with(bits.byte_offset, bits.value, sizeof bits.value));
  return NamedBits{std::move(found->name), {digest_, bits}, std::move(spelled)};
}

result::Result<NamedWrite> ProgramNames::written(std::string_view name, std::string_view text) const {
  auto found = writable(info_, name);
  if (!found) return result::forward(found);
  const reader::Variable& variable = found->variable;
  if (!bytecode::is_string(variable.type)) {
    auto one = value(name, text);
    if (!one) return result::forward(one);
    return NamedWrite{std::move(one->name), {digest_, {one->bits.bits}}, std::move(one->text)};
  }
  auto bytes = reader::parse_string(variable, text, kNoSuchValue, {found->name, 0, 0});
  if (!bytes) return result::forward(bytes);
  // As it will be read.
  std::vector<std::byte> image(variable.address + std::size_t{reader::kStringLengthAt} + bytes->size());
  std::memcpy(image.data() + variable.address, &variable.capacity, sizeof variable.capacity);
  std::memcpy(image.data() + variable.address + reader::kStringLengthAt, bytes->data(), bytes->size());
  return NamedWrite{std::move(found->name),
                    {digest_, parts_of(variable.address + reader::kStringLengthAt, *bytes)},
                    reader::read_text(variable, image)};
}

result::Result<NamedBits> ProgramNames::forceable(std::string_view name) const {
  auto found = reader::resolve_name(info_, name);
  if (!found) return result::forward(found);
  if (bytecode::is_string(found->variable.type))
    return result::fail(kNoSuchValue, {found->name, 0, 0}, "a string is never forced");
  return NamedBits{std::move(found->name), {digest_, bits_of(found->variable, 0)}, {}};
}

result::Result<std::string> ProgramNames::read(std::string_view name,
                                               std::span<const std::byte> image) const {
  auto found = reader::resolve_name(info_, name);
  if (!found) return result::forward(found);
  return reader::read_text(found->variable, image);
}

ForcedValue ProgramNames::forced(const image::Force& force) const {
  const std::uint64_t value = force.bit == image::kWholeBytes ? force.value : (force.value & 1) << force.bit;
  return {reader::name_of_place(info_, force.address, force.bit, force.size),
          reader::variable_of_place(info_, force.address, force.bit, force.size),
          image_with(force.address, value, force.size), force.end_ns != image::kNoEnd};
}

result::Result<ForcedValue> ProgramNames::as_forced(std::string_view name, std::string_view text) const {
  auto wanted = value(name, text);
  if (!wanted) return result::forward(wanted);
  image::Force force;
  if (image::to_force(wanted->bits.bits, host::kMaxImageBytes, force) != image::BitsStatus::Done)
    return result::fail(kNoSuchValue, {wanted->name, 0, 0}, "`" + wanted->name + "` cannot be forced");
  force.end_ns = 0;  // some
  return forced(force);
}

}  // namespace stepwright::service
