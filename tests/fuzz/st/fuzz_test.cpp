// Differential tests: random ST programs on both engines, and beside a translation to C.
// Long runs: STEPWRIGHT_FUZZ_PROGRAMS=100000 STEPWRIGHT_FUZZ_SEED=7 st_fuzz

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

#include "tests/fuzz/st/coverage.h"
#include "tests/fuzz/st/engines.h"
#include "tests/fuzz/st/generator.h"

namespace {

using namespace stepwright::st_fuzz;

std::uint64_t setting(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

std::uint64_t first_seed() {
  return setting("STEPWRIGHT_FUZZ_SEED", 1);
}

// A program that differs is kept as a file in the working directory.
void report(const Program& program, const char* kind, Outcome (*attempt)(const Program&, const Dropped&)) {
  const std::string text = reduced(program, attempt);
  const std::string file = std::string("st_fuzz_") + kind + "_" + std::to_string(program.seed) + ".st";
  std::ofstream(file) << text;
  ADD_FAILURE() << "seed " << program.seed << " differs (" << file << "):\n"
                << text.substr(0, text.find("*)"));
}

constexpr int kMostReports = 5;

TEST(StFuzz, Engines_WhenProgramsAreRandom_ThenTheyAgreeAfterEveryScan) {
  if (!Engines::has_native()) std::cout << "one engine only: its programs are compiled, verified and run\n";
  const std::uint64_t count = setting("STEPWRIGHT_FUZZ_PROGRAMS", 3000);
  Coverage coverage;
  int reports = 0;
  for (std::uint64_t seed = first_seed(); seed < first_seed() + count && reports < kMostReports; ++seed) {
    const auto program = generate(seed);
    const Outcome outcome = try_engines(*program, {});
    coverage.add(*program, outcome);
    if (outcome.difference.empty()) continue;
    report(*program, "engines", try_engines);
    ++reports;
  }
  std::cout << coverage.table();
  if (count >= 1000 && reports == 0) {
    EXPECT_EQ(coverage.missing(), "");
  }
}

TEST(StFuzz, C_WhenProgramsAreRandom_ThenItsVariablesAndTrapsAreTheInterpreters) {
  constexpr std::uint64_t kBatch = 40;
  const std::uint64_t count = setting("STEPWRIGHT_FUZZ_PROGRAMS", 3000) / 15;
  Coverage coverage;
  int reports = 0;
  for (std::uint64_t done = 0; done < count && reports < kMostReports; done += kBatch) {
    std::vector<std::unique_ptr<Program>> owned;
    std::vector<const Program*> programs;
    for (std::uint64_t i = done; i < std::min(count, done + kBatch); ++i) {
      owned.push_back(generate(first_seed() + i));
      programs.push_back(owned.back().get());
    }
    const std::vector<Outcome> outcomes = try_c(programs, {});
    for (std::size_t i = 0; i < programs.size(); ++i) {
      coverage.add(*programs[i], outcomes[i]);
      if (outcomes[i].difference.empty() || reports == kMostReports) continue;
      report(*programs[i], "c", try_c_alone);
      ++reports;
    }
  }
  std::cout << coverage.table();
  // A program that traps at once shows little.
  if (count >= 100) {
    EXPECT_LT(coverage.first_scan_traps(), 30u);
  }
}

TEST(StFuzz, Program_WhenTheSeedIsTheSame_ThenItIsTheSame) {
  EXPECT_EQ(write_st(*generate(11), {}), write_st(*generate(11), {}));
  EXPECT_NE(write_st(*generate(11), {}), write_st(*generate(12), {}));
}

}  // namespace
