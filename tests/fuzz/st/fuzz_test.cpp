// Differential tests: random ST programs on both engines, and beside a translation to C.
//
// Long runs: STEPWRIGHT_FUZZ_MINUTES=60 STEPWRIGHT_FUZZ_SEED=7 st_fuzz, or STEPWRIGHT_FUZZ_PROGRAMS=100000.
// What differs is written into the working directory, as the smallest program that still does (scripts/fuzz).

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ladder/exchange/plcopen_writer.h"
#include "tests/fuzz/st/coverage.h"
#include "tests/fuzz/st/engines.h"
#include "tests/fuzz/st/extras/ladder.h"
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
  if (program.ladder) {
    const auto drawn = stepwright::exchange::write_plcopen(random_ladder(program.seed));
    std::ofstream(file + ".xml") << (drawn ? *drawn : std::string());
  }
  ADD_FAILURE() << "seed " << program.seed << " differs (" << file << "):\n"
                << text.substr(0, text.find("*)"));
}

constexpr int kMostReports = 5;

// How long a test goes on: a number of programs, or minutes.
class Extent {
 public:
  explicit Extent(std::uint64_t part) : programs_(setting("STEPWRIGHT_FUZZ_PROGRAMS", 3000) / part) {
    const std::uint64_t minutes = setting("STEPWRIGHT_FUZZ_MINUTES", 0);
    if (minutes != 0) end_ = std::chrono::steady_clock::now() + std::chrono::minutes(minutes);
  }

  bool goes_on(std::uint64_t done) const {
    return end_ ? std::chrono::steady_clock::now() < *end_ : done < programs_;
  }
  // Enough for a table without gaps.
  bool is_long() const { return end_.has_value() || programs_ >= 200; }

 private:
  std::uint64_t programs_;
  std::optional<std::chrono::steady_clock::time_point> end_;
};

void run_engines(Language language, const char* kind) {
  if (!Engines::has_native()) std::cout << "one engine only: its programs are compiled, verified and run\n";
  const Extent extent(language == Language::Whole ? 2 : 1);
  Coverage coverage(language);
  int reports = 0;
  for (std::uint64_t done = 0; extent.goes_on(done) && reports < kMostReports; ++done) {
    const auto program = generate(first_seed() + done, language);
    const Outcome outcome = try_engines(*program, {});
    coverage.add(*program, outcome);
    if (outcome.difference.empty()) continue;
    report(*program, kind, try_engines);
    ++reports;
  }
  std::cout << coverage.table();
  if (extent.is_long() && reports == 0) {
    EXPECT_EQ(coverage.missing(), "");
    EXPECT_LT(coverage.first_scan_traps(), 30u);  // a program that traps at once shows little
  }
}

TEST(StFuzz, Engines_WhenProgramsAreRandom_ThenTheyAgreeAfterEveryScan) {
  run_engines(Language::Common, "engines");
}

TEST(StFuzz, Engines_WhenProgramsHaveAllOfTheLanguage_ThenTheyAgreeAfterEveryScan) {
  run_engines(Language::Whole, "whole");
}

TEST(StFuzz, C_WhenProgramsAreRandom_ThenItsVariablesAndTrapsAreTheInterpreters) {
  constexpr std::uint64_t kBatch = 40;
  const Extent extent(15);
  Coverage coverage(Language::Common);
  int reports = 0;
  for (std::uint64_t done = 0; extent.goes_on(done) && reports < kMostReports; done += kBatch) {
    std::vector<std::unique_ptr<Program>> owned;
    std::vector<const Program*> programs;
    for (std::uint64_t i = done; i < done + kBatch; ++i) {
      owned.push_back(generate(first_seed() + i, Language::Common));
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
  if (extent.is_long()) {
    EXPECT_LT(coverage.first_scan_traps(), 30u);
  }
}

TEST(StFuzz, Program_WhenTheSeedIsTheSame_ThenItIsTheSame) {
  const auto text = [](std::uint64_t seed) { return write_st(*generate(seed, Language::Whole), {}); };
  EXPECT_EQ(text(11), text(11));
  EXPECT_NE(text(11), text(12));
}

}  // namespace
