#include "cell/campaign/printed.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace stepwright::campaign {
namespace {

std::string last_of(const std::string& text) {
  const support::TemporaryFolder folder;
  const auto file = folder.path() / "plant.log";
  std::ofstream(file, std::ios::binary) << text;
  return last_lines(file);
}

TEST(Printed, WhenThereIsNoFile_ThenThereAreNoLines) {
  EXPECT_EQ(last_lines("/no/such/file"), "");
  EXPECT_EQ(last_of(""), "");
  EXPECT_EQ(last_of("\n\n"), "");
}

TEST(Printed, WhenThereAreFewLines_ThenAllAreThere) {
  EXPECT_EQ(last_of("one\n"), "one");
  EXPECT_EQ(last_of("one\n  two\x1b[1m\n"), "one\n  two [1m");
}

TEST(Printed, WhenThereAreMany_ThenTheLastOnesAre) {
  std::string all, last;
  for (int i = 0; i < 1'000; ++i) all += "line " + std::to_string(i) + "\n";
  for (int i = 992; i < 1'000; ++i) last += (i == 992 ? "line " : "\nline ") + std::to_string(i);
  EXPECT_EQ(last_of(all), last);
  EXPECT_EQ(last_of(std::string(100'000, 'x')).size(), 2'000u);
}

}  // namespace
}  // namespace stepwright::campaign
