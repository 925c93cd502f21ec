#include "programs/hmi/dds_cell_control.h"

#include <cstring>

#include "hmi_web/api/cell_codes.h"
#include "runtime/bytecode/reader/parse_value.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/bytecode/reader/resolve_name.h"
#include "runtime/host/limits.h"
#include "runtime/image/image_bits.h"

namespace stepwright::hmi {
namespace {

using result::Result;

host::ImageBits bits_of(const reader::Variable& variable, std::uint64_t value) {
  if (variable.bit != bytecode::kNoBit)
    return {variable.address, std::uint64_t{1} << variable.bit, value << variable.bit};
  const std::uint32_t size = bytecode::size_of(bytecode::mem_type(variable.type));
  const std::uint64_t mask = size == 8 ? ~std::uint64_t{0} : (std::uint64_t{1} << 8 * size) - 1;
  return {variable.address, mask, value};
}

// A place, and the program that it is of: what is asked of it names that program, so that no other is hit.
struct Place {
  std::shared_ptr<const KnownProgram> program;
  reader::NamedVariable found;

  host::ProgramBits bits(std::uint64_t value) const {
    return {program->digest, bits_of(found.variable, value)};
  }
};

tl::unexpected<result::Diagnostics> just_changed() {
  return result::fail(api::kProgramJustChanged, {}, "the program has just changed", "try again in a moment");
}

// Of the program that runs at this moment, as far as is known here.
Result<Place> place_of(DdsCellSource& source, const std::string& name) {
  auto program = source.running().get();
  const auto status = source.client().status();
  if (!program || !status)
    return result::fail(api::kNobodyAnswers, {}, "no runtime answers with a program",
                        "is the runtime of the cell running?");
  if (status->program_digest != program->digest) return just_changed();
  auto found = reader::resolve_name(program->info, name);
  if (!found) return result::forward(found);
  return Place{std::move(program), std::move(*found)};
}

// The place with the value's bits, and the value as the program spells it.
struct Change {
  Place place;
  host::ProgramBits bits;
  std::string text;
};

Result<Change> change_of(DdsCellSource& source, const std::string& name, const std::string& value) {
  auto place = place_of(source, name);
  if (!place) return result::forward(place);
  const reader::Variable& variable = place->found.variable;
  auto parsed = reader::parse_value(variable, value, "R0058");
  if (!parsed) return result::forward(parsed);
  host::ProgramBits bits = place->bits(*parsed);
  std::vector<std::byte> image(variable.address + sizeof(std::uint64_t));
  std::memcpy(image.data() + variable.address, &bits.bits.value, sizeof bits.bits.value);
  std::string text = reader::read_text(variable, image);
  return Change{std::move(*place), std::move(bits), std::move(text)};
}

// A value that is forced, told as `forced` and `as_forced` both do.
api::ForcedPlace forced_place(const reader::ProgramInfo& info, const image::Force& force) {
  std::vector<std::byte> image(force.address + sizeof force.value);
  const std::uint64_t value = force.bit == image::kWholeBytes ? force.value : (force.value & 1) << force.bit;
  std::memcpy(image.data() + force.address, &value, force.size);
  const reader::Variable variable = reader::variable_of_place(info, force.address, force.bit, force.size);
  return {reader::name_of_place(info, force.address, force.bit, force.size),
          reader::read_text(variable, image), force.end_ns != image::kNoEnd};
}

}  // namespace

Result<void> DdsCellControl::ask_supervisor(const std::string& request) {
  return source_.plans().request(request);
}

std::string DdsCellControl::goal_form() {
  return source_.plans().goal_form().value_or("");
}

std::string DdsCellControl::outlook() {
  return source_.plans().outlook().value_or("");
}

Result<void> DdsCellControl::stop_runtime(const std::string& reason) {
  return source_.client().stop(reason);
}

Result<std::string> DdsCellControl::read(const std::string& name) {
  auto place = place_of(source_, name);
  if (!place) return result::forward(place);
  const auto snapshot = source_.client().snapshot();
  if (!snapshot || snapshot->program_digest != place->program->digest)
    return result::fail(api::kNobodyAnswers, {}, "no values of this program have arrived");
  return reader::read_text(place->found.variable, snapshot->image);
}

Result<std::string> DdsCellControl::spell(const std::string& name, const std::string& value) {
  auto change = change_of(source_, name, value);
  if (!change) return result::forward(change);
  return std::move(change->text);
}

Result<std::string> DdsCellControl::write(const std::string& name, const std::string& value) {
  auto change = change_of(source_, name, value);
  if (!change) return result::forward(change);
  if (auto done = source_.client().write(change->bits); !done) return result::forward(done);
  return std::move(change->text);
}

Result<std::string> DdsCellControl::force(const std::string& name, const std::string& value,
                                          std::chrono::milliseconds duration) {
  auto change = change_of(source_, name, value);
  if (!change) return result::forward(change);
  const dds::ForceRequest request{std::move(change->bits), static_cast<std::uint64_t>(duration.count())};
  if (auto done = source_.client().force(request); !done) return result::forward(done);
  return std::move(change->text);
}

Result<void> DdsCellControl::unforce(const std::string& name) {
  auto place = place_of(source_, name);
  if (!place) return result::forward(place);
  if (bytecode::is_string(place->found.variable.type))
    return result::fail("R0058", {}, "a string is never forced");
  return source_.client().unforce(place->bits(0));
}

Result<void> DdsCellControl::write_together(const std::map<std::string, std::string, std::less<>>& values) {
  host::BlockWrite block;
  for (const auto& [name, value] : values) {
    auto change = change_of(source_, name, value);
    if (!change) return result::forward(change);
    // All of one program, or none.
    if (!block.parts.empty() && change->bits.program_digest != block.program_digest) return just_changed();
    block.program_digest = std::move(change->bits.program_digest);
    block.parts.push_back(change->bits.bits);
  }
  return source_.client().write(block);
}

Result<std::vector<api::ForcedPlace>> DdsCellControl::forced() {
  // Asked often, from where nobody waits for a runtime to come.
  if (!source_.client().runtime_alive()) return result::fail(api::kNobodyAnswers, {}, "no runtime answers");
  auto forces = source_.client().forces();
  if (!forces) return result::forward(forces);
  std::vector<api::ForcedPlace> places;
  if (forces->places.empty()) return places;
  const auto program = source_.running().get();
  if (!program || program->digest != forces->program_digest) return just_changed();
  for (const image::Force& force : forces->places) places.push_back(forced_place(program->info, force));
  return places;
}

Result<api::ForcedPlace> DdsCellControl::as_forced(const std::string& name, const std::string& value) {
  auto change = change_of(source_, name, value);
  if (!change) return result::forward(change);
  image::Force force;
  if (image::to_force(change->bits.bits, host::kMaxImageBytes, force) != image::BitsStatus::Done)
    return result::fail("R0058", {}, "`" + name + "` cannot be forced");
  force.end_ns = 0;  // some
  return forced_place(change->place.program->info, force);
}

}  // namespace stepwright::hmi
