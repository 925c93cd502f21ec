#include "programs/demo/cell_run.h"

#include <cstdio>
#include <fstream>
#include <sstream>
#include <thread>
#include <utility>

#include "programs/demo/setup_token_printer.h"
#include "runtime/ground/files/files.h"

namespace stepwright::demo {
namespace {

constexpr int kMaxRestarts = 20;  // of one process; more means that it cannot live
constexpr std::chrono::seconds kEmulatorPatience{10};

std::string content(const std::filesystem::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// Why a report may be missing: whether so much can be written there tells it best. Empty: it can.
std::string why_unwritten(const std::filesystem::path& folder) {
  constexpr std::size_t kBytes = 64 << 10;
  const std::filesystem::path probe = folder / "report.probe";
  const auto unwritten = files::write_file(probe.string(), std::string(kBytes, ' '));
  std::error_code ignored;
  std::filesystem::remove(probe, ignored);
  return unwritten.empty() ? std::string() : unwritten.front().message;
}

}  // namespace

CellRun::CellRun(CellRunOptions options)
    : options_(std::move(options)),
      programs_(std::filesystem::read_symlink("/proc/self/exe").parent_path()) {}

std::filesystem::path CellRun::line_link() const {
  return options_.state_dir / "controller.line";
}

std::filesystem::path CellRun::log_of(const std::string& name) const {
  return options_.state_dir / (name + ".log");
}

result::Result<CellRun::Member> CellRun::start_emulator() const {
  const std::filesystem::path log = log_of(options_.emulator->name);
  std::error_code error;
  const auto written = std::filesystem::file_size(log, error);
  auto process = process::ChildProcess::start({.arguments = options_.emulator->arguments, .log = log});
  if (!process) return result::forward(process);
  auto line = EmulatorLine::open(*process, log, error ? 0 : written, line_link(), kEmulatorPatience);
  if (!line) return result::forward(line);
  return Member{options_.emulator->name, std::move(*process), std::move(*line)};
}

result::Result<CellRun::Member> CellRun::start(const std::string& name) const {
  if (options_.emulator && name == options_.emulator->name) return start_emulator();
  std::vector<std::string> arguments = {(programs_ / ("stepwright-" + name)).string(), name, "--config",
                                        options_.config.string()};
  for (const std::string& entry : options_.overrides) {
    arguments.push_back("--set");
    arguments.push_back(entry);
  }
  if (options_.emulator) {
    arguments.insert(arguments.end(), {"--set", "controller.device=\"" + line_link().string() + "\""});
  }
  // A demonstration shows its page, with history and alarms, to whoever started it. To act on it somebody
  // logs in.
  if (name == "hmi") {
    arguments.insert(arguments.begin() + 4, {"--set", "hmi.anonymous=viewer"});
    arguments.insert(arguments.end(), {"--history", (options_.state_dir / "history").string()});
  }
  // Without a page there is nobody who could start it.
  if (name == "supervisor" && !options_.page)
    arguments.insert(arguments.end(), {"--set", "executive.start=auto", "--once"});
  auto process = process::ChildProcess::start(
      {.arguments = arguments, .log = log_of(name), .environment = {listener_->variable()}});
  if (!process) return result::forward(process);
  return Member{name, std::move(*process)};
}

void CellRun::hear(std::vector<Member>& members) {
  for (process::Notice& notice : listener_->take()) {
    for (Member& member : members) {
      if (member.process.pid() != notice.sender) continue;
      member.ready = member.ready || notice.ready;
      if (notice.status) member.status = std::move(*notice.status);
    }
  }
}

std::optional<std::string> CellRun::page_of(const std::vector<Member>& members) {
  std::optional<std::string> address;
  for (const Member& member : members) {
    if (member.name != "hmi" && member.name != "supervisor") continue;
    if (!member.ready) return std::nullopt;
    if (member.name == "hmi") address = member.status;
  }
  return address;
}

void CellRun::take_report(CellRunResult& result) const {
  const std::filesystem::path file = options_.state_dir / "report.json";
  if (result.report || !std::filesystem::exists(file)) return;
  if (auto report = run::report_from_json(content(file), file.string())) {
    result.exit = report->record.exit;
    result.report = std::move(*report);
  }
}

// Who has refused its input has said why; nobody else ends well without a report.
void CellRun::tell_missing_report(const process::ExitStatus& ended, CellRunResult& result) const {
  const auto exit = static_cast<result::ExitCode>(ended.code);
  result.exit = exit == result::ExitCode::Done ? result::ExitCode::RuntimeFault : exit;
  result.message = content(log_of("supervisor"));
  const bool refused = exit == result::ExitCode::BadInput || exit == result::ExitCode::Usage;
  if (refused && !result.message.empty()) return;
  const std::string why = why_unwritten(options_.state_dir);
  const auto missing = result::fail(
      "M0010", {(options_.state_dir / "report.json").string(), 0, 0},
      "the supervisor has ended with " + std::to_string(ended.code) + " and has left no report" +
          (why.empty() ? "" : ": " + why),
      why.empty() ? "what it said stands before this" : "make room there, or name another --state-dir");
  result.message += result::to_string(missing.value()) + "\n";
}

result::Result<bool> CellRun::tend(Member& member, CellRunResult& result) {
  const auto status = member.process.poll();
  if (!status) return true;
  if (member.name == "supervisor" && !status->killed) {
    take_report(result);
    if (!result.report) tell_missing_report(*status, result);
    return false;
  }
  const bool refused = !status->killed && (status->code == to_int(result::ExitCode::BadInput) ||
                                           status->code == to_int(result::ExitCode::Usage));
  if (refused || ++result.restarts[member.name] > kMaxRestarts) {
    result.exit = refused ? static_cast<result::ExitCode>(status->code) : result::ExitCode::RuntimeFault;
    result.message =
        member.name + " ended with " + std::to_string(status->code) + ":\n" + content(log_of(member.name));
    return false;
  }
  auto again = start(member.name);
  if (!again) return result::forward(again);
  member = std::move(*again);
  return true;
}

// They are ended in the reverse order, so that nobody mourns a process that was ended on purpose.
result::Result<void> CellRun::start_all(std::vector<Member>& members, CellRunResult& result) const {
  std::vector<std::string> names = {options_.scan, "link", "supervisor"};
  if (options_.emulator) names.insert(names.begin(), options_.emulator->name);
  if (options_.page) names.emplace_back("hmi");
  for (const std::string& name : names) {
    auto member = start(name);
    if (!member) return result::forward(member);
    result.processes.push_back(name);
    members.push_back(std::move(*member));
  }
  return {};
}

result::Result<CellRunResult> CellRun::run(const std::atomic<bool>& stop) {
  CellRunResult result;
  std::vector<Member> members;
  auto listener = process::NotifyListener::open();
  if (!listener) return result::forward(listener);
  listener_ = std::move(*listener);
  SetupTokenPrinter printer(log_of("hmi"));
  if (auto started = start_all(members, result); !started) return result::forward(started);
  bool reported = false;
  bool told = false;
  for (bool going = true; going && !stop;) {
    for (std::size_t i = 0; going && i < members.size(); ++i) {
      auto tended = tend(members[i], result);
      if (!tended) return result::forward(tended);
      going = *tended;
    }
    hear(members);
    if (options_.page) {
      take_report(result);
      const auto page = told ? std::nullopt : page_of(members);
      if (page) {
        std::printf("Open %s in a browser; Ctrl-C ends the demo.\n", page->c_str());
        std::fflush(stdout);
        told = true;
      }
      if (told) printer.look();
    }
    if (result.report && !std::exchange(reported, true) && options_.page) {
      std::printf("%s", run::report_table(result.report->record).c_str());
      std::fflush(stdout);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  // With a page that is how a demo ends; without one it has not done what it was started for.
  if (stop && !options_.page && !result.report && result.message.empty()) {
    result.exit = result::ExitCode::RuntimeFault;
    result.message = "interrupted before the run was over\n";
  }
  while (!members.empty()) members.pop_back();
  return result;
}

}  // namespace stepwright::demo
