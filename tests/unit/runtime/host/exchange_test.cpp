// What crosses between threads and processes: queue, cell, shared snapshot.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <thread>

#include "runtime/host/event_ring.h"
#include "runtime/host/limits.h"
#include "runtime/host/seq_cell.h"
#include "runtime/host/snapshot_memory.h"
#include "runtime/host/spsc_queue.h"

namespace stepwright::host {
namespace {

TEST(SpscQueue, WhenFull_ThenItRefusesAndKeepsOrder) {
  SpscQueue<int> queue(3);
  for (int i = 1; i <= 3; ++i) EXPECT_TRUE(queue.push(int{i}));
  EXPECT_FALSE(queue.push(4));
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_TRUE(queue.push(5));
  for (const int expected : {2, 3, 5}) EXPECT_EQ(queue.pop(), expected);
  EXPECT_FALSE(queue.pop());
}

TEST(SpscQueue, WhenTwoThreadsUseIt_ThenEveryValueArrivesOnceInOrder) {
  constexpr int kCount = 20'000;
  SpscQueue<int> queue(16);
  std::thread producer([&] {
    for (int i = 0; i < kCount; ++i) {
      while (!queue.push(int{i})) std::this_thread::yield();
    }
  });
  for (int i = 0; i < kCount; ++i) {
    std::optional<int> value;
    while (!(value = queue.pop())) std::this_thread::yield();
    ASSERT_EQ(*value, i);
  }
  producer.join();
}

TEST(SeqCell, WhenWrittenMeanwhile_ThenReadersSeeWholeValues) {
  SeqCell<std::array<std::uint64_t, 16>> cell;
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    std::array<std::uint64_t, 16> value{};
    while (!stop) {
      value.fill(value[0] + 1);
      cell.store(value);
      std::this_thread::yield();
    }
  });
  for (int i = 0; i < 2'000; ++i) {
    const auto value = cell.load();
    for (const std::uint64_t word : value) ASSERT_EQ(word, value[0]);
  }
  stop = true;
  writer.join();
}

std::unique_ptr<SnapshotWriter> writer_of(const std::vector<std::string>& names) {
  auto writer = SnapshotWriter::create(names);
  EXPECT_TRUE(writer);
  return writer ? std::move(*writer) : nullptr;
}

TEST(SnapshotMemory, WhenPublished_ThenReadersSeeExactlyThat) {
  const auto writer = writer_of({"level", "speed"});
  const auto reader = *SnapshotReader::open(writer->descriptor());
  EXPECT_FALSE(reader->read());
  std::vector<std::byte> image(13);
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = static_cast<std::byte>(i + 1);
  const std::array<double, 2> plant{1.5, -2.0};
  writer->publish(7, 60, std::string(64, 'a'), image, plant);
  const Snapshot expected{7, 60, std::string(64, 'a'), image, {{"level", 1.5}, {"speed", -2.0}}};
  EXPECT_EQ(reader->read(), expected);
  // Smaller after larger.
  writer->publish(8, 70, "b", std::span(image).first(1), plant);
  EXPECT_EQ(reader->read()->image.size(), 1u);
  EXPECT_EQ(reader->read()->program_digest, "b");
}

TEST(SnapshotMemory, WhenWrittenMeanwhile_ThenReadersSeeWholeSnapshots) {
  const auto writer = writer_of({});
  const auto reader = *SnapshotReader::open(writer->descriptor());
  std::atomic<bool> stop{false};
  std::thread publisher([&] {
    std::vector<std::byte> image(333);
    for (std::uint64_t scan = 1; !stop; ++scan) {
      std::fill(image.begin(), image.end(), static_cast<std::byte>(scan));
      writer->publish(scan, 0, "", image, {});
      std::this_thread::yield();
    }
  });
  int whole = 0;
  while (whole < 500) {
    const auto snapshot = reader->read();
    if (!snapshot) continue;
    ++whole;
    for (const std::byte byte : snapshot->image) ASSERT_EQ(byte, static_cast<std::byte>(snapshot->scan));
  }
  stop = true;
  publisher.join();
}

TEST(SnapshotMemory, WhenPartsAreRead_ThenTheyAreThoseOfTheImage) {
  const auto writer = writer_of({"level"});
  const auto reader = *SnapshotReader::open(writer->descriptor());
  const auto nothing = [](const SnapshotView&) { ADD_FAILURE() << "there is no snapshot"; };
  EXPECT_FALSE(reader->consistent(nothing));
  std::vector<std::byte> image(45);
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = static_cast<std::byte>(i + 1);
  const std::array<double, 1> plant{1.5};
  writer->publish(7, 60, std::string(64, 'a'), image, plant);
  const std::uint64_t first = reader->sequence();
  std::array<std::byte, 64> room;
  for (std::size_t offset = 0; offset <= image.size(); ++offset) {
    for (std::size_t size = 0; offset + size <= image.size() + 1; ++size) {
      const auto part = std::span(room).first(size);
      bool inside = false;
      ASSERT_TRUE(reader->consistent([&](const SnapshotView& view) { inside = view.load(offset, part); }));
      ASSERT_EQ(inside, offset + size <= image.size());
      if (!inside) continue;
      ASSERT_TRUE(std::equal(part.begin(), part.end(), image.begin() + static_cast<int>(offset)));
    }
  }
  ASSERT_TRUE(reader->consistent([](const SnapshotView& view) {
    EXPECT_TRUE(view.is_of(std::string(64, 'a')));
    EXPECT_FALSE(view.is_of(std::string(63, 'a')));
    EXPECT_FALSE(view.is_of(std::string(63, 'a') + "b"));
    EXPECT_EQ(view.scan(), 7u);
  }));
  writer->publish(8, 70, "b", image, plant);
  EXPECT_GT(reader->sequence(), first);
  ASSERT_TRUE(reader->consistent([](const SnapshotView& view) { EXPECT_TRUE(view.is_of("b")); }));
}

TEST(SnapshotMemory, WhenPartsAreReadMeanwhile_ThenTheyAreOfOneSnapshot) {
  const auto writer = writer_of({});
  const auto reader = *SnapshotReader::open(writer->descriptor());
  std::atomic<bool> stop{false};
  std::thread publisher([&] {
    std::vector<std::byte> image(5'000);
    for (std::uint64_t scan = 1; !stop; ++scan) {
      std::fill(image.begin(), image.end(), static_cast<std::byte>(scan));
      writer->publish(scan, 0, "", image, {});
      std::this_thread::yield();
    }
  });
  int whole = 0;
  while (whole < 2'000) {
    std::array<std::byte, 20> front;
    std::array<std::byte, 20> back;
    std::uint64_t scan = 0;
    const auto parts = [&](const SnapshotView& view) {
      scan = view.scan();
      static_cast<void>(view.load(3, front) && view.load(4'970, back));
    };
    if (!reader->consistent(parts)) continue;
    ++whole;
    for (const std::byte byte : front) ASSERT_EQ(byte, static_cast<std::byte>(scan));
    for (const std::byte byte : back) ASSERT_EQ(byte, static_cast<std::byte>(scan));
  }
  stop = true;
  publisher.join();
}

// The largest image, by a writer that stops for a millisecond at most: each read comes to its end.
TEST(SnapshotMemory, WhenLargeImagesArePublishedFast_ThenNoReadFails) {
  const auto writer = writer_of({});
  const auto reader = *SnapshotReader::open(writer->descriptor());
  std::vector<std::byte> image(kMaxImageBytes);
  const auto publish = [&](std::uint64_t scan) {
    image.front() = image[kMaxImageBytes / 2] = image.back() = static_cast<std::byte>(scan);
    writer->publish(scan, 0, "", image, {});
  };
  publish(1);
  std::atomic<bool> stop{false};
  std::thread publisher([&] {
    for (std::uint64_t scan = 2; !stop; ++scan) {
      publish(scan);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  for (int read = 0; read < 300; ++read) {
    const auto snapshot = reader->read();
    ASSERT_TRUE(snapshot) << "read " << read;
    const auto scan = static_cast<std::byte>(snapshot->scan);
    ASSERT_EQ(snapshot->image.front(), scan);
    ASSERT_EQ(snapshot->image[kMaxImageBytes / 2], scan);
    ASSERT_EQ(snapshot->image.back(), scan);
  }
  stop = true;
  publisher.join();
}

// A writer that is killed in the middle of a snapshot leaves the one before.
TEST(SnapshotMemory, WhenTheWriterIsKilled_ThenItsNewestSnapshotStays) {
  for (int round = 0; round < 6; ++round) {
    const auto writer = writer_of({});
    const auto reader = *SnapshotReader::open(writer->descriptor());
    std::vector<std::byte> image(kMaxImageBytes);
    writer->publish(1, 0, "", image, {});
    const pid_t child = fork();
    if (child == 0) {
      for (std::uint64_t scan = 2;; ++scan) {
        image.front() = image.back() = static_cast<std::byte>(scan);
        writer->publish(scan, 0, "", image, {});
      }
    }
    while (reader->sequence() < 3) std::this_thread::yield();
    usleep(static_cast<useconds_t>(137 * round));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const auto snapshot = reader->read();
    ASSERT_TRUE(snapshot);
    EXPECT_EQ(snapshot->image.front(), static_cast<std::byte>(snapshot->scan));
    EXPECT_EQ(snapshot->image.back(), static_cast<std::byte>(snapshot->scan));
  }
}

TEST(EventRing, WhenItIsFullOfStepChanges_ThenATrapHasRoom) {
  EventRing ring(1, 0);
  const std::vector<std::byte> image(1);
  const auto push = [&](EventKind kind) {
    EventNote note;
    note.kind = kind;
    return ring.push(note, image, {});
  };
  std::size_t steps = 0;
  while (push(EventKind::StepChange)) ++steps;
  EXPECT_GT(steps, 10u);
  EXPECT_TRUE(ring.full());
  EXPECT_TRUE(push(EventKind::Changed));
  EXPECT_FALSE(push(EventKind::Stopped));
  EXPECT_TRUE(push(EventKind::Trap));
  EXPECT_FALSE(push(EventKind::RolledBack));
  for (std::size_t i = 0; i < steps; ++i) ring.pop();
  ASSERT_NE(ring.front(), nullptr);
  EXPECT_EQ(ring.front()->note.kind, EventKind::Changed);
  ring.pop();
  EXPECT_EQ(ring.front()->note.kind, EventKind::Trap);
  ring.pop();
  EXPECT_EQ(ring.front(), nullptr);
  EXPECT_FALSE(ring.full());
}

TEST(SnapshotMemory, WhenAClientTriesToWriteOrShrinkIt_ThenTheSystemRefuses) {
  const auto writer = writer_of({});
  const int descriptor = writer->descriptor();
  EXPECT_LT(::ftruncate(descriptor, 0), 0);
  EXPECT_EQ(mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0), MAP_FAILED);
  const int again = ::open(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), O_RDWR);
  if (again >= 0) {
    EXPECT_EQ(mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, again, 0), MAP_FAILED);
    EXPECT_LT(::ftruncate(again, 0), 0);
    ::close(again);
  }
}

TEST(SnapshotMemory, WhenTheDescriptorIsSomethingElse_ThenItIsRefused) {
  const int descriptor = memfd_create("other", MFD_CLOEXEC);
  EXPECT_EQ(SnapshotReader::open(descriptor).error().front().code, "R0005");
  EXPECT_EQ(SnapshotReader::open(-1).error().front().code, "R0005");
  ::close(descriptor);
}

TEST(SnapshotMemory, WhenThePlantHasTooManyValues_ThenItIsRefused) {
  const std::vector<std::string> many(kMaxPlantValues + 1, "x");
  EXPECT_EQ(SnapshotWriter::create(many).error().front().code, "R0081");
  const std::vector<std::string> name{std::string(kMaxNameBytes + 1, 'x')};
  const auto refused = SnapshotWriter::create(name);
  EXPECT_EQ(refused.error().front().code, "R0081");
  EXPECT_NE(refused.error().front().message.find("has a name of 65 bytes; 64 are possible"),
            std::string::npos);
}

}  // namespace
}  // namespace stepwright::host
