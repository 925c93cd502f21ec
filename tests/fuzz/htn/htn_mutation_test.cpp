// HDDL texts and thousands of mutations of them through reader, search and validator.
//
// STEPWRIGHT_FUZZ_CORPUS, if set, names a folder that gets the seeds, for fuzz_htn. Longer:
// STEPWRIGHT_FUZZ_SEED=7 STEPWRIGHT_FUZZ_ROUNDS=50000 fuzz_htn_mutation.

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <span>

#include "tests/fuzz/corpus.h"
#include "tests/fuzz/fault_case.h"
#include "tests/fuzz/htn/htn_run.h"
#include "tests/fuzz/pddl/mutation.h"

namespace stepwright::fuzz::htn {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kRoundsPerSeed = 700;

std::vector<std::string> seeds() {
  const fs::path source(STEPWRIGHT_SOURCE_DIR);
  std::vector<std::string> texts = contents(source / "tests/fuzz/htn/seeds");
  const fs::path cell = source / "tests/cells/htn";
  texts.push_back(content(cell / "two_arms.hddl") + "\n;;problem\n" + content(cell / "d2.hddl"));
  return texts;
}

TEST(HtnMutation, Seeds_WhenRead_ThenEveryOneIsATask) {
  for (const std::string& seed : seeds()) {
    const htn::Run done = run(seed);
    EXPECT_TRUE(done.parsed) << seed;
    EXPECT_EQ(done.finding, "") << seed;
  }
}

TEST(HtnMutation, Texts_WhenBroken_ThenAreRefusedWithAPlaceOrPlannedAsTheValidatorReadsThem) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(setting("STEPWRIGHT_FUZZ_SEED", 20261128)));
  const std::uint64_t rounds = setting("STEPWRIGHT_FUZZ_ROUNDS", kRoundsPerSeed);
  const std::vector<std::string> all = seeds();
  std::size_t runs = 0, parsed = 0, planned = 0;
  for (std::size_t s = 0; s < all.size(); ++s) {
    for (std::uint64_t round = 0; round < rounds; ++round) {
      const std::string text = pddl::mutated(all[s], all, random);
      name_case("htn seed " + std::to_string(s) + ", round " + std::to_string(round),
                std::as_bytes(std::span(text)));
      const htn::Run done = run(text);
      ++runs;
      parsed += done.parsed ? 1 : 0;
      planned += done.planned ? 1 : 0;
      if (done.finding.empty()) continue;
      ADD_FAILURE() << "seed " << s << ", round " << round << ": " << done.finding << ", in " << keep_case();
      return;
    }
  }
  std::cout << runs << " runs, " << parsed << " parsed, " << planned << " planned\n";
  // Else the mutations do not get to the search.
  EXPECT_GT(parsed, runs / 40);
  EXPECT_GT(planned, runs / 100);
}

// Where libFuzzer is to find them: STEPWRIGHT_FUZZ_CORPUS.
TEST(HtnMutation, Seeds_WhenWrittenAsACorpus_ThenEachIsAFile) {
  expect_corpus_written(seeds());
}

}  // namespace
}  // namespace stepwright::fuzz::htn
