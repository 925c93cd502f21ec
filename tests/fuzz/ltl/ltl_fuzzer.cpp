// libFuzzer's entry: any bytes as a formula, or as an automaton if they begin with HOA. A finding aborts.

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/ltl/ltl_run.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto run = stepwright::fuzz::ltl::run({reinterpret_cast<const char*>(data), size});
  if (run.finding.empty()) return 0;
  std::fprintf(stderr, "%s\n", run.finding.c_str());
  std::abort();
}
