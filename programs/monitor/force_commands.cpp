#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "programs/monitor/attach.h"
#include "programs/monitor/commands.h"
#include "programs/monitor/report.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/counted.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/service/monitor_answers.h"
#include "runtime/service/program_names.h"
#include "runtime/trace/value_json.h"

namespace stepwright::monitor {
namespace {

using process::fail;
using result::ExitCode;

constexpr double kMsPerS = 1'000.0;
constexpr double kNsPerS = 1e9;

// How often a request is looked up again in a program that has just come.
constexpr int kTries = 5;

// Does to the program that is loaded what `act` asks for. Where another one has come since it was read,
// nothing has been done: it is read, and `act` looks its names up in that one. Whoever asked is told.
result::Result<void> in_loaded_program(Attached& runtime, const std::function<result::Result<void>()>& act) {
  if (auto read = runtime.read_program(); !read) return read;
  auto done = act();
  for (int i = 1; !done && done.error().front().code == service::kOtherProgram && i < kTries; ++i) {
    if (auto read = runtime.read_program(); !read) return read;
    std::printf("another program has been loaded meanwhile: looked up again in that one\n");
    done = act();
  }
  return done;
}

// What is forced in the program that was read.
result::Result<std::vector<image::Force>> read_forces(Attached& runtime) {
  auto reply = runtime.ask(service::ReadForces{});
  if (!reply) return result::forward(reply);
  if (reply->digest != runtime.digest())
    return result::fail(service::kOtherProgram, {}, "another program was loaded while this one was read",
                        "try again");
  return service::decode_forces(reply->data);
}

service::ProgramNames names_of(const Attached& runtime) {
  return {runtime.digest(), runtime.program()};
}

result::Result<void> force_once(Attached& runtime, const ForceArguments& arguments) {
  auto wanted = names_of(runtime).value(arguments.name, arguments.value);
  if (!wanted) return result::forward(wanted);
  const auto duration_ms = static_cast<std::uint64_t>(arguments.seconds * kMsPerS);
  auto reply = runtime.ask(service::Force{{wanted->bits, duration_ms}});
  if (!reply) return result::forward(reply);
  std::printf("%s is forced to %s\n", wanted->name.c_str(), wanted->text.c_str());
  return {};
}

result::Result<void> unforce_once(Attached& runtime, const ForceArguments& arguments) {
  if (!arguments.all) {
    auto place = names_of(runtime).forceable(arguments.name);
    if (!place) return result::forward(place);
    auto reply = runtime.ask(service::Unforce{place->bits});
    if (!reply) return result::forward(reply);
    std::printf("%s is no longer forced\n", place->name.c_str());
    return {};
  }
  auto forces = read_forces(runtime);
  if (!forces) return result::forward(forces);
  for (const image::Force& force : *forces) {
    auto reply = runtime.ask(service::Unforce{{runtime.digest(), image::bits_of(force)}});
    if (!reply) return result::forward(reply);
  }
  std::printf("%s no longer forced\n",
              result::counted(forces->size(), "variable is", "variables are").c_str());
  return {};
}

void print_force(const service::ForcedValue& one, const image::Force& force, nlohmann::json& list) {
  const double left_s = static_cast<double>(force.end_ns) / kNsPerS;
  std::printf("%s = %s", one.name.c_str(), reader::read_printable(one.variable, one.image).c_str());
  if (one.ends) std::printf(", for another %.1f s", left_s);
  std::printf("\n");
  list.push_back({{"name", one.name},
                  {"value", trace::to_json(reader::read_value(one.variable, one.image))},
                  {"left_s", one.ends ? nlohmann::json(left_s) : nlohmann::json()}});
}

using Once = result::Result<void> (*)(Attached&, const ForceArguments&);

result::Result<void> attend(const config::CellConfig& config, const ForceArguments& arguments, Once once) {
  auto runtime = Attached::open(config, service::Role::Controller);
  if (!runtime) return result::forward(runtime);
  return in_loaded_program(**runtime, [&] { return once(**runtime, arguments); });
}

int exit_code(const result::Result<void>& done) {
  return done ? to_int(ExitCode::Done) : fail(done.error(), ExitCode::BadInput);
}

}  // namespace

int force(const config::CellConfig& config, const ForceArguments& arguments) {
  return exit_code(attend(config, arguments, force_once));
}

int unforce(const config::CellConfig& config, const ForceArguments& arguments) {
  return exit_code(attend(config, arguments, unforce_once));
}

int list_forces(const config::CellConfig& config, const ForceArguments& arguments) {
  auto runtime = Attached::open(config, service::Role::Observer);
  if (!runtime) return fail(runtime.error(), ExitCode::BadInput);
  std::vector<image::Force> forces;
  const auto read = in_loaded_program(**runtime, [&]() -> result::Result<void> {
    auto forced_now = read_forces(**runtime);
    if (!forced_now) return result::forward(forced_now);
    forces = std::move(*forced_now);
    return {};
  });
  if (!read) return fail(read.error(), ExitCode::BadInput);
  nlohmann::json list = nlohmann::json::array();
  const service::ProgramNames names = names_of(**runtime);
  for (const image::Force& force : forces) print_force(names.forced(force), force, list);
  std::printf("%zu of %zu places are forced\n", forces.size(), image::ForceTable::kCapacity);
  return finish(arguments.json_file, {{"forces", std::move(list)}});
}

}  // namespace stepwright::monitor
