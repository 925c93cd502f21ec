#include "cell/check/check_processes.h"

#include "cell/gateway/controller_line.h"
#include "cell/gateway/hand_plan.h"
#include "hmi_web/server/tls_files.h"
#include "runtime/modbus/client/poll/io_client.h"
#include "runtime/modbus/server/tls/tls_context.h"

namespace stepwright::check {
namespace {

// What a try came to; a place where it has none.
template <typename Value>
void note(const result::Result<Value>& tried, const result::Location& where, result::Diagnostics& problems) {
  if (tried) return;
  for (result::Diagnostic each : tried.error()) {
    if (each.where.file.empty()) each.where = where;
    problems.push_back(std::move(each));
  }
}

}  // namespace

result::Diagnostics check_processes(const config::CellConfig& config) {
  result::Diagnostics problems;
  const auto& tls = config.modbus_server.acceptors.tls;
  // Without its files the table is wrong already.
  const bool whole =
      tls && !tls->tls.certificate.empty() && !tls->tls.key.empty() && !tls->tls.authorities.empty();
  if (config.modbus_server.enabled && whole)
    note(modbus::server::TlsContext::create(tls->tls), tls->tls.where, problems);
  if (config.safety.io.modbus)
    note(modbus::client::IoClient::check(config.modbus_client), {config.file.string(), 0, 0}, problems);
  if (!config.hmi.certificate.empty() && !config.hmi.key.empty())
    note(server::check_tls_files(config.hmi.certificate, config.hmi.key), {config.file.string(), 0, 0},
         problems);
  const config::ControllerConfig& controller = config.controller;
  if (controller.remote()) note(gateway::make_line(controller), controller.where, problems);
  if (controller.remote() && controller.loaded_by_hand && !controller.plan.empty())
    note(gateway::read_hand_plan(controller.plan), controller.where, problems);
  return problems;
}

}  // namespace stepwright::check
