#include "cell/runtime/plant_memory.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>

namespace stepwright::cell_runtime {
namespace {

class PlantMemoryTest : public testing::Test {
 protected:
  PlantMemoryTest() { std::filesystem::remove(file_); }
  ~PlantMemoryTest() override { std::filesystem::remove(file_); }
  // Of this process alone: each case runs in its own, several at a time.
  const std::filesystem::path file_ = testing::TempDir() + "plant.state." + std::to_string(getpid());
};

TEST_F(PlantMemoryTest, WhenTheFileIsNew_ThenNothingWasLeft) {
  auto memory = PlantMemory::open(file_, 5);
  ASSERT_TRUE(memory.has_value());
  EXPECT_FALSE((*memory)->left_behind().has_value());
}

TEST_F(PlantMemoryTest, WhenTheProcessIsKilled_ThenTheNextOneFindsACompleteState) {
  const pid_t child = fork();
  if (child == 0) {
    auto memory = PlantMemory::open(file_, 5);
    for (double v = 0.0;; v = v < 99.0 ? v + 1.0 : 0.0) (*memory)->keep(std::array{0.5, v, v, v, v});
  }
  while (!std::filesystem::exists(file_) || std::filesystem::file_size(file_) == 0) usleep(1'000);
  usleep(20'000);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  auto memory = PlantMemory::open(file_, 5);
  ASSERT_TRUE(memory.has_value());
  const auto left = (*memory)->left_behind();
  ASSERT_TRUE(left.has_value());
  EXPECT_EQ((*left)[0], 0.5);
  for (std::size_t i = 2; i < left->size(); ++i) EXPECT_EQ((*left)[i], (*left)[1]);
}

TEST_F(PlantMemoryTest, WhenItEndsCleanly_ThenNothingIsLeft) {
  (*PlantMemory::open(file_, 5))->keep(std::array{0.0, 1.0, 2.0, 3.0, 4.0});
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(PlantMemoryTest, WhenItEndsBeforeTheFirstScan_ThenNothingIsLeft) {
  ASSERT_TRUE(PlantMemory::open(file_, 5).has_value());
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(PlantMemoryTest, WhenAnotherRuntimeHasTheFile_ThenItStaysUntilThatOneEnds) {
  auto first = PlantMemory::open(file_, 5);
  ASSERT_TRUE(first.has_value());
  ASSERT_TRUE(PlantMemory::open(file_, 5).has_value());
  EXPECT_TRUE(std::filesystem::exists(file_));
  first->reset();
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(PlantMemoryTest, WhenTheFileIsGarbage_ThenNothingWasLeft) {
  std::ofstream(file_) << std::string(200, 'x');
  EXPECT_FALSE((*PlantMemory::open(file_, 5))->left_behind().has_value());
}

TEST_F(PlantMemoryTest, WhenTheFileIsOfAnotherPlant_ThenNothingWasLeft) {
  auto first = PlantMemory::open(file_, 5);
  (*first)->keep(std::array{0.5, 1.0, 2.0, 3.0, 4.0});
  EXPECT_TRUE((*PlantMemory::open(file_, 5))->left_behind().has_value());
  EXPECT_FALSE((*PlantMemory::open(file_, 7))->left_behind().has_value());
}

TEST_F(PlantMemoryTest, WhenTheFolderIsMissing_ThenTheErrorNamesTheFile) {
  const auto memory = PlantMemory::open("/nonexistent/plant.state", 5);
  ASSERT_FALSE(memory.has_value());
  EXPECT_EQ(memory.error()[0].where.file, "/nonexistent/plant.state");
}

}  // namespace
}  // namespace stepwright::cell_runtime
