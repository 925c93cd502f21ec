// `stepwright hmi --config CELL.toml [--port N] [--history FOLDER]`: shows the cell in a browser and lets
// those act on it who may. Attaches over Fast DDS only, so that it can come, go and fail without any effect
// on the scan. `--openapi` and `--verify-audit FILE` need no cell.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "cell/config/cell_options.h"
#include "cell/config/reload_log.h"
#include "cell/hmi/notify_channels.h"
#include "cell/hmi/plant_picture.h"
#include "cell/tags/tag_notes.h"
#include "hmi_web/client/client_assets.h"
#include "hmi_web/drawing/drawing_file.h"
#include "hmi_web/monitor/cell_monitor.h"
#include "hmi_web/notify/curl_sender.h"
#include "hmi_web/notify/notifier.h"
#include "hmi_web/server/cell_poller.h"
#include "hmi_web/server/http_server.h"
#include "programs/hmi/access_point.h"
#include "programs/hmi/dds_cell_change.h"
#include "programs/hmi/dds_cell_control.h"
#include "programs/hmi/dds_cell_source.h"
#include "programs/hmi/recording.h"
#include "programs/hmi/runtime_watch.h"
#include "programs/hmi/source_cache.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/notify_socket.h"
#include "runtime/ground/process/reload_signal.h"
#include "runtime/ground/process/stop_signal.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright {
namespace {

using process::fail;
using result::ExitCode;

constexpr std::chrono::milliseconds kTurn{200};

int run(const config::CellConfig& config) {
  const process::StopSignal stop;
  process::ReloadSignal reload;
  process::NotifySocket init;
  auto log = log::Logger::open("hmi", config.log);
  if (!log) return fail(log.error(), ExitCode::BadInput);
  config::CellConfig running = config;
  const auto picture = hmi::picture_of(config.plant);
  if (!picture) return fail(picture.error(), ExitCode::BadInput);
  drawing::Drawing drawn;
  if (const auto& file = config.hmi.drawing; !file.empty()) {
    auto read = drawing::load_drawing(file);
    if (!read) return fail(read.error(), ExitCode::BadInput);
    drawn = std::move(*read);
    for (const result::Diagnostic& each : drawn.warnings) (*log)->warning("setup", result::to_string(each));
  } else if (!picture->drawing.empty()) {
    // A hall with more corners than a page can draw is shown without a picture.
    auto made = drawing::read_drawing("picture of the plant", picture->drawing);
    if (made)
      drawn = std::move(*made);
    else
      (*log)->warning("setup", result::to_string(made.error()));
  }
  server::Feed feed({config.name, STEPWRIGHT_VERSION, !config.hmi.recipes.empty(), !drawn.svg.empty(),
                     tags::tag_notes(config.tags)},
                    picture->synoptic, {.state_spacing = config.hmi.refresh});
  const auto where = hmi::listening_of(config.hmi);
  if (!where) return fail(where.error(), ExitCode::BadInput);
  // The port first: it fails at once, and before anything else has begun.
  auto http = server::HttpServer::listen(
      {where->host, config.hmi.port, "hmi", config.hmi.certificate, config.hmi.key, config.hmi.names},
      client::client_assets(), feed);
  if (!http) return fail(http.error(), ExitCode::BadInput);
  auto source = hmi::DdsCellSource::connect(config, **log);
  if (!source) return fail(source.error(), ExitCode::RuntimeFault);

  auto records = hmi::Recording::open(config, picture->synoptic, **log);
  if (!records) return fail(records.error(), ExitCode::BadInput);
  auto watch = hmi::RuntimeWatch::connect(config, (*source)->runtime(), **log);
  if (!watch) return fail(watch.error(), ExitCode::RuntimeFault);
  notify::CurlSender sender;
  notify::NotificationStore told(config.history.folder / "notified.json");
  std::unique_ptr<notify::Notifier> notifier;
  if (!config.notify.empty()) {
    if (!*records)
      (*log)->warning("notify", "nobody is told of alarms: the cell keeps none",
                      {{"hint", "[history] folder = \"history\""}});
    else
      notifier = std::make_unique<notify::Notifier>(
          config.name, hmi::notify_channels(config.notify), sender,
          [&] { return (*records)->unacknowledged(); },
          [&](const std::string& channel, bool failing, const std::string& what) {
            if (failing)
              (*log)->error("notify", "'" + channel + "' cannot be told of alarms: " + what);
            else
              (*log)->info("notify", "'" + channel + "' is told of alarms again");
          },
          &told);
  }
  hmi::DdsCellControl control(**source, tags::tag_notes(config.tags));
  hmi::SourceCache program((*source)->running());
  monitor::CellMonitor monitor;
  hmi::DdsCellChange change(**source, config);
  auto access =
      hmi::AccessPoint::open(config.hmi, (*http)->port(),
                             {control, records->get(), watch->get(), drawn.svg.empty() ? nullptr : &drawn.svg,
                              &program, &change, &monitor, notifier.get()},
                             **log, [&](const std::string& list) {
                               feed.set_forces(list);
                               (*http)->notify();
                             });
  if (!access) return fail(access.error(), ExitCode::BadInput);
  (*http)->serve_api((*access)->guard());
  if (where->held_back) {
    (*log)->warning("setup",
                    "listens at this machine only until somebody has claimed the administrator and the "
                    "server is started again");
  }

  const auto record = [&](const std::shared_ptr<const server::Observation>& seen,
                          const server::CellView& view) {
    monitor.take(seen);
    if (!*records) return;
    auto news = (*records)->take(*seen, view);
    if (!news) return;
    feed.set_alarms(std::move(*news));
    (*http)->notify();
  };
  (*http)->serve_metrics([&] { return (*watch)->metrics(); }, std::string(metrics::kContentType));

  const auto trouble = [&](const std::string& what) { (*log)->error("server", "a step failed: " + what); };
  (*http)->tell_trouble(trouble);
  std::thread network([&] { (*http)->run(); });
  {
    const server::CellPoller poller(
        **source, server::CellViewer(picture->sources), feed, [&] { (*http)->notify(); }, record, trouble);
    const std::string address = config::page_address(config.hmi, where->host, (*http)->port());
    (*log)->info("listens", "cell " + config.name + " at " + address,
                 {{"cell", config.name}, {"address", address}});
    init.ready(address);
    process::Heartbeat heartbeat(init);
    while (!stop.wait_for(kTurn)) {
      if (reload.take()) config::reload_log(running, **log, init);
      heartbeat.turn();
      (*access)->turn();
      (*log)->tick();
    }
  }
  init.stopping();
  (*http)->stop();
  network.join();
  return to_int(ExitCode::Done);
}

}  // namespace
}  // namespace stepwright

int main(int argc, char** argv) {
  CLI::App app{"Show the cell in a browser", "stepwright hmi"};
  stepwright::config::CellOptions options;
  std::optional<std::uint16_t> port;
  bool openapi = false;
  std::string audit, history;
  stepwright::config::add_cell_options(app, options);
  app.get_option("--config")->required(false);
  app.add_option("--port", port, "instead of hmi.port of the configuration; 0 takes any free port");
  app.add_option("--history", history, "folder for values and alarms, instead of history.folder");
  app.add_flag("--openapi", openapi, "print the API as an OpenAPI 3.1 document, and end");
  app.add_option("--verify-audit", audit,
                 "check the chain of an audit trail, name the first wrong line, and end");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  if (openapi) return stepwright::hmi::print_openapi();
  if (!audit.empty()) return stepwright::hmi::verify_audit(audit);
  if (options.config.empty()) {
    std::fputs("--config is required\nRun with --help for more information.\n", stderr);
    return to_int(stepwright::result::ExitCode::Usage);
  }
  auto config = stepwright::config::load_cell(options);
  if (!config) return config.error();
  if (port) config->hmi.port = *port;
  if (!history.empty()) config->history.folder = std::filesystem::absolute(history).lexically_normal();
  return stepwright::run(*config);
}
