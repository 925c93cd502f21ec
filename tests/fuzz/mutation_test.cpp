// Thousands of broken containers, made from real programs: each is refused or stays within its memory.
//
// STEPWRIGHT_FUZZ_CORPUS, if set, names a folder that gets the unbroken containers: seeds for fuzz_container.

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/writer/container_writer.h"
#include "tests/fuzz/guarded.h"
#include "tests/fuzz/guarded_run.h"
#include "tests/fuzz/mutation.h"
#include "tests/support/sample_model.h"

namespace stepwright::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr int kRoundsPerProgram = 2000;

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
  for (const char* const folder : {"tour", "functions", "library"}) append_programs(folder, out);
  return out;
}

TEST(Guarded, Memory_WhenAByteBesideItIsWritten_ThenIsNoLongerIntact) {
  for (const std::ptrdiff_t at : {-1, 10}) {
    Guarded<std::uint8_t> memory(10);
    EXPECT_TRUE(memory.intact());
    memory.inner().data()[at] = 0;
    EXPECT_FALSE(memory.intact());
  }
}

TEST(Mutation, RealPrograms_WhenUnbroken_ThenRun) {
  const char* const corpus = std::getenv("STEPWRIGHT_FUZZ_CORPUS");
  for (const Seed& seed : seeds()) {
    EXPECT_EQ(guarded_run(seed.bytes), Outcome::Ran) << seed.name;
    if (corpus == nullptr) continue;
    std::ofstream file(fs::path(corpus) / seed.name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(seed.bytes.data()),
               static_cast<std::streamsize>(seed.bytes.size()));
  }
}

TEST(Mutation, RealPrograms_WhenBroken_ThenAreRefusedOrStayWithinTheirMemory) {
  std::mt19937 random(20261121);
  std::array<int, 4> outcomes{};
  for (const Seed& seed : seeds()) {
    for (int round = 0; round < kRoundsPerProgram; ++round) {
      const Outcome outcome = guarded_run(mutated(seed.bytes, random));
      ++outcomes[static_cast<std::size_t>(outcome)];
      ASSERT_NE(outcome, Outcome::BrokeOut) << seed.name << ", round " << round;
    }
  }
  // Else the mutations do not get to the engine, or not to the verifier's rules.
  EXPECT_GT(outcomes[static_cast<std::size_t>(Outcome::Ran)], 2000);
  EXPECT_GT(outcomes[static_cast<std::size_t>(Outcome::Refused)], 10'000);
  RecordProperty("refused", outcomes[0]);
  RecordProperty("ran", outcomes[2]);
}

}  // namespace
}  // namespace stepwright::fuzz
