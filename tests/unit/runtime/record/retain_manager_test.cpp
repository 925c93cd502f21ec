#include "runtime/record/retain_manager.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/malloc_guard.h"
#include "tests/unit/runtime/record/retained_machine.h"

namespace stepwright::record {
namespace {

constexpr const char* kNumbers = "VAR RETAIN n : DINT := 5; s : STRING[8]; END_VAR VAR free : INT; END_VAR";

// A process that ran and ended in order.
void leave(const TestFolder& folder, const std::string& declarations, const std::string& path,
           std::int64_t value) {
  RetainedMachine machine(declarations, {.store = folder.store()});
  machine.start();
  machine.set(path, value);
  machine.stop();
}

TEST(RetainManager, WhenAProcessEndsAndTheNextBegins_ThenRetainedVariablesGoOn) {
  const TestFolder folder;
  leave(folder, kNumbers, "MAIN.n", 77);
  RetainedMachine machine(kNumbers, {.store = folder.store()});
  EXPECT_TRUE(machine.start().empty());
  EXPECT_EQ(machine.get("MAIN.n"), 77);
  EXPECT_EQ(machine.get("MAIN.free"), 0);
  EXPECT_EQ(machine.retain().note(), "");
}

TEST(RetainManager, WhenTheStartIsCold_ThenTheyHaveInitialValuesForGood) {
  const TestFolder folder;
  leave(folder, kNumbers, "MAIN.n", 77);
  {
    RetainedMachine machine(kNumbers, {.store = folder.store()});
    machine.start(true);
    EXPECT_EQ(machine.get("MAIN.n"), 5);
  }
  RetainedMachine machine(kNumbers, {.store = folder.store()});
  machine.start();
  EXPECT_EQ(machine.get("MAIN.n"), 5);
}

TEST(RetainManager, WhenAProgramIsStoppedAndStarted_ThenItGoesOnWithoutAStoreToo) {
  RetainedMachine machine(kNumbers, {});
  machine.start();
  machine.set("MAIN.n", 8);
  machine.set("MAIN.free", 9);
  machine.stop();
  machine.start();
  EXPECT_EQ(machine.get("MAIN.n"), 8);
  EXPECT_EQ(machine.get("MAIN.free"), 0);
}

// Names are compared when a program is prepared: what is left for the start are copies.
TEST(RetainManager, WhenAProgramStarts_ThenTheScanThreadTakesNoMemory) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns malloc";
  const TestFolder folder;
  leave(folder, kNumbers, "MAIN.n", 77);
  RetainedMachine machine(kNumbers, {.store = folder.store(), .policy = RetainPolicy::Refuse});
  const auto quiet = [&] {
    const support::GuardCounts before = support::guard_counts();
    const bool started = machine.begin();
    return started && support::guard_counts() == before;
  };
  EXPECT_TRUE(quiet()) << "from the store";
  EXPECT_EQ(machine.get("MAIN.n"), 77);
  machine.set("MAIN.n", 78);
  machine.stop();
  EXPECT_TRUE(quiet()) << "from itself";
  EXPECT_EQ(machine.get("MAIN.n"), 78);
  machine.stop();
  machine.load("VAR RETAIN s : STRING[8]; END_VAR VAR pad : LINT; END_VAR VAR RETAIN n : DINT := 5; END_VAR");
  EXPECT_TRUE(quiet()) << "from another program";
  EXPECT_EQ(machine.get("MAIN.n"), 78);
}

TEST(RetainManager, WhenAnotherProgramFollows_ThenWhatFitsIsCarried) {
  const TestFolder folder;
  RetainedMachine machine("VAR RETAIN n : DINT; gone : INT; r : INT := 1; a : ARRAY[0..1] OF INT; END_VAR",
                          {.store = folder.store()});
  machine.start();
  machine.set("MAIN.n", 8);
  machine.set("MAIN.r", 9);
  machine.set("MAIN.a[1]", 10);
  machine.stop();
  machine.load(
      "VAR RETAIN fresh : INT := 3; r : DINT := 4; N : DINT; a : ARRAY[0..5] OF INT := [6(2)]; END_VAR");
  EXPECT_TRUE(machine.start().empty());
  EXPECT_EQ(machine.get("MAIN.n"), 8);
  EXPECT_EQ(machine.get("MAIN.r"), 4);
  EXPECT_EQ(machine.get("MAIN.fresh"), 3);
  EXPECT_EQ(machine.get("MAIN.a[1]"), 10);
  EXPECT_EQ(machine.get("MAIN.a[5]"), 2);
  const std::string note = machine.retain().note();
  EXPECT_NE(note.find("1 new (MAIN.fresh)"), std::string::npos) << note;
  EXPECT_NE(note.find("1 gone (MAIN.gone)"), std::string::npos) << note;
  EXPECT_NE(note.find("1 of another type (MAIN.r)"), std::string::npos) << note;
}

TEST(RetainManager, WhenThePolicyIsInitialise_ThenOneMisfitGivesAllInitialValues) {
  const TestFolder folder;
  leave(folder, kNumbers, "MAIN.n", 77);
  const RetainConfig config{.store = folder.store(), .policy = RetainPolicy::Initialise};
  {
    RetainedMachine same(kNumbers, config);
    same.start();
    EXPECT_EQ(same.get("MAIN.n"), 77);
    same.stop();
  }
  RetainedMachine machine("VAR RETAIN n : DINT := 5; s : STRING[8]; more : INT; END_VAR", config);
  EXPECT_TRUE(machine.start().empty());
  EXPECT_EQ(machine.get("MAIN.n"), 5);
  EXPECT_NE(machine.retain().note().find("initial values"), std::string::npos);
}

TEST(RetainManager, WhenThePolicyIsRefuse_ThenTheStartIsRefusedAndTheValuesStay) {
  const TestFolder folder;
  leave(folder, kNumbers, "MAIN.n", 77);
  const RetainConfig config{.store = folder.store(), .policy = RetainPolicy::Refuse};
  {
    RetainedMachine machine("VAR RETAIN n : LINT; END_VAR", config);
    const result::Diagnostics problems = machine.start();
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].code, "R0025");
    EXPECT_EQ(problems[0].where.file, folder.store().string());
    EXPECT_NE(problems[0].message.find("MAIN.n"), std::string::npos);
    // The program that they belong to still finds them.
    machine.load(kNumbers);
    EXPECT_TRUE(machine.start().empty());
    EXPECT_EQ(machine.get("MAIN.n"), 77);
    machine.stop();
  }
  RetainedMachine machine("VAR RETAIN n : LINT; END_VAR", config);
  EXPECT_FALSE(machine.start().empty());
  EXPECT_TRUE(machine.start(true).empty());
}

TEST(RetainManager, WhenAProgramRetainsNothing_ThenTheValuesWaitForTheNext) {
  const TestFolder folder;
  leave(folder, kNumbers, "MAIN.n", 77);
  leave(folder, "VAR n : INT; END_VAR", "MAIN.n", 1);
  RetainedMachine machine(kNumbers, {.store = folder.store()});
  machine.start();
  EXPECT_EQ(machine.get("MAIN.n"), 77);
}

TEST(RetainManager, WhenALocatedBitIsRetained_ThenItsNeighboursAreNot) {
  const std::string bits = "VAR RETAIN a AT %MX0.1 : BOOL; END_VAR VAR b AT %MX0.2 : BOOL; END_VAR";
  const TestFolder folder;
  {
    RetainedMachine machine(bits, {.store = folder.store()});
    machine.start();
    machine.set("MAIN.a", 1);
    machine.set("MAIN.b", 1);
    machine.stop();
  }
  RetainedMachine machine(bits, {.store = folder.store()});
  machine.start();
  EXPECT_EQ(machine.get("MAIN.a"), 1);
  EXPECT_EQ(machine.get("MAIN.b"), 0);
}

TEST(RetainManager, WhenTheStoreIsDamaged_ThenItIsKeptAsideAndTheStartHasInitialValues) {
  const TestFolder folder;
  std::ofstream(folder.store()) << "SWRETAIN of which the rest is lost";
  {
    RetainedMachine machine(kNumbers, {.store = folder.store()});
    EXPECT_TRUE(machine.start().empty());
    EXPECT_EQ(machine.get("MAIN.n"), 5);
    const std::string note = machine.retain().note();
    EXPECT_NE(note.find("R0023"), std::string::npos) << note;
    EXPECT_NE(note.find("retain.store.damaged"), std::string::npos) << note;
    machine.set("MAIN.n", 6);
    machine.stop();
  }
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "retain.store.damaged"));
  RetainedMachine machine(kNumbers, {.store = folder.store()});
  machine.start();
  EXPECT_EQ(machine.get("MAIN.n"), 6);
}

TEST(RetainManager, WhenTheStoreBeforeIsStillAside_ThenItStays) {
  const TestFolder folder;
  std::ofstream(folder.store()) << "SWRETAIN of which the rest is lost";
  std::ofstream(folder.path() / "retain.store.damaged") << "the one before";
  RetainedMachine machine(kNumbers, {.store = folder.store()});
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "retain.store.damaged-2"));
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "retain.store.damaged"), 14u);
}

// Of a wrong path in the configuration: what is there belongs to somebody else.
TEST(RetainManager, WhenAForeignFileIsThere_ThenItStaysAndIsSaid) {
  const TestFolder folder;
  const std::string text = "notes of somebody\n";
  std::ofstream(folder.store()) << text;
  {
    RetainedMachine machine(kNumbers, {.store = folder.store(), .period_ns = 1'000'000});
    EXPECT_TRUE(machine.start().empty());
    machine.set("MAIN.n", 6);
    machine.stop();
    EXPECT_NE(machine.retain().note().find("R0023"), std::string::npos) << machine.retain().note();
  }
  std::string kept;
  std::getline(std::ifstream(folder.store()), kept);
  EXPECT_EQ(kept + "\n", text);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(RetainManager, WhenAFolderIsThere_ThenItStaysAndIsSaid) {
  const TestFolder folder;
  std::filesystem::create_directory(folder.store());
  {
    RetainedMachine machine(kNumbers, {.store = folder.store(), .period_ns = 1'000'000});
    EXPECT_TRUE(machine.start().empty());
    machine.stop();
    EXPECT_NE(machine.retain().note().find("R0024"), std::string::npos) << machine.retain().note();
  }
  EXPECT_TRUE(std::filesystem::is_directory(folder.store()));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(RetainManager, WhenItRuns_ThenValuesAreWrittenAndAcknowledged) {
  const TestFolder folder;
  RetainedMachine machine(kNumbers, {.store = folder.store(), .period_ns = 1'000'000});
  machine.start();
  for (int i = 1; i <= 20; ++i) {
    machine.set("MAIN.n", i);
    machine.offer();
    ASSERT_TRUE(machine.settled());
    const auto found = RetainStore::read(folder.store()).value();
    std::int32_t stored = 0;
    std::memcpy(&stored, found->payload.data() + found->layout.find("MAIN.n")->address, sizeof stored);
    EXPECT_EQ(stored, i);
  }
}

TEST(RetainManager, WhenThePeriodIsNotOver_ThenNothingIsPublished) {
  const TestFolder folder;
  RetainedMachine machine(kNumbers, {.store = folder.store(), .period_ns = 1'000});
  machine.start();
  machine.retain().offer(machine.image(), 10'000);
  const std::uint64_t published = machine.retain().published();
  machine.retain().offer(machine.image(), 10'999);
  EXPECT_EQ(machine.retain().published(), published);
  machine.retain().offer(machine.image(), 11'000);
  EXPECT_EQ(machine.retain().published(), published + 1);
}

TEST(RetainManager, WhenValuesAreOffered_ThenNothingIsAllocatedOrLocked) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns malloc";
  const TestFolder folder;
  RetainedMachine machine(kNumbers, {.store = folder.store(), .period_ns = 1});
  machine.start();
  const support::GuardCounts before = support::guard_counts();
  for (int i = 0; i < 1'000; ++i) machine.offer();
  EXPECT_EQ(support::guard_counts(), before);
  EXPECT_TRUE(machine.settled());
}

}  // namespace
}  // namespace stepwright::record
