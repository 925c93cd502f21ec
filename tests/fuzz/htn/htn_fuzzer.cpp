// libFuzzer over reader, search and validator of HDDL.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/htn/htn_run.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto run = stepwright::fuzz::htn::run({reinterpret_cast<const char*>(data), size});
  if (run.finding.empty()) return 0;
  std::fprintf(stderr, "%s\n", run.finding.c_str());
  std::abort();
}
