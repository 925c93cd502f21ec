// The area, its two sides, and what each of them must never do to the other.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <thread>
#include <vector>

#include "runtime/io_memory/memory_driver.h"
#include "runtime/io_memory/plant_side.h"
#include "tests/support/malloc_guard.h"

namespace stepwright::io_memory {
namespace {

using Bytes = std::vector<std::byte>;
using image::IoStatus;

constexpr std::int64_t kMs = 1'000'000;

class IoMemory : public testing::Test {
 protected:
  IoMemory() : name_("test-" + std::to_string(getpid()) + "-" + std::to_string(++count_)) {}
  ~IoMemory() override { std::filesystem::remove(area_path(name_)); }

  std::unique_ptr<IoArea> area(std::uint32_t inputs = 16, std::uint32_t outputs = 24) const {
    auto opened = IoArea::open(name_, inputs, outputs);
    EXPECT_TRUE(opened) << (opened ? "" : result::to_string(opened.error()));
    return opened ? std::move(*opened) : nullptr;
  }
  std::unique_ptr<PlantSide> plant() const {
    auto opened = PlantSide::open(name_, 16, 24);
    EXPECT_TRUE(opened) << (opened ? "" : result::to_string(opened.error()));
    return opened ? std::move(*opened) : nullptr;
  }
  std::string code(std::uint32_t inputs, std::uint32_t outputs) const {
    auto opened = IoArea::open(name_, inputs, outputs);
    return opened ? "" : opened.error().front().code;
  }

  std::string name_;

 private:
  static inline int count_ = 0;
};

Bytes all(std::size_t size, int value) {
  return Bytes(size, static_cast<std::byte>(value));
}

TEST_F(IoMemory, WhenBothSidesAreOpen_ThenBytesGoBothWays) {
  MemoryDriver driver(area());
  const auto plant = this->plant();
  Bytes inputs(16);
  EXPECT_EQ(driver.read_inputs(0, inputs), IoStatus::Good);
  EXPECT_EQ(inputs, all(16, 0));
  Bytes outputs(24);
  EXPECT_FALSE(plant->read_outputs(outputs));
  plant->write_inputs(all(16, 7));
  EXPECT_EQ(driver.read_inputs(0, inputs), IoStatus::Good);
  EXPECT_EQ(inputs, all(16, 7));
  EXPECT_EQ(driver.write_outputs(0, all(24, 9)), IoStatus::Good);
  const auto stamp = plant->read_outputs(outputs);
  ASSERT_TRUE(stamp);
  EXPECT_EQ(stamp->generation, 1u);
  EXPECT_EQ(outputs, all(24, 9));
  EXPECT_EQ(plant->owner(), Owner::Runtime);
}

TEST_F(IoMemory, WhenThePlantAnnouncedATimeAndIsSilent_ThenTheInputsAreLostUntilItIsBack) {
  MemoryDriver driver(area());
  const auto plant = this->plant();
  Bytes inputs(16);
  plant->write_inputs(all(16, 7));
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(driver.read_inputs(0, inputs), IoStatus::Good);  // nothing was announced
  plant->announce(kMs);
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(driver.read_inputs(0, inputs), IoStatus::Lost);
  plant->announce(3'600'000 * kMs);
  EXPECT_EQ(driver.read_inputs(0, inputs), IoStatus::Good);
}

TEST_F(IoMemory, WhenTheRuntimeEnds_ThenItReleasesTheOutputsAndTheNextHasAnotherGeneration) {
  const auto plant = this->plant();
  Bytes outputs(24);
  for (std::uint64_t generation = 1; generation <= 3; ++generation) {
    {
      MemoryDriver driver(area());
      EXPECT_EQ(driver.write_outputs(0, all(24, static_cast<int>(generation))), IoStatus::Good);
      EXPECT_EQ(plant->owner(), Owner::Runtime);
    }
    EXPECT_EQ(plant->owner(), Owner::Released);
    EXPECT_EQ(plant->read_outputs(outputs)->generation, generation);
  }
  EXPECT_EQ(outputs, all(24, 3));
  MemoryDriver next(area());
  Bytes left(24);
  EXPECT_TRUE(next.left_outputs(left));
  EXPECT_EQ(left, outputs);
}

TEST_F(IoMemory, WhenTheOutputsAreTakenOver_ThenTheyAreAsTheyWereLeftUntilTheFirstWrite) {
  auto first = std::make_unique<MemoryDriver>(area());
  MemoryDriver second(area());
  EXPECT_EQ(first->write_outputs(0, all(24, 1)), IoStatus::Good);
  EXPECT_FALSE(first->takes_over()) << "it drives";
  EXPECT_FALSE(second.takes_over()) << "another one drives";
  first->safe(0, false);  // a ramp is on its way
  EXPECT_EQ(first->write_outputs(0, all(24, 5)), IoStatus::Good);
  first.reset();
  EXPECT_TRUE(second.takes_over());
  EXPECT_FALSE(second.takes_over()) << "once";
  Bytes left(24);
  EXPECT_TRUE(second.left_outputs(left));
  EXPECT_EQ(left, all(24, 5));
  EXPECT_EQ(this->plant()->owner(), Owner::Runtime);
  second.release_outputs();
  EXPECT_FALSE(second.takes_over()) << "it has released the outputs";
}

TEST_F(IoMemory, WhenAnotherHasTheLease_ThenTheSecondWritesNothingAndIsLostInTheEnd) {
  MemoryDriver first(area());
  MemoryDriver second(area());
  const auto plant = this->plant();
  Bytes outputs(24);
  EXPECT_EQ(first.write_outputs(0, all(24, 1)), IoStatus::Good);
  IoStatus status = IoStatus::Good;
  for (int i = 0; i < 30'000 && status == IoStatus::Good; ++i) {
    status = second.write_outputs(0, all(24, 2));
    EXPECT_EQ(first.write_outputs(0, all(24, 1)), IoStatus::Good);
    plant->read_outputs(outputs);
    ASSERT_EQ(outputs, all(24, 1));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(status, IoStatus::Lost);
  // So a start there is refused, and whoever asks is told who it is.
  Bytes inputs(16);
  EXPECT_EQ(second.read_inputs(0, inputs), IoStatus::Lost);
  ASSERT_TRUE(second.other_runtime());
  EXPECT_EQ(second.other_runtime()->pid, static_cast<std::uint32_t>(::getpid()));
  EXPECT_FALSE(first.other_runtime());
  EXPECT_EQ(first.read_inputs(0, inputs), IoStatus::Good);
  first.release_outputs();
  EXPECT_FALSE(second.other_runtime());
  EXPECT_EQ(second.read_inputs(0, inputs), IoStatus::Good);
}

TEST_F(IoMemory, WhenSizesDiffer_ThenAnAreaInUseStaysAndAnUnusedOneGoes) {
  {
    const auto plant = this->plant();
    EXPECT_EQ(code(16, 24), "");
    EXPECT_EQ(code(16, 25), "R0043");  // of the same size as a file
    EXPECT_EQ(code(16, 2'400), "R0043");
    const auto second = PlantSide::open(name_, 16, 24);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().front().code, "R0044");
  }
  EXPECT_EQ(code(16, 2'400), "");
  EXPECT_EQ(code(16, 25), "");
}

// Nobody drives yet, no guard and no plant is there: whoever has it open uses it.
TEST_F(IoMemory, WhenItIsOpenElsewhere_ThenItKeepsItsSizesFromTheFirstMoment) {
  {
    const auto first = area();
    EXPECT_EQ(code(16, 2'400), "R0043");
    EXPECT_EQ(code(16, 25), "R0043");
    EXPECT_EQ(code(16, 24), "");
    EXPECT_EQ(code(16, 2'400), "R0043") << "the second one that had it open has taken nothing along";
  }
  EXPECT_EQ(code(16, 2'400), "");
}

// The heartbeat is put back, so that nothing depends on how long this takes.
class Lapse : public IoMemory {
 protected:
  static constexpr std::int64_t kAnHour = 3'600'000 * kMs;
  void stand_still() {
    area()->header().heartbeat_ns.store(static_cast<std::uint64_t>(monotonic_ns() - 2 * kAnHour));
  }
  bool heard() {
    return monotonic_ns() - static_cast<std::int64_t>(area()->header().heartbeat_ns.load()) < kAnHour;
  }
};

TEST_F(Lapse, WhenTheProcessStoodStill_ThenNothingButSafeOutputsIsWrittenAndOnlyThenItIsHeardOf) {
  MemoryDriver driver(area(), PlantNeed::Announced, {.after_ns = kAnHour, .always = true});
  const auto plant = this->plant();
  Bytes outputs(24);
  EXPECT_FALSE(driver.lapsed());
  driver.write_outputs(0, all(24, 1));
  driver.beat();
  EXPECT_FALSE(driver.lapsed());
  for (const bool beat_first : {true, false}) {
    stand_still();
    if (beat_first) driver.beat();  // the monitor's thread may be the first that goes on
    EXPECT_EQ(driver.write_outputs(0, all(24, 2)), IoStatus::Good);  // a scan that was under way
    plant->read_outputs(outputs);
    EXPECT_NE(outputs, all(24, 2));
    EXPECT_FALSE(heard());
    EXPECT_TRUE(driver.lapsed());
    driver.safe(5, true);
    EXPECT_EQ(driver.write_outputs(0, all(24, 3)), IoStatus::Good);
    plant->read_outputs(outputs);
    EXPECT_EQ(outputs, all(24, 3));
    EXPECT_TRUE(heard());
    EXPECT_FALSE(driver.lapsed());
  }
  driver.write_outputs(0, all(24, 4));
  plant->read_outputs(outputs);
  EXPECT_EQ(outputs, all(24, 4));
}

TEST_F(Lapse, WhenNobodyJudges_ThenItGoesOn) {
  MemoryDriver simulated(area());
  simulated.write_outputs(0, all(24, 1));
  stand_still();
  EXPECT_FALSE(simulated.lapsed());
  simulated.release_outputs();
  MemoryDriver alone(area(), PlantNeed::Announced, {.after_ns = kAnHour});
  alone.write_outputs(0, all(24, 1));
  stand_still();
  EXPECT_FALSE(alone.lapsed());
  const auto guard = area();
  ASSERT_TRUE(guard->try_lock(AreaLock::Guard));
  EXPECT_TRUE(alone.lapsed()) << "a guard watches";
}

TEST_F(IoMemory, WhenTheOutputsWereReleased_ThenNothingIsWrittenAnyMore) {
  MemoryDriver driver(area());
  const auto plant = this->plant();
  driver.write_outputs(0, all(24, 1));
  driver.release_outputs();
  EXPECT_EQ(plant->owner(), Owner::Released);
  EXPECT_FALSE(area()->locked_elsewhere(AreaLock::Lease));
  driver.write_outputs(0, all(24, 2));
  driver.beat();
  Bytes outputs(24);
  plant->read_outputs(outputs);
  EXPECT_EQ(outputs, all(24, 1));
  EXPECT_FALSE(area()->locked_elsewhere(AreaLock::Lease));
}

TEST_F(IoMemory, WhenTheFileIsSomethingElse_ThenItIsMadeAnew) {
  const std::string path = area_path(name_);
  { std::unique_ptr<FILE, int (*)(FILE*)>(fopen(path.c_str(), "w"), fclose); }
  EXPECT_EQ(code(16, 24), "");
  {
    std::unique_ptr<FILE, int (*)(FILE*)> file(fopen(path.c_str(), "w"), fclose);
    fputs("not an area", file.get());
  }
  EXPECT_EQ(code(16, 24), "");
  std::filesystem::remove(path);
  std::filesystem::create_symlink("/dev/null", path);
  EXPECT_EQ(code(16, 24), "R0042");
}

TEST(AreaName, WhenItWouldLeaveItsFolder_ThenItIsNone) {
  EXPECT_TRUE(is_area_name("press-1_a.b"));
  for (const char* name : {"", "a/b", "a b", "\xC3\xA4"}) EXPECT_FALSE(is_area_name(name)) << name;
  EXPECT_FALSE(is_area_name(std::string(65, 'a')));
}

// Every word of a write is the same number: a mixture of two would show.
TEST_F(IoMemory, WhenOneWritesAndOneReads_ThenNoReadIsTorn) {
  auto writer_area = area(16, 4'096);
  auto reader_area = area(16, 4'096);
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    Bytes bytes(4'096);
    for (std::uint64_t n = 1; !stop; ++n) {
      std::memset(bytes.data(), static_cast<int>(n & 0xFF), bytes.size());
      writer_area->outputs().write({n, n}, bytes);
    }
  });
  Bytes bytes(4'096);
  int whole = 0;
  const std::int64_t give_up_ns = monotonic_ns() + 30'000 * kMs;
  while (whole < 2'000 && monotonic_ns() < give_up_ns) {
    SlotHeader header{};
    if (!reader_area->outputs().read(header, bytes)) continue;
    ++whole;
    ASSERT_EQ(header.generation, header.time_ns);
    ASSERT_EQ(bytes, all(4'096, static_cast<int>(header.generation & 0xFF)));
  }
  stop = true;
  writer.join();
  EXPECT_EQ(whole, 2'000);
}

// A writer that comes twice in each attempt of a reader, for as many attempts as it is told.
struct Overtaking {
  TwinBlock block;
  int attempts;
  std::uint64_t writes = 0;

  static void turn(void* self) {
    auto& writer = *static_cast<Overtaking*>(self);
    if (writer.attempts-- <= 0) return;
    for (int i = 0; i < 2; ++i) {
      ++writer.writes;
      writer.block.write({writer.writes, writer.writes}, all(24, static_cast<int>(writer.writes)));
    }
  }
};

TEST_F(IoMemory, WhenEveryAttemptIsOvertaken_ThenNothingChanges) {
  auto area = this->area();
  Overtaking writer{area->outputs(), 1'000};
  Bytes bytes = all(24, 0x77);
  SlotHeader header{7, 8};
  EXPECT_FALSE(area->outputs().written());
  EXPECT_FALSE(area->outputs().read(header, bytes)) << "there is nothing yet";
  area->outputs().write({1, 1}, all(24, 1));
  EXPECT_TRUE(area->outputs().written());
  EXPECT_FALSE(area->outputs().read(header, bytes, Overtaking::turn, &writer));
  EXPECT_GT(writer.writes, 2u);
  EXPECT_EQ(bytes, all(24, 0x77));
  EXPECT_EQ(header.generation, 7u);
  EXPECT_EQ(header.time_ns, 8u);
}

TEST_F(IoMemory, WhenSomeAttemptsAreOvertaken_ThenTheNewestWriteIsRead) {
  auto area = this->area();
  area->outputs().write({1, 1}, all(24, 1));
  for (int attempts = 0; attempts < 4; ++attempts) {
    Overtaking writer{area->outputs(), attempts, 100};
    area->outputs().write({100, 100}, all(24, 100));
    Bytes bytes(24);
    SlotHeader header{};
    ASSERT_TRUE(area->outputs().read(header, bytes, Overtaking::turn, &writer));
    EXPECT_EQ(header.generation, writer.writes);
    EXPECT_EQ(bytes, all(24, static_cast<int>(writer.writes)));
  }
}

TEST(InputAge, WhenInputsAreHeld_ThenTheyAreCountedAndTooOldInTheEnd) {
  InputAge age;
  EXPECT_TRUE(age.held(1'000, 100)) << "there were none: these are as good as any";
  EXPECT_TRUE(age.held(1'100, 100));
  EXPECT_FALSE(age.held(1'101, 100));
  age.fresh(1'200);
  EXPECT_TRUE(age.held(1'300, 100));
  EXPECT_FALSE(age.held(1'301, 100));
  EXPECT_EQ(age.held_reads(), 5u);
}

// Beside a plant that never pauses: a read gives one write as a whole, or leaves what was there and counts.
TEST_F(IoMemory, WhenAPlantWritesWithoutAPause_ThenInputsAreWholeOrHeld) {
  constexpr std::uint32_t kBytes = 16'384;
  auto plant = area(kBytes, 24);
  MemoryDriver driver(area(kBytes, 24));
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    Bytes bytes(kBytes);
    for (int n = 1; !stop; ++n) {
      std::memset(bytes.data(), n & 0xFF, bytes.size());
      plant->inputs().write({0, 1}, bytes);
    }
  });
  Bytes inputs(kBytes);
  for (int read = 0; read < 2'000; ++read) {
    const Bytes before = inputs;
    const std::uint64_t held = driver.held_reads();
    driver.read_inputs(0, inputs);
    ASSERT_EQ(inputs, all(kBytes, std::to_integer<int>(inputs[0])));
    if (driver.held_reads() > held) {
      ASSERT_EQ(inputs, before);
    }
  }
  stop = true;
  writer.join();
}

// A writer that is killed in the middle leaves its newest complete write, at every instant.
TEST_F(IoMemory, WhenAWriterIsKilled_ThenItsNewestWriteIsWhole) {
  auto mine = area(16, 65'536);
  Bytes bytes(65'536);
  for (int round = 0; round < 50; ++round) {
    const pid_t child = fork();
    if (child == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      auto theirs = IoArea::open(name_, 16, 65'536);
      Bytes mem(65'536);
      for (std::uint64_t n = 1;; ++n) {
        std::memset(mem.data(), static_cast<int>(n & 0xFF), mem.size());
        (*theirs)->outputs().write({n, n}, mem);
      }
    }
    usleep(static_cast<useconds_t>(2'000 + 137 * round));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    SlotHeader header{};
    if (!mine->outputs().read(header, bytes)) continue;  // it had not yet begun
    ASSERT_EQ(header.generation, header.time_ns);
    ASSERT_EQ(bytes, all(65'536, static_cast<int>(header.generation & 0xFF)));
  }
}

TEST_F(IoMemory, WhenScansUseIt_ThenTheyNeitherAllocateNorLock) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns malloc";
  MemoryDriver driver(area());
  Bytes inputs(16);
  const Bytes outputs(24);
  driver.write_outputs(0, outputs);
  const support::GuardCounts before = support::guard_counts();
  for (int i = 0; i < 1'000; ++i) {
    driver.read_inputs(i, inputs);
    driver.write_outputs(i, outputs);
    driver.beat();
  }
  EXPECT_EQ(support::guard_counts(), before);
}

}  // namespace
}  // namespace stepwright::io_memory
