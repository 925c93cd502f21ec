// libFuzzer's entry: any bytes as a message of every topic. A finding aborts.

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/vda5050/message_run.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto run = stepwright::fuzz::vda5050::run({reinterpret_cast<const char*>(data), size});
  if (run.finding.empty()) return 0;
  std::fprintf(stderr, "%s\n", run.finding.c_str());
  std::abort();
}
