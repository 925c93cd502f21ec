#pragma once

// A RemoteRuntime on a controller in the same process, driven as the service would drive it.

#include <gtest/gtest.h>
#include <poll.h>

#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/host/host_runtime.h"
#include "runtime/image/no_io.h"
#include "runtime/remote/remote_runtime.h"
#include "runtime/service/digest.h"
#include "tests/support/board/faulty_line.h"
#include "tests/support/patience.h"
#include "tests/support/step_program.h"

namespace stepwright::remote {

using support::kPatience;

// Counts what is written, and gives as inputs what it is told.
class TestPlant final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t now_ns, std::span<std::byte> inputs) override {
    last_read_ns = now_ns;
    if (!inputs.empty()) inputs[0] = input;
    return lost ? image::IoStatus::Lost : image::IoStatus::Good;
  }
  image::IoStatus write_outputs(std::int64_t now_ns, std::span<const std::byte> outputs) override {
    last_write_ns = now_ns;
    if (!outputs.empty()) output = outputs[0];
    if (!outputs.empty()) last_output = outputs.back();
    return image::IoStatus::Good;
  }
  std::atomic<std::byte> input{std::byte{0}};
  std::atomic<std::byte> output{std::byte{0}};
  std::atomic<std::byte> last_output{std::byte{0}};
  std::atomic<bool> lost{false};
  std::atomic<std::int64_t> last_read_ns{0};
  std::atomic<std::int64_t> last_write_ns{0};
};

// Of any runtime: completions and events as they come.
class Driver {
 public:
  explicit Driver(host::RuntimePort& port) : port_(port) {}

  static std::string digest(const std::vector<std::byte>& container) {
    return service::to_hex(service::sha256(container));
  }
  host::Completion load(std::vector<std::byte> container) {
    const std::string name = digest(container);
    auto loading = port_.load(++ticket_, std::move(container), name);
    EXPECT_TRUE(loading) << (loading ? "" : result::to_string(loading.error()));
    return completion(ticket_);
  }
  host::Completion run(host::Command command) {
    command.ticket = ++ticket_;
    EXPECT_TRUE(port_.submit(command));
    return completion(ticket_);
  }
  host::Completion start(bool barrier = false) {
    host::Command command;
    command.kind = host::CommandKind::Start;
    command.barrier = barrier;
    return run(command);
  }
  host::Completion stop(const char* reason = "enough") {
    host::Command command;
    command.kind = host::CommandKind::Stop;
    command.text = host::FixedText<host::kMaxReasonBytes>(reason);
    return run(command);
  }
  host::Completion acknowledge(std::uint64_t event) {
    host::Command command;
    command.kind = host::CommandKind::Acknowledge;
    command.event = event;
    return run(command);
  }
  host::Completion bits(host::CommandKind kind, const host::ImageBits& bits) {
    host::Command command;
    command.kind = kind;
    command.bits = bits;
    command.program_digest = host::FixedText<host::kDigestLetters>(port_.status().program_digest);
    return run(command);
  }

  // The next event; fails the test after the patience.
  host::StepEvent event() {
    await([this] { return !events_.empty(); });
    if (events_.empty()) return {};
    host::StepEvent next = std::move(events_.front());
    events_.pop_front();
    return next;
  }
  bool await(const std::function<bool()>& condition) {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (true) {
      take();
      if (condition()) return true;
      if (std::chrono::steady_clock::now() > deadline) break;
      pollfd entry{port_.descriptor(), POLLIN, 0};
      poll(&entry, 1, 5);
    }
    ADD_FAILURE() << "it never came; the status says: " << port_.status().detail;
    return false;
  }
  host::RuntimePort& port() { return port_; }

 private:
  host::Completion completion(std::uint64_t ticket) {
    host::Completion found;
    await([&] {
      for (const host::Completion& each : completions_) {
        if (each.ticket == ticket) {
          found = each;
          return true;
        }
      }
      return false;
    });
    return found;
  }
  void take() {
    port_.clear();
    while (auto event = port_.take_event()) events_.push_back(std::move(*event));
    while (auto completion = port_.take_completion()) completions_.push_back(std::move(*completion));
  }

  host::RuntimePort& port_;
  std::uint64_t ticket_ = 0;
  std::deque<host::StepEvent> events_;
  std::vector<host::Completion> completions_;
};

inline RemoteConfig quick_config() {
  RemoteConfig config;
  config.lost_after = std::chrono::milliseconds(50);
  config.status_period = std::chrono::milliseconds(5);
  config.reconnect_period = std::chrono::milliseconds(5);
  return config;
}

// The whole thing.
struct Bench {
  explicit Bench(const RemoteConfig& config = quick_config(),
                 std::shared_ptr<support::BoardWorld> in = std::make_shared<support::BoardWorld>())
      : world(std::move(in)),
        runtime(std::move(
            *RemoteRuntime::create(config, std::make_unique<support::FaultyLine>(world), plant, nullptr))),
        driver(*runtime) {
    EXPECT_TRUE(runtime->wait_for_controller(kPatience)) << runtime->line_problem();
  }

  TestPlant plant;
  std::shared_ptr<support::BoardWorld> world;
  std::unique_ptr<RemoteRuntime> runtime;
  Driver driver;
};

}  // namespace stepwright::remote
