#include "cell/runtime/io_watch.h"

#include <system_error>
#include <utility>

#include "cell/device_status/lost_devices.h"
#include "runtime/ground/result/last_barrier.h"

namespace stepwright::cell_runtime {

IoWatch::IoWatch(const config::CellConfig& config, CellIo& io, host::HostRuntime& runtime, log::Logger& log)
    : config_(config), io_(io), runtime_(runtime), log_(log), restart_(config.safety.io.restart) {}

void IoWatch::event(const host::StepEvent& event) {
  switch (event.kind) {
    case host::EventKind::Trap:
      if (event.cause != scan::SafeCause::IoLost) return restart_.decided();
      lost_ = true;
      // A plan goes on where its supervisor says, and not at its first step.
      if (!supervised_) restart_.lost();
      return ask();
    case host::EventKind::Started:
    case host::EventKind::Stopped:
    case host::EventKind::Changed:
    case host::EventKind::RolledBack:
      return restart_.decided();
    case host::EventKind::StepChange:
      return;
  }
}

void IoWatch::supervisor(bool alive) {
  supervised_ = alive;
  if (alive) restart_.decided();
}

void IoWatch::turn(IoRestart::Clock::time_point now) {
  tell();
  tell_other();
  tell_plant();
  const bool alive = io_.alive();
  if (lost_ && alive) {
    lost_ = false;
    runtime_.set_note("io", "");
    log_.info("io_back", "the I/O is there again");
  }
  const bool waited = restart_.waits();
  if (waited && runtime_.status().state != host::RuntimeState::Fault) restart_.decided();
  if (restart_.due(alive, now)) return start();
  if (waited && restart_.exhausted()) {
    log_.error("restart", "the program is not started again: it lost its I/O " +
                              std::to_string(restart_.starts()) +
                              " times within an hour; a person has to look");
  }
}

// The sentence comes a moment later: the client may be busy, or gone.
void IoWatch::ask() {
  if (!config_.safety.io.modbus || asks_.exchange(true)) return;
  try {
    asking_ = std::jthread([this, socket = config_.modbus_client_path()] {
      std::string lost;
      static_cast<void>(result::thrown_by([&] { lost = device_status::ask_lost(socket); }));
      const std::scoped_lock lock(mutex_);
      answer_ = std::move(lost);
      asks_ = false;
    });
  } catch (const std::system_error& error) {
    asks_ = false;
    log_.warning("lost_devices", std::string("the Modbus client was not asked: no thread: ") + error.what());
  }
}

void IoWatch::tell() {
  std::optional<std::string> answer;
  {
    const std::scoped_lock lock(mutex_);
    answer = std::exchange(answer_, std::nullopt);
  }
  if (!answer || answer->empty()) return;
  log_.error("lost_devices", *answer, {{"devices", *answer}});
  if (lost_) runtime_.set_note("io", *answer);
}

void IoWatch::tell_other() {
  const auto found = io_.other_runtime();
  const std::uint32_t other = found ? found->pid : 0;
  if (std::exchange(other_, other) == other) return;
  if (!found) {
    runtime_.set_note("io", "");
    log_.info("other_runtime", "no other runtime drives the outputs any more");
    return;
  }
  const std::string sentence =
      "another runtime (process " + std::to_string(other) + ") drives these outputs: this one does not";
  log_.error("other_runtime", sentence + "; two cells of one name share an I/O area", {{"process", other}});
  runtime_.set_note("io", sentence);
}

// A plant that is lost stays lost until the runtime is started again.
void IoWatch::tell_plant() {
  if (plant_told_) return;
  const std::string trouble = io_.trouble();
  if (trouble.empty()) return;
  plant_told_ = true;
  log_.error("lost_plant", trouble);
  runtime_.set_note("io", trouble);
}

void IoWatch::start() {
  host::Command start;
  start.kind = host::CommandKind::Start;
  start.regardless = true;  // I/O that is gone again is lost I/O, and counted
  if (!runtime_.submit(start)) return;
  log_.warning("restart", "the I/O has been there for " +
                              std::to_string(config_.safety.io.restart.after.count()) +
                              " ms: the program is started again (" + std::to_string(restart_.starts()) +
                              " of " + std::to_string(config_.safety.io.restart.limit) + " within an hour)");
}

}  // namespace stepwright::cell_runtime
