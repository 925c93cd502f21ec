// Problems of a fleet, maps and scheduling problems, and thousands of mutations of them through the readers.
//
// STEPWRIGHT_FUZZ_CORPUS, if set, names a folder that gets the seeds, for fuzz_fleet. Longer:
// STEPWRIGHT_FUZZ_SEED=7 STEPWRIGHT_FUZZ_ROUNDS=50000 fuzz_fleet_mutation.

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <span>

#include "tests/fuzz/corpus.h"
#include "tests/fuzz/fault_case.h"
#include "tests/fuzz/fleet/fleet_run.h"
#include "tests/fuzz/fleet/mutation.h"

namespace stepwright::fuzz::fleet {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kRoundsPerSeed = 300;

std::vector<std::string> seeds() {
  return contents(fs::path(STEPWRIGHT_SOURCE_DIR) / "tests/fuzz/fleet/seeds");
}

TEST(FleetMutation, Seeds_WhenRead_ThenEveryOneIsAProblem) {
  const Runner runner;
  for (const std::string& seed : seeds()) {
    const fleet::Run done = runner.run(seed);
    EXPECT_TRUE(done.read) << seed;
    EXPECT_EQ(done.finding, "") << seed;
  }
}

TEST(FleetMutation, Texts_WhenBroken_ThenAreRefusedWithAPlaceOrReadWhole) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(setting("STEPWRIGHT_FUZZ_SEED", 20261123)));
  const std::uint64_t rounds = setting("STEPWRIGHT_FUZZ_ROUNDS", kRoundsPerSeed);
  const std::vector<std::string> all = seeds();
  const Runner runner;
  std::size_t runs = 0, read = 0, mapped = 0;
  for (std::size_t s = 0; s < all.size(); ++s) {
    for (std::uint64_t round = 0; round < rounds; ++round) {
      const std::string text = mutated(all[s], all, random);
      name_case("fleet seed " + std::to_string(s) + ", round " + std::to_string(round),
                std::as_bytes(std::span(text)));
      const fleet::Run done = runner.run(text);
      ++runs;
      read += done.read ? 1 : 0;
      mapped += done.mapped ? 1 : 0;
      if (done.finding.empty()) continue;
      ADD_FAILURE() << "seed " << s << ", round " << round << ": " << done.finding << ", in " << keep_case();
      return;
    }
  }
  std::cout << runs << " runs, " << read << " read, " << mapped << " maps\n";
  // Else the mutations do not get beyond the syntax.
  EXPECT_GT(read, runs / 50);
  EXPECT_GT(mapped, runs / 10);
}

// Where libFuzzer is to find them: STEPWRIGHT_FUZZ_CORPUS.
TEST(FleetMutation, Seeds_WhenWrittenAsACorpus_ThenEachIsAFile) {
  expect_corpus_written(seeds());
}

}  // namespace
}  // namespace stepwright::fuzz::fleet
