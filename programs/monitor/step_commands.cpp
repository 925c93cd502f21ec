#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "programs/monitor/attach.h"
#include "programs/monitor/commands.h"
#include "programs/monitor/report.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::monitor {
namespace {

using namespace std::chrono_literals;
using process::fail;
using result::ExitCode;

// How long a runtime may rest before its status is believed to say why.
constexpr auto kRest = 500ms;

// Why the scans that were asked for do not come; empty if nothing says so.
std::string reason(const host::RuntimeStatus& status) {
  if (status.waiting_for_supervisor) return "a barrier holds: the rest runs when its event is acknowledged";
  if (status.state == host::RuntimeState::Running) return {};
  if (status.state == host::RuntimeState::Fault) return "the program has ended by a fault: " + status.detail;
  return "the program does not run: it stands at its first scan when it is started";
}

struct Stepped {
  host::Snapshot snapshot;
  std::string held;  // why it is not where it should be
};

// Runs that many scans and gives the image after them.
result::Result<Stepped> run_scans(Attached& runtime, std::uint64_t scans) {
  auto reply = runtime.ask(service::Step{scans});
  if (!reply) return result::forward(reply);
  auto progress_at = std::chrono::steady_clock::now();
  std::uint64_t last = 0;
  while (true) {
    auto snapshot = runtime.sample();
    if (!snapshot) return result::forward(snapshot);
    if (snapshot->scan >= reply->offset) return Stepped{std::move(*snapshot), {}};
    const auto now = std::chrono::steady_clock::now();
    if (std::exchange(last, snapshot->scan) != snapshot->scan) progress_at = now;
    if (now - progress_at > kRest) {
      const auto status = runtime.status();
      std::string why = status ? reason(*status) : std::string();
      if (!why.empty()) return Stepped{std::move(*snapshot), std::move(why)};
    }
    std::this_thread::sleep_for(200us);
  }
}

void print_changes(const reader::ProgramInfo& info, const host::Snapshot& before, const host::Snapshot& now,
                   nlohmann::json& json) {
  std::printf("%s\n", moment(now.scan, now.time_ns).c_str());
  nlohmann::json changes = nlohmann::json::array();
  for (const reader::Tag& tag : info.tags()) {
    const std::string from = reader::read_text(tag.variable, before.image);
    const std::string to = reader::read_text(tag.variable, now.image);
    if (from == to) continue;
    std::printf("  %s: %s -> %s\n", tag.name.c_str(),
                reader::read_printable(tag.variable, before.image).c_str(),
                reader::read_printable(tag.variable, now.image).c_str());
    changes.push_back({{"name", tag.name}, {"from", from}, {"to", to}});
  }
  json.push_back({{"scan", now.scan},
                  {"time_s", static_cast<double>(now.time_ns) / 1e9},
                  {"changes", std::move(changes)}});
}

}  // namespace

int step(const config::CellConfig& config, const StepArguments& arguments) {
  auto runtime = Attached::open(config, service::Role::Controller);
  if (!runtime) return fail(runtime.error(), ExitCode::BadInput);
  if (auto read = (*runtime)->read_program(); !read) return fail(read.error(), ExitCode::BadInput);
  nlohmann::json steps = nlohmann::json::array();
  // Standing still first: what is printed is then what the scans asked for have done.
  auto at = run_scans(**runtime, 0);
  std::uint64_t left = arguments.scans;
  while (at && at->held.empty() && left > 0) {
    const std::uint64_t scans = arguments.changes ? 1 : left;
    left -= scans;
    auto next = run_scans(**runtime, scans);
    if (next && next->held.empty() && arguments.changes) {
      print_changes((*runtime)->program(), at->snapshot, next->snapshot, steps);
    }
    at = std::move(next);
  }
  if (!at) return fail(at.error(), ExitCode::BadInput);
  std::printf("stands after %s\n", moment(at->snapshot.scan, at->snapshot.time_ns).c_str());
  if (!at->held.empty()) std::printf("note: %s\n", at->held.c_str());
  return finish(arguments.json_file, {{"scan", at->snapshot.scan},
                                      {"time_s", static_cast<double>(at->snapshot.time_ns) / 1e9},
                                      {"held", at->held},
                                      {"steps", std::move(steps)}});
}

int go_on(const config::CellConfig& config) {
  auto runtime = Attached::open(config, service::Role::Controller);
  if (!runtime) return fail(runtime.error(), ExitCode::BadInput);
  auto reply = (*runtime)->ask(service::Continue{});
  if (!reply) return fail(reply.error(), ExitCode::BadInput);
  std::printf("goes on\n");
  return to_int(ExitCode::Done);
}

}  // namespace stepwright::monitor
