#include "runtime/host/memory_limit.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace stepwright::host {
namespace {

constexpr std::uint64_t kMb = 1u << 20;

// What the system says of a process in the group /outer/inner.
class System {
 public:
  System() {
    std::filesystem::create_directories(folder_.path() / "process");
    std::filesystem::create_directories(folder_.path() / "groups/outer/inner");
    write("process/cgroup", "0::/outer/inner\n");
    write("process/status", "Name:\trt\nVmSize:\t  1000 kB\nVmRSS:\t 2048 kB\nVmLck:\t       0 kB\n");
  }
  void write(const char* file, const std::string& text) { std::ofstream(folder_.path() / file) << text; }
  MemorySources sources() const { return {folder_.path() / "process", folder_.path() / "groups"}; }

 private:
  support::TemporaryFolder folder_;
};

TEST(MemoryLimit, WhenTheOuterGroupIsTighter_ThenItsRestIsTheRoom) {
  System system;
  system.write("groups/outer/inner/memory.max", "max\n");
  system.write("groups/outer/memory.max", std::to_string(256 * kMb));
  system.write("groups/outer/memory.current", std::to_string(100 * kMb));
  system.write("groups/outer/memory.stat", "anon 1\ninactive_file " + std::to_string(30 * kMb) +
                                               "\nactive_file " + std::to_string(10 * kMb) + "\n");
  const auto room = memory_limit(0, system.sources());
  ASSERT_TRUE(room);
  EXPECT_EQ(room->limit_bytes, 256 * kMb);
  EXPECT_EQ(room->free_bytes, 196 * kMb) << "pages of files can be taken back";
}

TEST(MemoryLimit, WhenTheConfigurationIsTighter_ThenItCounts) {
  System system;
  system.write("groups/outer/inner/memory.max", std::to_string(256 * kMb));
  system.write("groups/outer/inner/memory.current", std::to_string(2 * kMb));
  const auto room = memory_limit(10 * kMb, system.sources());
  ASSERT_TRUE(room);
  EXPECT_EQ(room->free_bytes, 8 * kMb);
}

TEST(MemoryLimit, WhenMoreIsNeededThanThereIs_ThenTheRefusalNamesBothFigures) {
  System system;
  system.write("groups/outer/inner/memory.max", std::to_string(64 * kMb));
  system.write("groups/outer/inner/memory.current", std::to_string(44 * kMb));
  EXPECT_TRUE(check_memory({.code_bytes = 1'000, .image_bytes = 1'000}, 0, system.sources()));
  const MemoryNeed large{.code_bytes = 6u << 20, .image_bytes = 10'000, .threads = 17};
  const auto refused = check_memory(large, 0, system.sources());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error()[0].code, "R0076");
  const std::string& text = refused.error()[0].message;
  EXPECT_NE(text.find("64 MB"), std::string::npos) << text;
  EXPECT_NE(text.find("20 MB are free"), std::string::npos) << text;
}

TEST(MemoryLimit, WhenAProgramHasMoreThreadsOrCode_ThenItTakesMore) {
  const MemoryNeed small{.code_bytes = 1u << 20, .image_bytes = 1u << 16};
  MemoryNeed more = small;
  more.threads = 8;
  EXPECT_GT(needed_bytes(more), needed_bytes(small));
  more = small;
  more.code_bytes *= 2;
  EXPECT_GT(needed_bytes(more), needed_bytes(small));
  EXPECT_LT(needed_bytes({.code_bytes = small.code_bytes, .image_bytes = small.image_bytes, .native = false}),
            needed_bytes(small));
}

}  // namespace
}  // namespace stepwright::host
