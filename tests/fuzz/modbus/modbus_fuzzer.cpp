// libFuzzer's entry: any bytes as a TCP stream, or as what comes over a serial line (STEPWRIGHT_FUZZ_RTU). A
// finding aborts.

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/modbus/slave_run.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace fuzz = stepwright::fuzz;
  const std::span<const std::uint8_t> bytes(data, size);
#ifdef STEPWRIGHT_FUZZ_RTU
  const fuzz::modbus::Run run = fuzz::modbus::run_rtu(bytes, fuzz::Side::Back);
#else
  const fuzz::modbus::Run run =
      fuzz::modbus::run_tcp(bytes, static_cast<std::uint32_t>(size), fuzz::Side::Back);
#endif
  if (run.finding.empty()) return 0;
  std::fprintf(stderr, "%s\n", run.finding.c_str());
  std::abort();
}
