// cells_attend DOMAIN INTERFACE INTERVAL_US RUNTIME_ID...: a supervisor of several runtimes over Fast DDS.
// Downloads a program with one task of that interval to each and starts it (0: leaves them what they run),
// and then says line by line what it sees, with the time of the monotonic clock in seconds:
//   found ID TIME | running ID SCAN TIME | gone ID TIME | back ID TIME
// until its standard input ends.

#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "runtime/dds/runtime_client.h"
#include "tests/support/step_program.h"

namespace {

using namespace stepwright;

struct Attended {
  std::string id;
  std::unique_ptr<dds::RuntimeClient> client;
  bool alive = false;
  std::uint64_t told_scan = 0;
};

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void say(const char* what, const std::string& id) {
  std::printf("%s %s %.6f\n", what, id.c_str(), now_s());
  std::fflush(stdout);
}

template <typename T>
bool failed(const char* what, const result::Result<T>& outcome) {
  if (outcome) return false;
  std::fprintf(stderr, "%s: %s\n", what, result::to_string(outcome.error()).c_str());
  return true;
}

void look(Attended& each) {
  const bool alive = each.client->runtime_alive();
  if (alive != each.alive) say(alive ? "back" : "gone", each.id);
  each.alive = alive;
  const auto status = each.client->status();
  if (!alive || !status || status->state != host::RuntimeState::Running) return;
  if (status->scan < each.told_scan + 50 && status->scan >= each.told_scan) return;
  each.told_scan = status->scan;
  std::printf("running %s %llu %.6f\n", each.id.c_str(), static_cast<unsigned long long>(status->scan),
              now_s());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) return 2;
  const auto interval_us = static_cast<std::uint32_t>(std::atoi(argv[3]));
  const auto domain = static_cast<std::uint32_t>(std::atoi(argv[1]));
  std::vector<Attended> all;
  for (int i = 4; i < argc; ++i) {
    auto client =
        dds::RuntimeClient::connect({domain, "attend", argv[i], {argv[2]}}, dds::ClientRole::Supervisor);
    if (failed("connect", client)) return 1;
    all.push_back({argv[i], std::move(*client)});
  }
  for (Attended& each : all) {
    if (!each.client->wait_for_runtime(std::chrono::seconds(30))) {
      return std::fprintf(stderr, "no runtime %s\n", each.id.c_str()), 1;
    }
    each.alive = true;
    say("found", each.id);
    if (interval_us == 0) continue;
    const auto program = support::step_program({.steps = 2, .interval_us = interval_us});
    if (failed("download", each.client->download(program))) return 1;
    if (failed("start", each.client->start({.barrier = false}))) return 1;
  }
  pollfd input{STDIN_FILENO, POLLIN, 0};
  while (poll(&input, 1, 5) == 0) {
    for (Attended& each : all) look(each);
  }
  return 0;
}
