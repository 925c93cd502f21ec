#include "runtime/service/program_names.h"

#include <cstring>
#include <utility>

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

}  // namespace

std::string ForcedValue::text() const {
  return reader::read_text(variable, image);
}

result::Result<NamedBits> ProgramNames::value(std::string_view name, std::string_view text) const {
  auto found = reader::resolve_name(info_, name);
  if (!found) return result::forward(found);
  const reader::Variable& variable = found->variable;
  auto parsed = reader::parse_value(variable, text, kNoSuchValue, {found->name, 0, 0});
  if (!parsed) return result::forward(parsed);
  const host::ImageBits bits = bits_of(variable, *parsed);
  std::string spelled =
      reader::read_text(variable, image_with(bits.byte_offset, bits.value, sizeof bits.value));
  return NamedBits{std::move(found->name), {digest_, bits}, std::move(spelled)};
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
