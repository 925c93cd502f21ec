// How long a supervisor's answer takes: from the arrival of a step event over its acknowledgement to the
// arrival of the next one (one scan later), over the service's socket alone and over service, link and Fast
// DDS; beside them, as the baseline, bare messages of the same size back and forth on a Unix socket pair
// between two threads.
//
//   bench_link [--rounds N] [--json FILE]

#include <sys/socket.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "runtime/dds/runtime_client.h"
#include "runtime/service/codec.h"
#include "runtime/service/connection.h"
#include "tests/support/step_program.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_process.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

struct Latency {
  double p50_us = 0.0;
  double p99_us = 0.0;
};

Latency percentiles(std::vector<double> samples_us) {
  std::sort(samples_us.begin(), samples_us.end());
  const auto at = [&](double part) {
    return samples_us[static_cast<std::size_t>(part * double(samples_us.size() - 1))];
  };
  return {at(0.5), at(0.99)};
}

// The time of each of `rounds` calls; the first tenth warms up.
Latency measure(int rounds, const std::function<void()>& round) {
  std::vector<double> samples_us;
  for (int i = -rounds / 10; i < rounds; ++i) {
    const auto begin = Clock::now();
    round();
    const std::chrono::duration<double, std::micro> taken = Clock::now() - begin;
    if (i >= 0) samples_us.push_back(taken.count());
  }
  return percentiles(std::move(samples_us));
}

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "bench_link: %s\n", why.c_str());
  std::exit(5);
}

bool send_all(int fd, std::vector<std::byte>& bytes) {
  return ::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
}
bool receive_all(int fd, std::vector<std::byte>& bytes) {
  return ::recv(fd, bytes.data(), bytes.size(), MSG_WAITALL) == static_cast<ssize_t>(bytes.size());
}

// An acknowledgement one way, an event the other.
Latency bare_sockets(int rounds, std::size_t event_bytes) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) give_up("no socket pair");
  std::vector<std::byte> acknowledgement;
  if (!service::encode_frame(service::Request{1, 1, service::Acknowledge{1}}, acknowledgement))
    give_up("no frame");
  std::thread peer(
      [fd = ends[1], asked = acknowledgement, event = std::vector<std::byte>(event_bytes)]() mutable {
        while (receive_all(fd, asked) && send_all(fd, event)) {
        }
      });
  std::vector<std::byte> event(event_bytes);
  const Latency latency = measure(rounds, [&] {
    if (!send_all(ends[0], acknowledgement) || !receive_all(ends[0], event)) give_up("the socket pair broke");
  });
  ::close(ends[0]);
  peer.join();
  ::close(ends[1]);
  return latency;
}

// One scan per step, and a barrier at each.
std::vector<std::byte> program_of(int rounds) {
  return support::step_program(
      {.steps = static_cast<std::uint32_t>(rounds + rounds / 10 + 10), .scans_per_step = 1});
}

Latency over_service(int rounds, const std::filesystem::path& socket, std::size_t& event_bytes) {
  auto connection = service::Connection::open(socket, {service::Role::Controller, "bench", 0});
  if (!connection) give_up(result::to_string(connection.error()));
  if (!(*connection)->download(program_of(rounds), 10s)) give_up("the download failed");
  if (!(*connection)->call(service::Start{true}, 10s)) give_up("the start failed");
  std::uint64_t last = 0;
  const auto next_event = [&] {
    while (auto message = (*connection)->receive(10s)) {
      const auto* event = std::get_if<host::StepEvent>(&*message);
      if (event == nullptr) continue;
      last = event->sequence;
      std::vector<std::byte> frame;
      if (event_bytes == 0 && service::encode_frame(*event, frame)) event_bytes = frame.size();
      return;
    }
    give_up("no event came");
  };
  next_event();
  next_event();
  std::uint64_t id = 1'000'000;
  return measure(rounds, [&] {
    (*connection)->send(service::Request{1, ++id, service::Acknowledge{last}});
    next_event();
  });
}

Latency over_link(int rounds, std::uint32_t domain, const std::string& runtime_id) {
  auto client = dds::RuntimeClient::connect({domain, "bench", runtime_id}, dds::ClientRole::Supervisor);
  if (!client || !(*client)->wait_for_runtime(10s)) give_up("no runtime on Fast DDS");
  if (!(*client)->download(program_of(rounds))) give_up("the download failed");
  if (!(*client)->start({.barrier = true})) give_up("the start failed");
  std::uint64_t last = 0;
  const auto next_event = [&] {
    do {
      const auto event = (*client)->wait_event(10s);
      if (!event) give_up("no event came");
      last = event->sequence;
      if (event->kind == host::EventKind::StepChange) return;
    } while (true);
  };
  next_event();
  return measure(rounds, [&] {
    if (!(*client)->acknowledge(last)) give_up("no acknowledgement");
    next_event();
  });
}

int run(int rounds, const std::string& json_file) {
  const support::TemporaryFolder folder;
  const std::filesystem::path& path = folder.path();
  const std::string name = "bench-" + std::to_string(::getpid());
  const auto domain = static_cast<std::uint32_t>(20 + ::getpid() % 80);
  std::ofstream(path / "cell.toml") << "[cell]\nname = \"" << name
                                    << "\"\nstate_dir = \".\"\n[plant]\nkind = \"none\"\n"
                                    << "[dds]\ndomain_id = " << domain << "\n";
  const auto start = [&](const char* command) {
    return support::TestProcess(
        {STEPWRIGHT_BIN_DIR "/stepwright", command, "--config", (path / "cell.toml").string()},
        path / (std::string(command) + ".log"));
  };
  const auto runtime = start("runtime");
  if (!runtime.wait_for("listens on")) give_up(runtime.output());
  const auto link = start("link");
  if (!link.wait_for("connected")) give_up(link.output());

  std::size_t event_bytes = 0;
  const Latency service = over_service(rounds, path / "runtime.sock", event_bytes);
  const Latency bare = bare_sockets(rounds, event_bytes);
  const Latency full = over_link(rounds, domain, name);

  std::printf("event -> acknowledgement -> next event, %d rounds, event of %zu bytes\n", rounds, event_bytes);
  std::printf("  %-34s %10s %10s %8s\n", "", "p50 us", "p99 us", "ratio");
  nlohmann::json report = {{"rounds", rounds}, {"event_bytes", event_bytes}};
  const auto print = [&](const char* what, const char* key, const Latency& latency) {
    std::printf("  %-34s %10.1f %10.1f %8.1f\n", what, latency.p50_us, latency.p99_us,
                latency.p50_us / bare.p50_us);
    report[std::string(key) + "_p50_us"] = latency.p50_us;
    report[std::string(key) + "_p99_us"] = latency.p99_us;
  };
  print("bare Unix socket, no scan", "bare", bare);
  print("service", "service", service);
  print("service + link + Fast DDS", "link", full);
  if (!json_file.empty()) std::ofstream(json_file) << report.dump(2) << "\n";
  return 0;
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  CLI::App app("The round trip from a step event to the next, over each layer", "bench_link");
  int rounds = 2'000;
  std::string json_file;
  app.add_option("--rounds", rounds, "measured round trips per layer")->check(CLI::Range(100, 100'000));
  app.add_option("--json", json_file, "write the figures there");
  CLI11_PARSE(app, argc, argv);
  return stepwright::bench::run(rounds, json_file);
}
