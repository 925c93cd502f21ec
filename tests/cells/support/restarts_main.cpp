// cells_restarts COUNT: starts and stops a program of one runtime COUNT times in simulated time, and every
// hundredth time the runtime itself. Prints resident memory (KiB), descriptors and threads after a tenth and
// at the end.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <thread>

#include "runtime/host/host_runtime.h"
#include "runtime/image/no_io.h"
#include "tests/support/patience.h"
#include "tests/support/step_program.h"

namespace {

using namespace stepwright;

constexpr int kPerRuntime = 100;

long entries(const char* folder) {
  return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
}

long resident_kib() {
  std::ifstream file("/proc/self/statm");
  long size = 0;
  long resident = 0;
  file >> size >> resident;
  return resident * 4;
}

void print_figures(const char* when) {
  std::printf("%s resident_kib %ld descriptors %ld threads %ld\n", when, resident_kib(),
              entries("/proc/self/fd"), entries("/proc/self/task"));
}

// Waits for the completion; events are taken on the way, as the service does.
bool perform(host::HostRuntime& runtime, std::uint64_t ticket) {
  const auto deadline = std::chrono::steady_clock::now() + support::kPatience;
  while (std::chrono::steady_clock::now() < deadline) {
    runtime.clear();
    while (runtime.take_event()) {
    }
    while (auto completion = runtime.take_completion()) {
      if (completion->ticket == ticket) return completion->outcome == host::Outcome::Done;
    }
    std::this_thread::yield();
  }
  return false;
}

bool give(host::HostRuntime& runtime, host::CommandKind kind, std::uint64_t ticket) {
  host::Command command;
  command.kind = kind;
  command.ticket = ticket;
  return runtime.submit(command) && perform(runtime, ticket);
}

bool one_runtime(int starts) {
  host::HostConfig config;
  config.speed = 1.0;
  image::NoIo io;
  auto runtime = host::HostRuntime::create(config, io, nullptr);
  if (!runtime) return false;
  std::uint64_t ticket = 0;
  if (!(*runtime)->load(++ticket, support::step_program({.interval_us = 100}), "0") ||
      !perform(**runtime, ticket)) {
    return false;
  }
  for (int i = 0; i < starts; ++i) {
    if (!give(**runtime, host::CommandKind::Start, ++ticket)) return false;
    if (!give(**runtime, host::CommandKind::Stop, ++ticket)) return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 1'000;
  for (int done = 0; done < count; done += kPerRuntime) {
    if (!one_runtime(kPerRuntime)) return std::fprintf(stderr, "failed after %d starts\n", done), 1;
    if (done == count / 10) print_figures("early");
  }
  print_figures("late");
  return 0;
}
