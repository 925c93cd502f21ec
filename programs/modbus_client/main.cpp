// `stepwright modbus-client --config CELL.toml`: physical devices over Modbus as the I/O of a cell. It is the
// plant's side of the cell's shared-memory I/O: what devices say becomes the inputs, what the runtime (or its
// guard) drives goes to the devices. SIGTERM brings the devices' outputs to their safe state for lost I/O and
// ends it.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "cell/config/cell_options.h"
#include "cell/config/reload_log.h"
#include "cell/config/state_dir.h"
#include "cell/device_status/status_socket.h"
#include "cell/metrics_server/metrics_server.h"
#include "cell/modbus_client/client_metrics.h"
#include "cell/modbus_client/field_outputs.h"
#include "cell/modbus_client/status_json.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/notify_socket.h"
#include "runtime/ground/process/reload_signal.h"
#include "runtime/ground/process/stop_signal.h"
#include "runtime/ground/result/counted.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/io_memory/plant_side.h"
#include "runtime/modbus/client/poll/io_client.h"

namespace stepwright::modbus_client {
namespace {

using modbus::client::IoClient;
using result::ExitCode;
using std::chrono::milliseconds;

struct Options {
  bool status = false;
  bool metrics = false;
  std::string json;
};

// How long the safe outputs may take at the end: a device that does not answer keeps nobody.
constexpr milliseconds kFinalWrite{1'000};

std::string json_text(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

int tell_status(const config::CellConfig& config, const Options& options) {
  const auto text = device_status::ask_status(config.modbus_client_path());
  if (!text) return process::fail(text.error(), ExitCode::RuntimeFault);
  const auto status = nlohmann::json::parse(*text, nullptr, false);
  if (status.is_discarded()) {
    return process::fail({{"R0127",
                           result::Severity::Error,
                           {config.modbus_client_path().string(), 0, 0},
                           "the Modbus client broke off",
                           ""}},
                         ExitCode::RuntimeFault);
  }
  if (!options.json.empty()) {
    const result::Diagnostics failed = files::write_file(options.json, json_text(status));
    if (!failed.empty()) return process::fail(failed, ExitCode::BadInput);
  }
  std::fputs((options.metrics ? to_metrics(status) : to_lines(status)).c_str(), stdout);
  return to_int(ExitCode::Done);
}

// Who came and went since the last turn, and whether the program may rely on its inputs.
class Journal {
 public:
  explicit Journal(log::Logger& log) : log_(log) {}

  void turn(IoClient& client, bool lost, bool deserted) {
    for (const modbus::client::DeviceNews& news : client.take_news()) {
      if (news.online) {
        log_.info("online", "device '" + news.device + "' answers", {{"device", news.device}});
      } else {
        log_.warning("offline", "device '" + news.device + "': " + news.reason,
                     {{"device", news.device}, {"reason", news.reason}});
      }
    }
    if (lost != lost_) {
      lost ? log_.error("lost", "a device without which the program must not run is lost: the I/O is lost")
           : log_.info("complete", "all devices that the program needs are there");
    }
    if (deserted != deserted_) {
      deserted
          ? log_.error("deserted", "neither runtime nor guard is heard of: the outputs take their safe state")
          : log_.info("driven", "the outputs are driven again");
    }
    lost_ = lost;
    deserted_ = deserted;
  }

 private:
  log::Logger& log_;
  bool lost_ = true;
  bool deserted_ = false;
};

void write_final_outputs(IoClient& client, FieldOutputs& field, log::Logger& log) {
  const auto outputs = field.last();
  if (!outputs) return;
  client.set_outputs(*outputs);
  const auto deadline = std::chrono::steady_clock::now() + kFinalWrite;
  while (!client.written() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(milliseconds(1));
  if (!client.written()) log.warning("unwritten", "not every device has acknowledged its safe outputs");
}

result::Result<std::unique_ptr<io_memory::PlantSide>> open_area(const config::CellConfig& config) {
  if (!config.safety.io.modbus) {
    return result::fail("C0526", {config.file.string(), 0, 0}, "the I/O of this cell is not over Modbus",
                        "[io] kind = \"modbus\" and [[modbus.device]]");
  }
  if (auto made = config::claim_state_dir(config); !made) return result::forward(made);
  return io_memory::PlantSide::open(config.safety.io.name, config.image.input_bytes,
                                    config.image.output_bytes);
}

int run(const config::CellConfig& config) {
  const process::StopSignal stop;
  process::ReloadSignal reload;
  process::NotifySocket init;
  auto opened = log::Logger::open("modbus-client", config.log);
  if (!opened) return process::fail(opened.error(), ExitCode::BadInput);
  log::Logger& log = **opened;
  auto plant = open_area(config);
  if (!plant) return process::fail(plant.error(), ExitCode::BadInput);
  auto client = IoClient::create(config.modbus_client);
  if (!client) return process::fail(client.error(), ExitCode::BadInput);
  auto server = device_status::StatusServer::create(
      config.modbus_client_path(), [&] { return json_text(to_json(config.name, (*client)->status())); });
  if (!server) return process::fail(server.error(), ExitCode::BadInput);
  auto figures = metrics::MetricsServer::start(config.modbus_client_metrics, "modbus.client.metrics", [&] {
    return to_metrics(to_json(config.name, (*client)->status()));
  });
  if (!figures) return process::fail(figures.error(), ExitCode::BadInput);

  FieldOutputs field(config.safety.host.safe_state.matrix(), config.image.output_bytes,
                     config.modbus_client.holder_timeout);
  std::vector<std::byte> inputs(config.image.input_bytes);
  (*plant)->announce(std::chrono::nanoseconds(config.modbus_client.silence).count(), false);
  const std::string begins =
      "Modbus client of '" + config.name +
      "': " + result::counted(config.modbus_client.devices.size(), "device", "devices") + " on " +
      result::counted((*client)->connections(), "connection", "connections");
  log.info("begins", begins, {{"cell", config.name}, {"devices", config.modbus_client.devices.size()}});
  if (!(*figures)->address().empty()) log.info("metrics", "figures at " + (*figures)->address());
  init.ready(begins);
  config::CellConfig running = config;
  process::Heartbeat heartbeat(init);
  Journal journal(log);
  while (!stop.wait_for(config.modbus_client.cycle)) {
    if (const auto outputs = field.turn(**plant)) (*client)->set_outputs(*outputs);
    (*client)->collect(inputs);
    const bool lost = (*client)->lost();
    lost ? (*plant)->lose(inputs) : (*plant)->write_inputs(inputs);
    journal.turn(**client, lost, field.deserted());
    if (reload.take()) config::reload_log(running, log, init);
    heartbeat.turn();
    log.tick();
  }
  init.stopping();
  write_final_outputs(**client, field, log);
  (*plant)->lose(inputs);
  log.info("ends", "Modbus client of '" + config.name + "' ends");
  return to_int(ExitCode::Done);
}

}  // namespace
}  // namespace stepwright::modbus_client

int main(int argc, char** argv) {
  CLI::App app{"Physical devices over Modbus as the I/O of a cell", "stepwright modbus-client"};
  stepwright::config::CellOptions options;
  stepwright::config::add_cell_options(app, options);
  stepwright::modbus_client::Options client;
  app.add_flag("--status", client.status, "say what the client that runs knows of devices and tags, and end");
  app.add_flag("--metrics", client.metrics, "the same for Prometheus");
  app.add_option("--json", client.json, "with --status: write it to this file, too");
  bool concerned = false;
  app.add_flag("--concerned", concerned,
               "only tell by the exit code whether the I/O of this cell is over Modbus: 0 yes, 1 no");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  if (concerned) {
    return to_int(stepwright::config::concerned(
        options, [](const stepwright::config::CellConfig& cell) { return cell.safety.io.modbus; }));
  }
  const auto config = stepwright::config::load_cell(options);
  if (!config) return config.error();
  const bool asks = client.status || client.metrics;
  return asks ? stepwright::modbus_client::tell_status(*config, client)
              : stepwright::modbus_client::run(*config);
}
