// PDDL texts and thousands of mutations of them through the front end.
//
// STEPWRIGHT_FUZZ_CORPUS, if set, names a folder that gets the seeds, for fuzz_pddl. Longer:
// STEPWRIGHT_FUZZ_SEED=7 STEPWRIGHT_FUZZ_ROUNDS=50000 fuzz_pddl_mutation.

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <span>

#include "tests/fuzz/corpus.h"
#include "tests/fuzz/fault_case.h"
#include "tests/fuzz/pddl/mutation.h"
#include "tests/fuzz/pddl/pddl_run.h"

namespace stepwright::fuzz::pddl {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kRoundsPerSeed = 600;

// What is in the folder, and the bench with one of its plans.
std::vector<std::string> seeds() {
  const fs::path source(STEPWRIGHT_SOURCE_DIR);
  std::vector<std::string> texts = contents(source / "tests/fuzz/pddl/seeds");
  const fs::path bench = source / "tests/cells/bench";
  texts.push_back(content(bench / "domain.pddl") + "\n;;problem\n" + content(bench / "problem.pddl") +
                  "\n;;plan\n" + content(bench / "plans/metric_ff.plan"));
  return texts;
}

TEST(PddlMutation, Seeds_WhenRead_ThenEveryOneIsATaskThatGrounds) {
  for (const std::string& seed : seeds()) {
    const pddl::Run done = run(seed);
    EXPECT_TRUE(done.parsed && done.grounded) << seed;
    EXPECT_EQ(done.finding, "") << seed;
  }
}

TEST(PddlMutation, Texts_WhenBroken_ThenAreRefusedWithAPlaceOrMeanTheSameEverywhere) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(setting("STEPWRIGHT_FUZZ_SEED", 20261122)));
  const std::uint64_t rounds = setting("STEPWRIGHT_FUZZ_ROUNDS", kRoundsPerSeed);
  const std::vector<std::string> all = seeds();
  std::size_t runs = 0, parsed = 0, grounded = 0;
  for (std::size_t s = 0; s < all.size(); ++s) {
    for (std::uint64_t round = 0; round < rounds; ++round) {
      const std::string text = mutated(all[s], all, random);
      name_case("pddl seed " + std::to_string(s) + ", round " + std::to_string(round),
                std::as_bytes(std::span(text)));
      const pddl::Run done = run(text);
      ++runs;
      parsed += done.parsed ? 1 : 0;
      grounded += done.grounded ? 1 : 0;
      if (done.finding.empty()) continue;
      ADD_FAILURE() << "seed " << s << ", round " << round << ": " << done.finding << ", in " << keep_case();
      return;
    }
  }
  std::cout << runs << " runs, " << parsed << " parsed, " << grounded << " grounded\n";
  // Else the mutations do not get to the checker and beyond.
  EXPECT_GT(parsed, runs / 20);
  EXPECT_GT(grounded, runs / 40);
}

// Where libFuzzer is to find them: STEPWRIGHT_FUZZ_CORPUS.
TEST(PddlMutation, Seeds_WhenWrittenAsACorpus_ThenEachIsAFile) {
  expect_corpus_written(seeds());
}

}  // namespace
}  // namespace stepwright::fuzz::pddl
