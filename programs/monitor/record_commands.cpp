#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "programs/monitor/attach.h"
#include "programs/monitor/commands.h"
#include "programs/monitor/report.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/stop_signal.h"
#include "runtime/ground/result/counted.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/replay/replay_run.h"
#include "runtime/service/monitor_answers.h"

namespace stepwright::monitor {
namespace {

using namespace std::chrono_literals;
using process::fail;
using record::RecordingState;
using record::RecordingStatus;
using result::ExitCode;

constexpr std::uint64_t kMegabyte = 1'000'000;
// For the disk to take what is still on its way.
constexpr auto kWritingPatience = 30s;

result::Result<RecordingStatus> recording(Attached& runtime) {
  auto reply = runtime.ask(service::ReadRecording{});
  if (!reply) return result::forward(reply);
  return service::decode_recording(reply->data);
}

// Ends the recording and waits until all of it is in its file.
result::Result<RecordingStatus> end_recording(Attached& runtime) {
  if (auto ended = runtime.ask(service::EndRecording{}); !ended) return result::forward(ended);
  const auto deadline = std::chrono::steady_clock::now() + kWritingPatience;
  while (true) {
    auto status = recording(runtime);
    const bool writing = status && status->state == RecordingState::Recording;
    if (!writing || std::chrono::steady_clock::now() > deadline) return status;
    std::this_thread::sleep_for(5ms);
  }
}

const char* name_of(RecordingState state) {
  switch (state) {
    case RecordingState::Off:
      return "off";
    case RecordingState::Recording:
      return "recording";
    case RecordingState::Done:
      return "done";
    case RecordingState::Failed:
      return "failed";
  }
  return "";
}

// Says how it stands. A recording that failed or has gaps is a fault.
int report(const RecordingStatus& status, const std::string& json_file) {
  std::printf("%s", name_of(status.state));
  if (status.state != RecordingState::Off) {
    std::printf(": %s, %llu bytes in %s", result::counted(status.scans, "scan", "scans").c_str(),
                static_cast<unsigned long long>(status.bytes), status.file.c_str());
  }
  std::printf("\n");
  const bool failed = status.state == RecordingState::Failed;
  if (failed) std::fprintf(stderr, "%s\n", status.problem.c_str());
  if (status.gaps > 0) {
    std::fprintf(stderr, "R0056: the recording could not follow: %llu gaps, the first at scan %llu\n",
                 static_cast<unsigned long long>(status.gaps),
                 static_cast<unsigned long long>(status.first_gap));
  }
  const int finished = finish(json_file, {{"state", name_of(status.state)},
                                          {"file", status.file},
                                          {"scans", status.scans},
                                          {"bytes", status.bytes},
                                          {"gaps", status.gaps},
                                          {"problem", status.problem}});
  return finished != 0 ? finished : to_int(failed ? ExitCode::RuntimeFault : ExitCode::Done);
}

// False when a signal ended the wait.
bool wait_for(const process::StopSignal& stop, double seconds) {
  pollfd entry{stop.descriptor(), POLLIN, 0};
  const int timeout_ms = seconds > 0.0 ? static_cast<int>(seconds * 1e3) : -1;
  return poll(&entry, 1, timeout_ms) == 0;
}

// The runtime ended, or the recording failed, while it was waited for.
bool still_recording(Attached& runtime) {
  const auto status = recording(runtime);
  return status && status->state == RecordingState::Recording;
}

// In short waits, as the runtime may end meanwhile.
void wait_while_recording(Attached& runtime, const process::StopSignal& stop, double seconds) {
  constexpr double kSlice_s = 0.25;
  const auto begin = std::chrono::steady_clock::now();
  while (still_recording(runtime)) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    const double left = seconds > 0.0 ? seconds - passed.count() : kSlice_s;
    if (left <= 0.0 || !wait_for(stop, std::min(left, kSlice_s))) return;
  }
}

result::Result<void> begin_recording(Attached& runtime, service::BeginRecording request) {
  auto begun = runtime.ask(std::move(request));
  if (!begun) return result::forward(begun);
  return {};
}

}  // namespace

int record(const config::CellConfig& config, const RecordArguments& arguments) {
  const process::StopSignal stop(process::OnHangup::End);
  const auto role = arguments.status ? service::Role::Observer : service::Role::Controller;
  auto runtime = Attached::open(config, role);
  if (!runtime) return fail(runtime.error(), ExitCode::BadInput);
  if (!arguments.status && !arguments.stop) {
    service::BeginRecording request;
    request.file = std::filesystem::absolute(arguments.file).lexically_normal().string();
    request.max_bytes = arguments.max_mb * kMegabyte;
    request.hash_every = arguments.hash_every;
    request.keyframe_every = arguments.keyframe_every;
    auto begun = begin_recording(**runtime, std::move(request));
    if (!begun) return fail(begun.error(), ExitCode::BadInput);
    if (!arguments.detach) wait_while_recording(**runtime, stop, arguments.seconds);
  }
  const bool leave = arguments.status || arguments.detach;
  auto status = leave ? recording(**runtime) : end_recording(**runtime);
  if (!status) return fail(status.error(), ExitCode::RuntimeFault);
  return report(*status, arguments.json_file);
}

int trace_to_csv(const config::CellConfig& config, const TraceArguments& arguments) {
  const process::StopSignal stop(process::OnHangup::End);
  auto names = all_names(arguments.names, arguments.list_file);
  if (!names) return fail(names.error(), ExitCode::BadInput);
  if (names->empty()) {
    const auto none =
        result::fail("R0060", {}, "nothing to trace", "name variables, or a file of names with --list");
    return fail(none.value(), ExitCode::BadInput);
  }
  auto runtime = Attached::open(config, service::Role::Controller);
  if (!runtime) return fail(runtime.error(), ExitCode::BadInput);
  // Wrong names are told before anything is recorded.
  if (auto read = (*runtime)->read_program(); !read) return fail(read.error(), ExitCode::BadInput);
  auto variables = trace::resolve_names((*runtime)->program(), *names);
  if (!variables) return fail(variables.error(), ExitCode::BadInput);

  const std::filesystem::path file =
      std::filesystem::absolute(config.state_dir / ("trace-" + std::to_string(::getpid()) + ".swrec"));
  service::BeginRecording request;
  request.file = file.string();
  request.keyframe_every = 0;
  if (auto begun = begin_recording(**runtime, std::move(request)); !begun) {
    return fail(begun.error(), ExitCode::BadInput);
  }
  wait_while_recording(**runtime, stop, arguments.seconds);
  auto status = end_recording(**runtime);
  replay::RunOptions options;
  options.file = file.string();
  options.engine = host::EngineKind::Auto;
  options.trace = *names;
  options.csv_file = arguments.csv_file;
  auto replayed = replay::run(options);
  std::error_code ignored;  // a file of ours that stays is no reason to fail
  std::filesystem::remove(file, ignored);
  if (!status) return fail(status.error(), ExitCode::RuntimeFault);
  if (!replayed) return fail(replayed.error(), ExitCode::BadInput);
  const record::ReplayReport& report = replayed->report;
  std::printf("%s in %s\n", result::counted(replayed->rows, "scan", "scans").c_str(),
              arguments.csv_file.c_str());
  if (report.difference) {
    const auto differs = result::fail("R0055", {arguments.csv_file, 0, 0},
                                      "the values from scan " + std::to_string(report.difference->scan) +
                                          " on are not those of the runtime");
    return fail(differs.value(), ExitCode::RuntimeFault);
  }
  if (report.problems.empty()) return to_int(ExitCode::Done);
  return fail(report.problems, ExitCode::RuntimeFault);
}

}  // namespace stepwright::monitor
