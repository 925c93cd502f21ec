#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "programs/monitor/attach.h"
#include "programs/monitor/commands.h"
#include "programs/monitor/report.h"
#include "programs/process/command_line.h"
#include "programs/trace/value_json.h"
#include "runtime/bytecode/reader/parse_value.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/bytecode/reader/resolve_name.h"
#include "runtime/result/exit_code.h"
#include "runtime/service/monitor_answers.h"

namespace stepwright::monitor {
namespace {

using process::fail;
using result::ExitCode;

host::ImageBits bits_of(const reader::Variable& variable, std::uint64_t value) {
  if (variable.bit != bytecode::kNoBit) {
    return {variable.address, std::uint64_t{1} << variable.bit, value << variable.bit};
  }
  const std::uint32_t size = bytecode::size_of(bytecode::mem_type(variable.type));
  const std::uint64_t mask = size == 8 ? ~std::uint64_t{0} : (std::uint64_t{1} << 8 * size) - 1;
  return {variable.address, mask, value};
}

struct Forced {
  std::string name;
  reader::Variable variable;
  std::vector<std::byte> image;  // with nothing but the forced value in it
};

Forced forced(const reader::ProgramInfo& info, const image::Force& force) {
  Forced result{reader::name_of_place(info, force.address, force.bit, force.size),
                reader::variable_of_place(info, force.address, force.bit, force.size),
                {}};
  result.image.resize(force.address + sizeof force.value);
  const std::uint64_t value = force.bit == image::kWholeBytes ? force.value : (force.value & 1) << force.bit;
  std::memcpy(result.image.data() + force.address, &value, force.size);
  return result;
}

result::Result<std::vector<image::Force>> read_forces(Attached& runtime) {
  auto reply = runtime.ask(service::ReadForces{});
  if (!reply) return result::forward(reply);
  return service::decode_forces(reply->data);
}

result::Result<void> do_force(const config::CellConfig& config, const ForceArguments& arguments) {
  auto runtime = Attached::open(config, service::Role::Controller);
  if (!runtime) return result::forward(runtime);
  if (auto read = (*runtime)->read_program(); !read) return read;
  auto place = reader::resolve_name((*runtime)->program(), arguments.name);
  if (!place) return result::forward(place);
  auto value = reader::parse_value(place->variable, arguments.value, "R0058", {place->name, 0, 0});
  if (!value) return result::forward(value);
  const host::ImageBits bits = bits_of(place->variable, *value);
  if (auto reply = (*runtime)->ask(service::Force{bits}); !reply) return result::forward(reply);
  std::vector<std::byte> image(place->variable.address + sizeof(std::uint64_t));
  std::memcpy(image.data() + place->variable.address, &bits.value, sizeof bits.value);
  std::printf("%s is forced to %s\n", place->name.c_str(), reader::read_text(place->variable, image).c_str());
  return {};
}

result::Result<void> do_unforce(const config::CellConfig& config, const ForceArguments& arguments) {
  auto runtime = Attached::open(config, service::Role::Controller);
  if (!runtime) return result::forward(runtime);
  if (auto read = (*runtime)->read_program(); !read) return read;
  if (!arguments.all) {
    auto place = reader::resolve_name((*runtime)->program(), arguments.name);
    if (!place) return result::forward(place);
    if (bytecode::is_string(place->variable.type)) {
      return result::fail("R0058", {place->name, 0, 0}, "a string is never forced");
    }
    auto reply = (*runtime)->ask(service::Unforce{bits_of(place->variable, 0)});
    if (!reply) return result::forward(reply);
    std::printf("%s is no longer forced\n", place->name.c_str());
    return {};
  }
  auto forces = read_forces(**runtime);
  if (!forces) return result::forward(forces);
  for (const image::Force& force : *forces) {
    auto reply = (*runtime)->ask(service::Unforce{image::bits_of(force)});
    if (!reply) return result::forward(reply);
  }
  std::printf("%zu variables are no longer forced\n", forces->size());
  return {};
}

int exit_code(const result::Result<void>& done) {
  return done ? to_int(ExitCode::Done) : fail(done.error(), ExitCode::BadInput);
}

}  // namespace

int force(const config::CellConfig& config, const ForceArguments& arguments) {
  return exit_code(do_force(config, arguments));
}

int unforce(const config::CellConfig& config, const ForceArguments& arguments) {
  return exit_code(do_unforce(config, arguments));
}

int list_forces(const config::CellConfig& config, const ForceArguments& arguments) {
  auto runtime = Attached::open(config, service::Role::Observer);
  if (!runtime) return fail(runtime.error(), ExitCode::BadInput);
  if (auto read = (*runtime)->read_program(); !read) return fail(read.error(), ExitCode::BadInput);
  auto forces = read_forces(**runtime);
  if (!forces) return fail(forces.error(), ExitCode::RuntimeFault);
  nlohmann::json list = nlohmann::json::array();
  for (const image::Force& force : *forces) {
    const Forced one = forced((*runtime)->program(), force);
    std::printf("%s = %s\n", one.name.c_str(), reader::read_text(one.variable, one.image).c_str());
    list.push_back(
        {{"name", one.name}, {"value", trace::to_json(reader::read_value(one.variable, one.image))}});
  }
  std::printf("%zu of %zu places are forced\n", forces->size(), image::ForceTable::kCapacity);
  return finish(arguments.json_file, {{"forces", std::move(list)}});
}

}  // namespace stepwright::monitor
