// hmi_scripted_cell [PORT [SPEED [START_S [HISTORY]]]]: the real HMI server over a scripted bench, for the
// browser test, open to whoever looks. With a folder for its history there are users, too: operator,
// engineer, password "correct horse". Prints its address, and stands still until its input says how far to
// go: "run" to the end of the script, "run 30" to its second 30. "runtime off" and "runtime on" end and
// restart the runtime that it plays, "huge" fills a2 far beyond its edge, and "later 40" lets 40 minutes pass
// for whoever is logged in.

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <string>
#include <thread>

#include "hmi_web/api/routes.h"
#include "hmi_web/client/client_assets.h"
#include "hmi_web/monitor/cell_monitor.h"
#include "hmi_web/recorder/record_queries.h"
#include "hmi_web/server/cell_poller.h"
#include "hmi_web/server/http_server.h"
#include "tests/browser/scripted_cell.h"
#include "tests/support/temporary_folder.h"

using namespace stepwright;

namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

// With what every cell is watched for; null without a folder.
std::unique_ptr<recorder::CellRecorder> open_recorder(const char* folder) {
  if (folder == nullptr) return nullptr;
  recorder::RecorderOptions options;
  options.folder = folder;
  options.points = browser::bench_synoptic().points;
  options.alarms = recorder::built_in_alarms(browser::bench_synoptic(), {.supervisor = true});
  const auto now = [] {
    return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
  };
  auto made = recorder::CellRecorder::open(std::move(options), now);
  if (made) return std::move(*made);
  std::fputs(result::to_string(made.error()).c_str(), stderr);
  std::exit(1);
}

// Nobody acts on a script.
class NoControl : public api::CellControl {
 public:
  result::Result<void> ask_supervisor(const std::string&) override { return nobody(); }
  std::string goal_form() override { return {}; }
  std::string outlook() override { return {}; }
  result::Result<void> stop_runtime(const std::string&) override { return nobody(); }
  result::Result<std::string> read(const std::string&) override { return nobody(); }
  std::shared_ptr<const reader::ProgramInfo> program() override { return nullptr; }
  result::Result<std::string> spell(const std::string&, const std::string&) override { return nobody(); }
  result::Result<std::string> write(const std::string&, const std::string&) override { return nobody(); }
  result::Result<std::string> force(const std::string&, const std::string&,
                                    std::chrono::milliseconds) override {
    return nobody();
  }
  result::Result<void> unforce(const std::string&) override { return nobody(); }
  result::Result<void> write_together(const std::map<std::string, std::string, std::less<>>&) override {
    return nobody();
  }
  result::Result<std::vector<host::PlantFault>> faults() override { return std::vector<host::PlantFault>{}; }
  result::Result<void> set_fault(const std::string&, std::optional<double>) override { return nobody(); }
  result::Result<std::vector<api::ForcedPlace>> forced() override { return nobody(); }
  result::Result<api::ForcedPlace> as_forced(const std::string&, const std::string&) override {
    return nobody();
  }

 private:
  static tl::unexpected<result::Diagnostics> nobody() {
    return result::fail("D0001", {}, "a script takes no requests");
  }
};

// What it opens and makes it does not check: a test that has no folder fails loudly.
struct OpenAccess {
  // With records there is something to do, and there are those who may.
  OpenAccess(api::CellRecords* kept, api::CellMonitor& watched) : records(kept), monitor(watched) {
    if (records == nullptr) return;
    bool made =
        control->claim(*control->setup_token(), "administrator", "correct horse", "127.0.0.1").has_value();
    for (const access::Role role : {access::Role::Engineer, access::Role::Operator})
      made = made && control->add_user(access::to_string(role), role, "correct horse");
    if (!made) std::exit(1);
  }

  api::CellRecords* records;
  api::CellMonitor& monitor;
  std::atomic<std::chrono::minutes> ahead{std::chrono::minutes(0)};  // of the clock of its sessions
  support::TemporaryFolder folder;
  NoControl cell;
  std::unique_ptr<access::AccessControl> control = *access::AccessControl::open(
      folder / "access", {}, [this] { return std::chrono::steady_clock::now() + ahead.load(); });
  std::unique_ptr<access::AuditLog> audit = *access::AuditLog::open(folder / "access/audit.jsonl");
  std::unique_ptr<api::ForceService> forces = *api::ForceService::open(
      folder / "access/forces.json", cell, *audit, std::chrono::system_clock::now, [](const std::string&) {});
  std::unique_ptr<trends::TrendStore> trends = *trends::TrendStore::open(folder / "access/trends.json");
  api::RouteTable table{api::all_routes({.control = control.get(),
                                         .audit = audit.get(),
                                         .forces = forces.get(),
                                         .cell = &cell,
                                         .records = records,
                                         .monitor = &monitor,
                                         .trends = trends.get(),
                                         .wall = {"alarms", "synoptic", "trend"}})};
  api::RequestGuard guard{table, *control, *audit, {access::Role::Viewer}};
};

}  // namespace

int main(int argc, char** argv) {
  const auto port = static_cast<std::uint16_t>(argc > 1 ? std::atoi(argv[1]) : 0);
  browser::ScriptedCell cell(argc > 2 ? std::atof(argv[2]) : 1, argc > 3 ? std::atof(argv[3]) : 0);
  // Often enough for a page whose motion nobody looks at.
  server::Feed feed({"bench", "test"}, browser::bench_synoptic(),
                    {.state_spacing = std::chrono::milliseconds(100)});
  auto http = server::HttpServer::listen({"127.0.0.1", port}, client::client_assets(), feed);
  if (!http) {
    std::fputs(result::to_string(http.error()).c_str(), stderr);
    return 1;
  }
  const auto recorder = open_recorder(argc > 4 ? argv[4] : nullptr);
  std::optional<recorder::RecordQueries> records;
  if (recorder) records.emplace(*recorder);
  monitor::CellMonitor monitor;
  OpenAccess access(records ? &*records : nullptr, monitor);
  (*http)->serve_api(access.guard);
  const auto record = [&](const std::shared_ptr<const server::Observation>& seen,
                          const server::CellView& view) {
    monitor.take(seen);
    if (!recorder) return;
    auto news = recorder->take(*seen, view);
    if (!news) return;
    feed.set_alarms(std::move(*news));
    (*http)->notify();
  };
  std::thread network([&] { (*http)->run(); });
  {
    const server::CellPoller poller(
        cell, server::CellViewer(browser::ScriptedCell::point_sources()), feed, [&] { (*http)->notify(); },
        record);
    std::printf("http://127.0.0.1:%d/\n", (*http)->port());
    std::fflush(stdout);
    // Until the input ends: with the test that started it.
    for (std::string line; std::getline(std::cin, line);) {
      if (line == "runtime off") cell.set_runtime_alive(false);
      if (line == "runtime on") cell.set_runtime_alive(true);
      if (line == "huge") cell.fill_beyond_its_edge();
      if (line.starts_with("later ")) access.ahead = std::chrono::minutes(std::stoi(line.substr(6)));
      if (line == "run") cell.run_until(kForever);
      if (line.starts_with("run ")) cell.run_until(std::stod(line.substr(4)));
    }
  }
  (*http)->stop();
  network.join();
  return 0;
}
