#include "programs/vda5050/publish_command.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <utility>

#include "cell/config/reload_log.h"
#include "programs/vda5050/cell_watch.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/notify_socket.h"
#include "runtime/ground/process/reload_signal.h"
#include "runtime/ground/process/stop_signal.h"
#include "supervisor/fleet/vda5050/fleet_orders.h"
#include "supervisor/fleet/vda5050/link/fleet_publisher.h"

namespace stepwright::vda5050_link {

namespace {

using result::ExitCode;

constexpr std::chrono::milliseconds kTurn{50};

// Ids of orders must not come again when the process does: the time of its start is in them.
std::string plan_name(const std::string& cell) {
  std::string name = fmt::format("{}.{:%Y%m%dT%H%M%S}", cell, fmt::gmtime(std::time(nullptr)));
  for (char& c : name) {
    const bool good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.';
    if (!good) c = '_';
  }
  return name;
}

PublisherOptions options_of(const config::CellConfig& config, const PublishArguments& arguments,
                            mqtt::Options broker) {
  const std::string map = config.plant.fleet.map.stem().string();
  broker.client_id = "stepwright." + config.name;
  return {.broker = std::move(broker),
          .interface_name = arguments.interface_name,
          .manufacturer = arguments.manufacturer,
          .plan_name = plan_name(config.name),
          .map_id = !arguments.map_id.empty() ? arguments.map_id
                    : map.empty()             ? "floor"
                                              : map,
          .times = arguments.times};
}

// What the broker has to do with it, told when it changes.
class BrokerReport {
 public:
  BrokerReport(const mqtt::Options& broker, log::Logger& log) : broker_(broker), log_(log) {}

  // Something that no later attempt mends, before there was any connection.
  std::optional<result::Diagnostic> hopeless(const mqtt::Client& client) const {
    const auto trouble = client.trouble();
    if (!trouble || client.connections() > 0 || trouble->kind == mqtt::TroubleKind::Unreachable) {
      return std::nullopt;
    }
    return explain(*trouble, broker_);
  }

  void tell(const mqtt::Client& client) {
    const auto trouble = client.trouble();
    const std::string said = client.connected() ? "connected"
                             : trouble          ? result::to_string(explain(*trouble, broker_))
                                                : std::string();
    if (said.empty() || said == said_) return;
    said_ = said;
    if (client.connected()) {
      const std::string at = fmt::format("{}:{}", broker_.host, broker_.port);
      log_.info("broker", "connected to the broker " + at, {{"broker", at}});
    } else {
      log_.warning("broker", said);
    }
  }

 private:
  const mqtt::Options& broker_;
  log::Logger& log_;
  std::string said_;
};

void tell(const LinkNews& news, log::Logger& log) {
  for (const std::string& name : news.online) log.info("vehicle", name + " is online", {{"vehicle", name}});
  for (const std::string& name : news.lost) log.warning("vehicle", name + " is offline", {{"vehicle", name}});
  for (const result::Diagnostic& each : news.wrong) {
    const log::Fields fields = {{"code", each.code}};
    if (each.severity == result::Severity::Error) {
      log.error("message", result::to_string(each), fields);
    } else if (each.code == fleet::vda5050::kVehicleComplains) {
      log.debug("vehicle", result::to_string(each), fields);  // in each state again
    } else {
      log.warning("request", result::to_string(each), fields);
    }
  }
}

// What is wrong with names and map, before anything is started.
result::Diagnostics check_names(const PublishArguments& arguments) {
  return check(fleet::vda5050::Address{arguments.interface_name, arguments.manufacturer, "v1"});
}

ExitCode fail(const result::Diagnostics& wrong, ExitCode code) {
  static_cast<void>(process::fail(wrong, code));
  return code;
}

}  // namespace

ExitCode run_publish(const config::CellConfig& config, const PublishArguments& arguments) {
  const process::StopSignal stop(process::OnHangup::End);
  process::ReloadSignal reload;
  process::NotifySocket init;
  if (auto wrong = check_names(arguments); !wrong.empty()) return fail(wrong, ExitCode::BadInput);
  auto broker = broker_of(arguments.broker);
  if (!broker) return fail(broker.error(), ExitCode::BadInput);
  auto log = log::Logger::open("vda5050", config.log);
  if (!log) return fail(log.error(), ExitCode::BadInput);
  for (const auto& warning : broker->warnings) (*log)->warning("broker", result::to_string(warning));
  auto publisher = FleetPublisher::open(options_of(config, arguments, broker->options));
  if (!publisher) return fail(publisher.error(), ExitCode::BadInput);
  auto watch = CellWatch::connect(config, **log);
  if (!watch) return fail(watch.error(), ExitCode::RuntimeFault);
  config::CellConfig running = config;
  BrokerReport report(broker->options, **log);
  init.ready("publishes the fleet of " + config.name);
  process::Heartbeat heartbeat(init);
  std::uint64_t revision = 0;
  while (!stop.came()) {
    tell((*publisher)->turn((*watch)->observe(), kTurn), **log);
    if (const auto end = report.hopeless((*publisher)->client())) return fail({*end}, ExitCode::BadInput);
    report.tell((*publisher)->client());
    if ((*publisher)->revision() != std::exchange(revision, (*publisher)->revision())) {
      (*log)->info("plan",
                   fmt::format("orders of {} vehicles by plan {}", (*publisher)->vehicles(), revision),
                   {{"revision", revision}});
    }
    if (reload.take()) config::reload_log(running, **log, init);
    heartbeat.turn();
    (*log)->tick();
  }
  init.stopping();
  (*publisher)->leave();
  return ExitCode::Done;
}

}  // namespace stepwright::vda5050_link
