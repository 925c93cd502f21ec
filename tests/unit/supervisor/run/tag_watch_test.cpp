#include "supervisor/run/tag_watch.h"

#include <gtest/gtest.h>

#include <vector>

#include "ladder/driver/compile.h"

namespace stepwright::run {
namespace {

using Bytes = std::vector<std::byte>;

Bytes program_with(const std::string& variables) {
  auto output = driver::compile(
      {.texts = {{"main.st", "PROGRAM main\nVAR " + variables + " : BOOL; END_VAR\nEND_PROGRAM\n"}}});
  EXPECT_TRUE(output) << result::to_string(output.error());
  return output->container;
}

// An image in which exactly these are TRUE.
Bytes image_of(const Bytes& program, const std::vector<std::string>& on) {
  const auto info = reader::ProgramInfo::read(program).value();
  Bytes image(256);
  for (const std::string& each : on) image[info.find(each)->address] = std::byte{1};
  return image;
}

class TagWatchTest : public testing::Test {
 protected:
  TagWatch watch_{{{"main.a", "a failed"}, {"main.b", "b failed"}}};
  Bytes both_ = program_with("a, b"), other_ = program_with("z, b, a"), none_ = program_with("c");
};

TEST_F(TagWatchTest, WhenATagBecomesTrue_ThenItIsToldOnceWithItsEvidence) {
  watch_.begin(both_, false);
  EXPECT_FALSE(watch_.news(image_of(both_, {})));
  const auto first = watch_.news(image_of(both_, {"main.b"}));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->kind, IncidentKind::Monitor);
  EXPECT_EQ(first->evidence, (std::vector<std::string>{"b failed"}));
  EXPECT_EQ(first->signature, "main.b");
  EXPECT_FALSE(watch_.news(image_of(both_, {"main.b"})));
  EXPECT_EQ(watch_.news(image_of(both_, {"main.a", "main.b"}))->evidence.front(), "a failed");
}

TEST_F(TagWatchTest, WhenTheProgramGoesOnAsAnother_ThenWhatWasToldStaysTold) {
  watch_.begin(both_, false);
  EXPECT_TRUE(watch_.news(image_of(both_, {"main.a"})));
  watch_.begin(other_, true);
  EXPECT_FALSE(watch_.news(image_of(other_, {"main.a"})));
  watch_.begin(other_, false);
  EXPECT_TRUE(watch_.news(image_of(other_, {"main.a"})));
  watch_.begin(none_, true);
  EXPECT_FALSE(watch_.news(image_of(none_, {"main.c"})));
  watch_.begin(both_, true);
  EXPECT_TRUE(watch_.news(image_of(both_, {"main.a"}))) << "the program between has no such tag";
}

TEST_F(TagWatchTest, WhenTheImageIsShortOrTheBytesAreNoProgram_ThenNothingIsTold) {
  watch_.begin(both_, false);
  EXPECT_FALSE(watch_.news({}));
  watch_.begin({}, false);
  EXPECT_FALSE(watch_.news(image_of(both_, {"main.a"})));
  TagWatch none;
  none.begin(both_, false);
  EXPECT_FALSE(none.news(image_of(both_, {"main.a"})));
}

}  // namespace
}  // namespace stepwright::run
