// A supervisor to be killed: link_supervisor DOMAIN RUNTIME_ID STEPS. Downloads a program of STEPS steps,
// starts it with a barrier, acknowledges the first two events and then waits to be killed at the barrier of
// the third.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>

#include "runtime/dds/runtime_client.h"
#include "tests/support/step_program.h"

int main(int argc, char** argv) {
  using namespace stepwright;
  using namespace std::chrono_literals;
  if (argc != 4) return 2;
  const auto domain = static_cast<std::uint32_t>(std::atoi(argv[1]));
  auto client = dds::RuntimeClient::connect({domain, "victim", argv[2]}, dds::ClientRole::Supervisor);
  if (!client || !(*client)->wait_for_runtime(30s)) return 1;
  const auto steps = static_cast<std::uint32_t>(std::atoi(argv[3]));
  if (!(*client)->download(support::step_program({.steps = steps}))) return 1;
  if (!(*client)->start({.barrier = true})) return 1;
  for (int i = 0; i < 2; ++i) {
    const auto event = (*client)->wait_event(30s);
    if (!event || !(*client)->acknowledge(event->sequence)) return 1;
  }
  if (!(*client)->wait_event(30s)) return 1;
  std::puts("waiting");
  std::fflush(stdout);
  std::this_thread::sleep_for(1h);
  return 0;
}
