// The plant of the interop tests: it holds the inputs that every slave of these tests has (peer_server.py),
// until a signal ends it. modbus_interop_plant NAME BYTES

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>
#include <vector>

#include "runtime/io_memory/plant_side.h"

namespace {

constexpr std::int64_t kTimeoutNs = 2'000'000'000;
constexpr std::chrono::milliseconds kBeat{20};
constexpr std::size_t kDiscreteBytes = 4;  // the first two words of the inputs are bits

std::vector<std::byte> inputs_of(std::size_t bytes) {
  std::vector<std::byte> out(bytes);
  for (std::size_t i = 0; i < kDiscreteBytes * 8; i += 3) out[i / 8] |= std::byte{1} << (i % 8);
  for (std::size_t i = kDiscreteBytes / 2; i < bytes / 2; ++i) {
    const std::size_t value = 3 * i + 7;
    out[2 * i] = static_cast<std::byte>(value);  // the image is little-endian
    out[2 * i + 1] = static_cast<std::byte>(value >> 8);
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto bytes = static_cast<std::uint32_t>(std::atoi(argv[2]));
  auto plant = stepwright::io_memory::PlantSide::open(argv[1], bytes, bytes);
  if (!plant) {
    std::cerr << stepwright::result::to_string(plant.error()) << '\n';
    return 1;
  }
  (*plant)->write_inputs(inputs_of(bytes));
  (*plant)->announce(kTimeoutNs);
  std::cout << "ready" << std::endl;
  while (true) {
    (*plant)->beat();
    std::this_thread::sleep_for(kBeat);
  }
}
