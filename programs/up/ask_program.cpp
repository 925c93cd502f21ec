#include "programs/up/ask_program.h"

#include <chrono>
#include <variant>

#include "runtime/host/state_name.h"
#include "runtime/service/connection.h"

namespace stepwright::up {
namespace {

using processes::ProgramRecord;

// A runtime sends its status ten times a second, and the first with its greeting.
constexpr std::chrono::seconds kPatience{2};

ProgramRecord program_of(const host::RuntimeStatus& status, const std::string& clock) {
  ProgramRecord program;
  program.state = host::name_of(status.state);
  program.mode = clock + " clock";
  if (status.waiting_for_supervisor) program.mode += ", waiting for the supervisor";
  program.detail = status.detail;
  return program;
}

}  // namespace

ProgramRecord ask_program(const config::CellConfig& config, const std::string& clock) {
  auto connection = service::Connection::open(config.socket_path(), {.name = "status"});
  if (!connection) return {kNoAnswer, "no answer", result::to_string(connection.error())};
  while (auto message = (*connection)->receive(kPatience))
    if (const auto* status = std::get_if<host::RuntimeStatus>(&*message)) return program_of(*status, clock);
  return {kNoAnswer, "no answer", "it is served, and sends no status"};
}

bool is_in_fault(const ProgramRecord& program) {
  return program.state == host::name_of(host::RuntimeState::Fault);
}

bool is_missing(const ProgramRecord& program, const config::CellConfig& config) {
  const bool named = !config.boot.program.empty() && !config.controller.remote();
  return program.state == kNoAnswer || (named && program.state == host::name_of(host::RuntimeState::Empty));
}

}  // namespace stepwright::up
