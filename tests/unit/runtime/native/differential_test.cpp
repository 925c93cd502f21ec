#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>

#include "tests/unit/runtime/native/engine_pair.h"
#include "tests/unit/runtime/native/random_program.h"

namespace stepwright::native {
namespace {

constexpr std::uint32_t kPrograms = 3000;
constexpr int kScans = 4;

// STEPWRIGHT_FUZZ_PROGRAMS and STEPWRIGHT_FUZZ_SEED ask for a longer run, or for one program again.
std::uint32_t from_environment(const char* name, std::uint32_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10));
}

void write_inputs(EnginePair& pair, std::mt19937& random) {
  for (std::size_t i = 0; i < 8; ++i) pair.write(i, static_cast<std::uint8_t>(random()));
}

TEST(NativeEngine_Differential, RandomPrograms_WhenRunInBothEngines_ThenImageTrapAndBudgetAreEqual) {
  const std::uint32_t first = from_environment("STEPWRIGHT_FUZZ_SEED", 1);
  const std::uint32_t count = from_environment("STEPWRIGHT_FUZZ_PROGRAMS", kPrograms);
  std::uint32_t trapped = 0;
  for (std::uint32_t seed = first; seed - first < count; ++seed) {
    EnginePair pair(random_program(seed));
    std::mt19937 random(seed);
    for (int scan = 0; scan < kScans; ++scan) {
      write_inputs(pair, random);
      const std::uint64_t budget = random() % 4 == 0 ? random() % 3000 : 60'000;
      const auto tasks = pair.loaded().program().container().count<bytecode::Section::Tasks>();
      const std::string difference =
          pair.run(scan * 10'000'000LL, budget, static_cast<std::uint32_t>(scan) % tasks);
      ASSERT_EQ(difference, "") << "seed " << seed << ", scan " << scan;
      if (pair.trap()) ++trapped;
    }
  }
  // Traps must occur, and must not be all that occurs.
  if (count >= 100) {
    EXPECT_GT(trapped, count / 20);
    EXPECT_LT(trapped, count * kScans * 3 / 4);
  }
}

}  // namespace
}  // namespace stepwright::native
