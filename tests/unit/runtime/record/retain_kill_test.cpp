// What a store says after its process was killed at any instant.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <random>

#include "tests/support/patience.h"
#include "tests/support/test_program.h"
#include "tests/unit/runtime/record/retained_machine.h"

namespace stepwright::record {
namespace {

constexpr int kKills = 1'000;
constexpr int kKillsOnDisk = 100;
// Several blocks of the disk, so that a write takes its time.
constexpr std::uint32_t kWords = 2'048;

// One retained array; all its words are the same number.
reader::LoadedProgram array_program() {
  writer::ContainerModel model = support::one_program(kWords * 8, [](auto&) {});
  const auto lint = model.add_type(writer::elementary(bytecode::ElementaryType::Lint));
  writer::Type array;
  array.name = "ARRAY";
  array.kind = bytecode::TypeKind::Array;
  array.element = lint;
  array.count = kWords;
  array.size = kWords * 8;
  const auto type = model.add_type(std::move(array));
  writer::Symbol words;
  words.name = "MAIN.words";
  words.type = type;
  model.symbols.push_back(std::move(words));
  model.retain.push_back({0, kWords * 8});
  return support::TestProgram::load(model);
}

void fill(std::span<std::byte> image, std::int64_t number) {
  for (std::uint32_t i = 0; i < kWords; ++i) std::memcpy(image.data() + i * 8, &number, 8);
}

std::int64_t word(std::span<const std::byte> image, std::uint32_t index) {
  std::int64_t number = 0;
  std::memcpy(&number, image.data() + index * 8, 8);
  return number;
}

// Counts on from what it finds, as fast as it can, until it is killed. The k-th values that it publishes are
// the number found + k - 1; which of them the disk has, it tells in `acknowledged`.
[[noreturn]] void count_until_killed(const reader::LoadedProgram& loaded, const std::filesystem::path& store,
                                     std::atomic<std::int64_t>& acknowledged) {
  auto retain = RetainManager::open({.store = store, .period_ns = 100'000});
  auto channel = retain->prepare(loaded.program()).value();
  std::vector<std::byte> image(loaded.program().image_size());
  retain->begin(*channel, image, false);
  const std::int64_t found = word(image, 0);
  for (std::int64_t now_ns = 1'000'000;; now_ns += 1'000'000) {
    fill(image, found + static_cast<std::int64_t>(retain->published()));
    retain->offer(image, now_ns);
    const auto committed = static_cast<std::int64_t>(retain->committed());
    if (committed > 0) acknowledged.store(found + committed - 1);
  }
}

TEST(RetainKill, WhenTheProcessIsKilledAtAnyInstant_ThenNoValueIsTornOrOlderThanTheLastAcknowledged) {
  // A killed process leaves the same bytes on either: what it wrote is the kernel's. The disk takes its time.
  const TestFolder on_disk;
  const TestFolder in_memory(true);
  const reader::LoadedProgram loaded = array_program();
  void* const shared = mmap(nullptr, sizeof(std::atomic<std::int64_t>), PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(shared, MAP_FAILED);
  auto& acknowledged = *new (shared) std::atomic<std::int64_t>(-1);
  std::mt19937 random(4);
  std::uniform_int_distribution<useconds_t> instant_us(0, 14'000);
  std::int64_t newest = 0;
  int with_acknowledgement = 0;
  int ahead = 0;
  for (int kill_number = 0; kill_number < kKills; ++kill_number) {
    const TestFolder& folder = kill_number < kKillsOnDisk ? on_disk : in_memory;
    if (kill_number % 25 == 0)
      std::filesystem::remove(folder.store());  // the making of a store is an instant too
    acknowledged.store(-1);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) count_until_killed(loaded, folder.store(), acknowledged);
    // Every other one is killed behind its first acknowledgement, however slow the machine is.
    if (kill_number % 2 == 1) {
      const auto patience = std::chrono::steady_clock::now() + support::kPatience;
      while (acknowledged.load() < 0 && std::chrono::steady_clock::now() < patience) usleep(100);
    }
    usleep(instant_us(random));
    ASSERT_EQ(kill(child, SIGKILL), 0);
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    const auto found = RetainStore::read(folder.store());
    ASSERT_TRUE(found) << result::to_string(found.error());
    const std::int64_t last = acknowledged.load();
    if (!*found) {
      ASSERT_EQ(last, -1) << kill_number;
      continue;
    }
    const std::int64_t number = word((*found)->payload, 0);
    for (std::uint32_t i = 0; i < kWords; ++i) ASSERT_EQ(word((*found)->payload, i), number) << kill_number;
    ASSERT_GE(number, last) << kill_number;
    if (last >= 0) ++with_acknowledgement;
    if (number > last) ++ahead;
    newest = std::max(newest, number);
  }
  munmap(shared, sizeof(std::atomic<std::int64_t>));
  std::printf(
      "%d kills, %d after an acknowledged write, %d with a newer value in the store, numbers up to %lld\n",
      kKills, with_acknowledgement, ahead, static_cast<long long>(newest));
  // Else it was killed before it did anything and the test shows nothing.
  EXPECT_GT(with_acknowledgement, kKills / 100);
}

}  // namespace
}  // namespace stepwright::record
