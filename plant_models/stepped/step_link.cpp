#include "plant_models/stepped/step_link.h"

#include <signal.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <thread>
#include <utility>

namespace stepwright::stepped {
namespace {

using Clock = std::chrono::steady_clock;

std::string how(const process::ExitStatus& status) {
  if (!status.killed) return "its process ended with exit code " + std::to_string(status.code);
  const int number = status.code - 128;
  const char* const name = sigdescr_np(number);
  return "its process was killed by signal " + std::to_string(number) +
         (name != nullptr ? std::string(" (") + name + ")" : std::string());
}

// Ends a process that has closed its socket: it is about to end by itself, or never will. How it has; in the
// second case its status is of no meaning.
std::string how_it_ended(process::ChildProcess& process) {
  constexpr std::chrono::milliseconds kByItself{1'000};
  const auto deadline = Clock::now() + kByItself;
  while (!process.poll() && Clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  if (const auto status = process.poll()) return how(*status);
  process.end(std::chrono::milliseconds(200));
  return "it has closed its socket; its process was ended";
}

void limit_receive(int socket, std::chrono::milliseconds patience) {
  const timeval limit{patience.count() / 1000, patience.count() % 1000 * 1000};
  setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
}

}  // namespace

std::string find_program(const std::string& name, const std::filesystem::path& folder) {
  const auto usable = [](const std::filesystem::path& path) { return access(path.c_str(), X_OK) == 0; };
  if (name.find('/') != std::string::npos) {
    const std::filesystem::path path = std::filesystem::absolute(folder / name);
    return usable(path) ? path.string() : std::string();
  }
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin");
  for (std::string each; std::getline(folders, each, ':');) {
    if (!each.empty() && usable(std::filesystem::path(each) / name))
      return (std::filesystem::path(each) / name).string();
  }
  return {};
}

StepLink::StepLink(StepArea area, int socket, const StepCommand& command)
    : area_(std::move(area)), socket_(socket), command_(command) {}

StepLink::~StepLink() {
  if (socket_ >= 0) close(socket_);  // the plant reads the end there, and ends
  if (process_) process_->end(std::chrono::milliseconds(500));
}

result::Result<std::unique_ptr<StepLink>> StepLink::start(const StepNames& names, std::uint64_t seed,
                                                          const StepCommand& command) {
  auto area = StepArea::make(names, seed);
  if (!area) return result::forward(area);
  const std::size_t known = std::min(command.first_actuators.size(), area->actuators());
  for (std::size_t i = 0; i < known; ++i) area->set_actuator(i, command.first_actuators[i]);
  const std::string program =
      command.arguments.empty() ? std::string() : find_program(command.arguments.front(), command.folder);
  if (program.empty()) {
    return result::fail("R0153", command.where,
                        "the plant's program '" +
                            (command.arguments.empty() ? std::string() : command.arguments.front()) +
                            "' is not there, or may not be executed",
                        "a name is looked for in PATH, a path from the folder of the cell");
  }
  std::array<int, 2> sockets{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0)
    return result::fail("R0151", {}, std::string("no socket for the plant: ") + std::strerror(errno));
  std::unique_ptr<StepLink> link(new StepLink(std::move(*area), sockets[0], command));
  process::ChildOptions options;
  options.arguments = command.arguments;
  options.arguments.front() = program;
  options.folder = command.folder;
  options.log = command.log;
  options.descriptors = {sockets[1], link->area_.descriptor()};
  options.with_descendants = true;
  auto process = process::ChildProcess::start(options);
  close(sockets[1]);
  if (!process) return result::forward(process);
  link->process_ = std::move(*process);
  if (auto ready = link->wait_until_ready(); !ready) return result::forward(ready);
  limit_receive(link->socket_, command.patience);
  return link;
}

result::Result<void> StepLink::wait_until_ready() {
  limit_receive(socket_, command_.beginning);
  const LinkFailure why = answer(command_.beginning);
  const std::uint32_t version = area_.header().peer_version.load(std::memory_order_acquire);
  if (const std::string message = area_.message(); why != LinkFailure::Silent && !message.empty()) {
    return result::fail("R0155", command_.where, "the plant cannot run: " + message);
  }
  if (why == LinkFailure::Silent) {
    return result::fail(
        "R0153", command_.where,
        "the plant was not ready within " + std::to_string(command_.beginning.count()) + " ms",
        "it writes its version and one byte into descriptor 3 (plant_models/doc/"
        "shared_plant.md); start_timeout_ms gives it more time");
  }
  if (why != LinkFailure::None) {
    return result::fail(
        "R0153", command_.where, "the plant was not ready: " + how_it_ended(*process_),
        command_.log.empty() ? "what it has printed stands in the output of the runtime" : "");
  }
  if (version != kStepVersion) {
    return result::fail("R0154", command_.where,
                        "the plant speaks version " + std::to_string(version) +
                            " of the step protocol, this runtime version " + std::to_string(kStepVersion),
                        "the plant writes its version at offset 128 of the area before it is ready");
  }
  return {};
}

LinkFailure StepLink::answer(std::chrono::milliseconds patience) {
  const auto deadline = Clock::now() + patience;
  for (;;) {
    char byte = 0;
    const ssize_t got = recv(socket_, &byte, 1, 0);
    if (got == 1) return LinkFailure::None;
    if (got == 0 || (errno != EINTR && errno != EAGAIN)) return LinkFailure::Ended;
    if (errno == EAGAIN || Clock::now() >= deadline) return LinkFailure::Silent;
  }
}

bool StepLink::ask(std::int64_t time_ns, std::int64_t step_ns) {
  if (failure_.load(std::memory_order_relaxed) != LinkFailure::None) return false;
  StepHeader& header = area_.header();
  header.time_ns.store(time_ns, std::memory_order_relaxed);
  header.step_ns.store(step_ns, std::memory_order_relaxed);
  header.step.store(++steps_, std::memory_order_release);
  failed_at_ns_.store(time_ns, std::memory_order_relaxed);
  if (send(socket_, &kStepByte, 1, MSG_NOSIGNAL | MSG_DONTWAIT) != 1) return fail(LinkFailure::Ended);
  return true;
}

bool StepLink::finish() {
  if (failure_.load(std::memory_order_relaxed) != LinkFailure::None) return false;
  const StepHeader& header = area_.header();
  if (const LinkFailure why = answer(command_.patience); why != LinkFailure::None) return fail(why);
  if (header.status.load(std::memory_order_acquire) != static_cast<std::uint32_t>(PeerStatus::Good))
    return fail(LinkFailure::Told);
  if (header.done.load(std::memory_order_acquire) != steps_) return fail(LinkFailure::Unfinished);
  return true;
}

void StepLink::refuse_number(std::string_view name) {
  if (failure_.load(std::memory_order_relaxed) != LinkFailure::None) return;
  std::memcpy(number_, name.data(), std::min(name.size(), sizeof number_ - 1));
  fail(LinkFailure::NoNumber);
}

bool StepLink::fail(LinkFailure why) {
  failure_.store(why, std::memory_order_release);
  return false;
}

std::string StepLink::trouble() {
  // One that ends while nobody steps it is noticed here.
  if (!failed() && process_->poll()) {
    LinkFailure none = LinkFailure::None;
    failure_.compare_exchange_strong(none, LinkFailure::Ended, std::memory_order_acq_rel);
  }
  const LinkFailure why = failure_.load(std::memory_order_acquire);
  if (why == LinkFailure::None) return {};
  if (end_.empty()) end_ = end_process(why);
  char at[64];
  std::snprintf(at, sizeof at, "the plant is lost at %.3f s: ",
                static_cast<double>(failed_at_ns_.load(std::memory_order_relaxed)) * 1e-9);
  switch (why) {
    case LinkFailure::Silent:
      return at + ("no answer to a step within " + std::to_string(command_.patience.count()) +
                   " ms; its process was killed");
    case LinkFailure::Unfinished:
      return at + std::string("it answered before its step was done (offset 136 of the area)");
    case LinkFailure::Told:
      return at + (area_.message().empty() ? std::string("it says that it has failed") : area_.message());
    case LinkFailure::NoNumber:
      return at + std::string("'") + number_ + "' is no finite number";
    case LinkFailure::Ended:
    case LinkFailure::None:
      break;
  }
  return at + end_;
}

std::string StepLink::end_process(LinkFailure why) {
  if (why != LinkFailure::Ended) process_->kill_now();
  return how_it_ended(*process_);
}

}  // namespace stepwright::stepped
