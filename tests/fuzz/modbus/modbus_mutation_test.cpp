// What broke other Modbus slaves, and thousands of mutations of it, through ours.
//
// STEPWRIGHT_FUZZ_CORPUS, if set, names a folder that gets the seeds, in tcp/ and rtu/: for fuzz_modbus_tcp
// and fuzz_modbus_rtu. Longer: STEPWRIGHT_FUZZ_SEED=7 STEPWRIGHT_FUZZ_ROUNDS=50000 fuzz_modbus_mutation.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "tests/fuzz/fault_case.h"
#include "tests/fuzz/modbus/mutation.h"
#include "tests/fuzz/modbus/seeds.h"
#include "tests/fuzz/modbus/slave_run.h"

namespace stepwright::fuzz::modbus {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kRoundsPerSeed = 500;

std::uint64_t setting(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

Seeds seeds() {
  return read_seeds(STEPWRIGHT_SOURCE_DIR "/tests/fuzz/modbus/seeds.txt");
}

void write_corpus(const fs::path& folder, const std::vector<Seed>& all) {
  fs::create_directories(folder);
  for (const Seed& each : all) {
    std::ofstream file(folder / each.name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(each.bytes.data()),
               static_cast<std::streamsize>(each.bytes.size()));
  }
}

struct Totals {
  std::size_t runs = 0;
  std::size_t frames = 0;
  std::size_t answers = 0;
};

// `run` of every seed and of its mutations.
template <typename RunOne>
Totals run_all(const std::vector<Seed>& all, RunOne run) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(setting("STEPWRIGHT_FUZZ_SEED", 20261122)));
  const std::uint64_t rounds = setting("STEPWRIGHT_FUZZ_ROUNDS", kRoundsPerSeed);
  Totals totals;
  for (const Seed& seed : all) {
    for (std::uint64_t round = 0; round <= rounds; ++round) {
      const Bytes bytes = round == 0 ? seed.bytes : mutated(seed.bytes, all, random);
      name_case("modbus " + seed.name + ", round " + std::to_string(round), std::as_bytes(std::span(bytes)));
      const Run done =
          run(bytes, static_cast<std::uint32_t>(round), round % 2 == 0 ? Side::Back : Side::Front);
      ++totals.runs;
      totals.frames += done.frames;
      totals.answers += done.answers;
      if (!done.finding.empty()) {
        ADD_FAILURE() << seed.name << ", round " << round << ": " << done.finding << ", in " << keep_case();
        return totals;
      }
    }
  }
  std::cout << totals.runs << " runs, " << totals.frames << " frames, " << totals.answers << " answered\n";
  return totals;
}

TEST(ModbusMutation, TcpStreams_WhenBroken_ThenAreAnsweredOrEndedAndTheNextClientIsServed) {
  const Totals totals = run_all(seeds().tcp, run_tcp);
  // Else the mutations do not get to the engine.
  EXPECT_GT(totals.frames, totals.runs / 4);
  EXPECT_GT(totals.answers, totals.runs / 20);
}

TEST(ModbusMutation, RtuLines_WhenBroken_ThenValidRequestsGetThrough) {
  const Totals totals =
      run_all(seeds().rtu, [](const Bytes& line, std::uint32_t, Side side) { return run_rtu(line, side); });
  EXPECT_GT(totals.frames, totals.runs / 10);
}

TEST(ModbusMutation, Seeds_WhenRead_ThenHoldEveryReportAndGoToTheCorpus) {
  const Seeds all = seeds();
  for (const char* const report : {"cve-2019-14462", "cve-2019-14463", "cve-2022-0367", "cve-2023-26793",
                                   "cve-2024-10918", "cve-2024-36843", "libmodbus-837", "libmodbus-848",
                                   "nanomodbus-118", "nanomodbus-120", "openplc", "count-0", "count-ffff"}) {
    const bool held =
        std::ranges::any_of(all.tcp, [&](const Seed& each) { return each.name.starts_with(report); });
    EXPECT_TRUE(held) << report;
  }
  const auto shortest = std::ranges::find(all.tcp, "nanomodbus-120", &Seed::name);
  ASSERT_NE(shortest, all.tcp.end());
  EXPECT_EQ(shortest->bytes.size(), 23u);
  if (const char* const folder = std::getenv("STEPWRIGHT_FUZZ_CORPUS")) {
    write_corpus(fs::path(folder) / "tcp", all.tcp);
    write_corpus(fs::path(folder) / "rtu", all.rtu);
  }
}

}  // namespace
}  // namespace stepwright::fuzz::modbus
