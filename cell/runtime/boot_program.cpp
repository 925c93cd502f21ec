#include "cell/runtime/boot_program.h"

#include <poll.h>

#include <chrono>
#include <new>
#include <system_error>
#include <utility>

#include "runtime/ground/files/durable_file.h"
#include "runtime/host/busy.h"
#include "runtime/host/limits.h"
#include "runtime/service/digest.h"

namespace stepwright::cell_runtime {
namespace {

// A large program takes seconds to be prepared; this is for a machine in trouble.
constexpr int kAnswerWithinMs = 120'000;
constexpr files::Owner kProgramFile{"R0024"};
// A disk that had no room may have some by then.
constexpr std::chrono::seconds kTryAgain{5};

result::Diagnostics not_kept(const std::string& why) {
  return {{"R0027",
           result::Severity::Warning,
           {},
           "the program is not kept for the next start: " + why,
           "it is tried again; until it is kept, a power cut brings back the program before"}};
}

}  // namespace

result::Result<std::optional<FoundProgram>> find_boot_program(const config::BootSection& config) {
  for (const std::filesystem::path& each : {config.keep, config.program}) {
    if (each.empty()) continue;
    auto content = files::read_bytes(each, host::kMaxContainerBytes, kProgramFile);
    if (!content) return result::forward(content);
    if (*content) return FoundProgram{each, std::move(**content)};
  }
  if (config.program.empty()) return std::nullopt;
  return result::fail("R0026", {config.program.string(), 0, 0}, "there is no such program",
                      config.sources.empty() ? "[runtime] program of the cell's configuration names it"
                                             : "`stepwright up` compiles it from [runtime] sources");
}

BootProgram::BootProgram(config::BootSection config, host::HostRuntime& runtime, Refusal refusal)
    : config_(std::move(config)), runtime_(runtime), refusal_(std::move(refusal)) {
  if (config_.keep.empty()) return;
  try {
    thread_ = std::thread([this] { keep_on(); });
  } catch (const std::system_error& error) {
    runtime_.set_note("program",
                      std::string("programs are not kept for the next start: no thread: ") + error.what());
    config_.keep.clear();
  }
}

BootProgram::~BootProgram() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  news_.notify_one();
  thread_.join();
}

void BootProgram::keep(std::span<const std::byte> container) {
  // What was loaded at the start was not downloaded.
  const std::string digest = service::to_hex(service::sha256(container));
  if (std::exchange(booted_, {}) == digest) {
    booted_ = digest;
    return;
  }
  const std::lock_guard lock(mutex_);
  try {
    next_.emplace(container.begin(), container.end());
    outcome_.reset();
  } catch (const std::bad_alloc&) {
    next_.reset();
    return decide(not_kept("there is no memory for it"));
  }
  news_.notify_one();
}

std::optional<result::Diagnostics> BootProgram::outcome() {
  decided_.clear();
  const std::lock_guard lock(mutex_);
  return outcome_;
}

// The mutex is held.
void BootProgram::decide(std::optional<result::Diagnostics> outcome) {
  outcome_ = std::move(outcome);
  runtime_.set_note("program", outcome_->empty() ? std::string() : outcome_->front().message);
  decided_.notify();
}

// What could not be kept is tried again until it is, or until another program comes.
void BootProgram::keep_on() {
  std::unique_lock lock(mutex_);
  std::optional<std::vector<std::byte>> unkept;
  while (true) {
    const auto something = [this] { return quit_ || next_; };
    if (unkept) {
      news_.wait_for(lock, kTryAgain, something);
    } else {
      news_.wait(lock, something);
    }
    if (quit_ && !next_) return;
    if (next_) unkept = std::exchange(next_, std::nullopt);
    lock.unlock();
    const auto kept = files::replace_file(config_.keep, *unkept, kProgramFile);
    lock.lock();
    if (next_) continue;  // a newer one decides
    decide(kept ? result::Diagnostics{} : not_kept(result::to_string(kept.error())));
    if (kept) unkept.reset();
  }
}

result::Diagnostics BootProgram::run() {
  auto done = load_and_start();
  if (done) return {};
  runtime_.set_note("program", result::to_string(done.error()));
  return std::move(done.error());
}

result::Result<void> BootProgram::load_and_start() {
  auto found = find_boot_program(config_);
  if (!found) return result::forward(found);
  if (!*found) return {};
  const std::filesystem::path file = (*found)->file;
  if (auto refused = refusal_ ? refusal_((*found)->container) : result::Diagnostics{}; !refused.empty()) {
    for (result::Diagnostic& each : refused) each.message += " (" + file.string() + ")";
    return tl::unexpected(std::move(refused));
  }
  std::string digest = service::to_hex(service::sha256((*found)->container));
  auto loaded = runtime_.load(0, std::move((*found)->container), digest);
  if (loaded) loaded = complete(1);
  if (!loaded) {
    // It was no download.
    for (result::Diagnostic& each : loaded.error()) each.where.file = file.string();
    return loaded;
  }
  booted_ = std::move(digest);
  if (!config_.autostart) return {};
  host::Command start;
  start.kind = host::CommandKind::Start;
  start.regardless = true;  // devices that are not there are a fault, as if they were lost later
  if (!runtime_.submit(start)) return host::busy();
  return complete(1);
}

// Waits for the commands that are under way.
result::Result<void> BootProgram::complete(int commands) {
  result::Diagnostics problems;
  while (commands > 0) {
    if (auto completion = runtime_.take_completion()) {
      problems.insert(problems.end(), completion->problems.begin(), completion->problems.end());
      --commands;
      continue;
    }
    pollfd entry{runtime_.descriptor(), POLLIN, 0};
    if (poll(&entry, 1, kAnswerWithinMs) == 0)
      return result::fail(host::kBusy, {}, "the runtime does not answer");
    runtime_.clear();
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return {};
}

}  // namespace stepwright::cell_runtime
