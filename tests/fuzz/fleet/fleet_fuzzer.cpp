// libFuzzer's entry: any bytes as a problem of a fleet and its map. A finding aborts.

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/fleet/fleet_run.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const stepwright::fuzz::fleet::Runner runner;
  const auto run = runner.run({reinterpret_cast<const char*>(data), size});
  if (run.finding.empty()) return 0;
  std::fprintf(stderr, "%s\n", run.finding.c_str());
  std::abort();
}
