// libFuzzer's entry: any bytes as a container, with the header put right. A finding aborts.

#include <cstdint>
#include <cstdlib>
#include <vector>

#include "tests/fuzz/guarded_run.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto* const first = reinterpret_cast<const std::byte*>(data);
  std::vector<std::byte> bytes(first, first + size);
  stepwright::fuzz::repair_header(bytes);
  for (const auto side : {stepwright::fuzz::Side::Front, stepwright::fuzz::Side::Back}) {
    if (stepwright::fuzz::guarded_run(bytes, side) >= stepwright::fuzz::Outcome::BrokeOut) std::abort();
  }
  return 0;
}
