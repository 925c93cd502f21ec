// Thousands of broken containers, made from real programs: each is refused or stays within its memory.
//
// STEPWRIGHT_FUZZ_CORPUS, if set, names a folder that gets the unbroken containers: seeds for fuzz_container.
// Longer: STEPWRIGHT_FUZZ_SEED=7 STEPWRIGHT_FUZZ_ROUNDS=50000 fuzz_mutation. What stops the process is kept,
// too.

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/writer/container_writer.h"
#include "runtime/bytecode/writer/document_section.h"
#include "tests/fuzz/corpus.h"
#include "tests/fuzz/fault_case.h"
#include "tests/fuzz/guarded.h"
#include "tests/fuzz/guarded_run.h"
#include "tests/fuzz/mutation.h"
#include "tests/support/sample_model.h"

namespace stepwright::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kRoundsPerProgram = 2000;

struct Seed {
  std::string name;
  std::vector<std::byte> bytes;
};

// The containers of a folder of language tests.
void append_programs(const std::string& folder, std::vector<Seed>& out) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(STEPWRIGHT_SOURCE_DIR "/tests/st/programs/" + folder)) {
    if (entry.path().extension() == ".st") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    std::ifstream file(path, std::ios::binary);
    driver::CompileInput input;
    input.texts.push_back({path.filename().string(), {std::istreambuf_iterator<char>(file), {}}});
    auto compiled = driver::compile(input);
    if (!compiled) throw std::runtime_error(result::to_string(compiled.error()));
    out.push_back({folder + "_" + path.stem().string(), std::move(compiled->container)});
  }
}

// Language tests, and a model with every kind of record.
std::vector<Seed> seeds() {
  std::vector<Seed> out{{"sample", writer::write_container(support::sample_model()).value()}};
  out.push_back({"document", writer::with_document(out.front().bytes, R"({"version":1,"sheets":[]})")});
  for (const char* const folder : {"tour", "functions", "library"}) append_programs(folder, out);
  return out;
}

TEST(Mutation, RealPrograms_WhenUnbroken_ThenRun) {
  const char* const corpus = std::getenv("STEPWRIGHT_FUZZ_CORPUS");
  for (const Seed& seed : seeds()) {
    for (const Side side : {Side::Front, Side::Back})
      EXPECT_EQ(guarded_run(seed.bytes, side), Outcome::Ran) << seed.name;
    if (corpus == nullptr) continue;
    std::ofstream file(fs::path(corpus) / seed.name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(seed.bytes.data()),
               static_cast<std::streamsize>(seed.bytes.size()));
  }
}

TEST(Mutation, RealPrograms_WhenBroken_ThenAreRefusedOrStayWithinTheirMemoryOnEveryEngine) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(setting("STEPWRIGHT_FUZZ_SEED", 20261121)));
  const auto rounds = setting("STEPWRIGHT_FUZZ_ROUNDS", kRoundsPerProgram);
  std::array<int, kOutcomes> outcomes{};
  for (const Seed& seed : seeds()) {
    for (std::uint64_t round = 0; round < rounds; ++round) {
      const std::vector<std::byte> bytes = mutated(seed.bytes, random);
      name_case(seed.name + ", round " + std::to_string(round), bytes);
      const Outcome outcome = guarded_run(bytes, round % 2 == 0 ? Side::Back : Side::Front);
      ++outcomes[static_cast<std::size_t>(outcome)];
      if (outcome == Outcome::BrokeOut || outcome == Outcome::Differs) {
        FAIL() << seed.name << ", round " << round << ": " << static_cast<int>(outcome) << ", in "
               << keep_case();
      }
    }
  }
  // Else the mutations do not get to the engines, or not to the verifier's rules.
  EXPECT_GT(outcomes[static_cast<std::size_t>(Outcome::Ran)], 2000);
  EXPECT_GT(outcomes[static_cast<std::size_t>(Outcome::Refused)], 10'000);
  std::cout << outcomes[0] << " refused, " << outcomes[1] << " too large, " << outcomes[2] << " ran\n";
}

}  // namespace
}  // namespace stepwright::fuzz
