#include "hmi_web/server/cell_viewer.h"

#include <gtest/gtest.h>

#include "hmi_web/server/image_value.h"
#include "runtime/bytecode/value_type.h"

namespace stepwright::server {
namespace {

using bytecode::ElementaryType;
using bytecode::kNoBit;

std::vector<std::byte> bytes(std::initializer_list<int> values) {
  std::vector<std::byte> result;
  for (const int value : values) result.push_back(static_cast<std::byte>(value));
  return result;
}

// Two input bytes, two output bytes, two step bytes, a transition byte.
std::shared_ptr<ProgramLayout> small_layout() {
  auto layout = std::make_shared<ProgramLayout>();
  layout->program.digest = "ab";
  layout->output_offset = 2;
  layout->program.steps = {{"START", "", true}, {"S1", "", false}};
  layout->steps = {{ElementaryType::Bool, 4, kNoBit}, {ElementaryType::Bool, 5, kNoBit}};
  layout->program.transitions = {{"T0", {0}, {1}, "fc1"}, {"T1", {1}, {0}, "fc1"}};
  layout->transitions = {reader::Variable{ElementaryType::Bool, 6, kNoBit}, std::nullopt};
  layout->program.tags = {{"fc1", "BOOL", "%IX0.1"}, {"plan.S1_filtered", "INT", ""}};
  layout->tags = {{ElementaryType::Bool, 0, 1}, {ElementaryType::Int, 2, kNoBit}};
  return layout;
}

Observation running(std::vector<std::byte> image) {
  Observation seen;
  seen.runtime_alive = true;
  seen.layout = small_layout();
  seen.snapshot = ImageSnapshot{12, 0.11, std::move(image), {{"level_a1_percent", 47.5}}};
  return seen;
}

TEST(CellViewer, WhenAnImageIsSeen_ThenStepsTransitionsAndTagsAreReadFromIt) {
  CellViewer viewer({});

  const auto state = viewer.view(running(bytes({0b10, 0, 0xFE, 0xFF, 0, 1, 1}))).state;

  EXPECT_EQ(state.active_steps, std::vector<std::uint32_t>{1});
  EXPECT_EQ(state.true_transitions, std::vector<std::uint32_t>{0});
  EXPECT_EQ(state.tags[0], 1.0);
  EXPECT_EQ(state.tags[1], -2.0);
  EXPECT_EQ(state.scan, 12u);
}

TEST(CellViewer, WhenVariablesAreReals_ThenTheyAreNamedAsThat) {
  Observation seen = running(bytes({0, 0, 0, 0, 0, 0, 0}));
  auto layout = small_layout();
  layout->tags[1].type = ElementaryType::Real;
  seen.layout = layout;
  CellViewer viewer({});
  EXPECT_EQ(viewer.view(seen).state.reals, std::vector<std::uint32_t>{1});
}

// A STRING[4], a WSTRING[2] and a DATE.
TEST(CellViewer, WhenVariablesAreTexts_ThenTheyAreReadAsTextAndHaveNoNumber) {
  auto layout = std::make_shared<ProgramLayout>();
  layout->program.tags = {
      {"word", "STRING", ""}, {"wide", "WSTRING", ""}, {"day", "DATE", ""}, {"n", "INT", ""}};
  layout->tags = {{ElementaryType::String, 0, kNoBit},
                  {ElementaryType::Wstring, 8, kNoBit},
                  {ElementaryType::Date, 16, kNoBit},
                  {ElementaryType::Int, 0, kNoBit}};
  Observation seen =
      running(bytes({4, 0, 2, 0, 'h', 0xFC, 0, 0, 2, 0, 1, 0, 0xAC, 0x20, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  seen.layout = layout;
  CellViewer viewer({});

  const auto state = viewer.view(seen).state;

  using Texts = std::map<std::uint32_t, std::string>;
  EXPECT_EQ(state.texts, (Texts{{0, "h\xC3\xBC"}, {1, "\xE2\x82\xAC"}, {2, "D#1970-01-01"}}));
  EXPECT_FALSE(state.tags[0].has_value());
  EXPECT_EQ(state.tags[3], 4.0);

  seen.snapshot->image.resize(2);
  EXPECT_TRUE(viewer.view(seen).state.texts.empty()) << "the image is shorter than the program says";
}

TEST(ImageValue, WhenAnIntegerHasMoreDigitsThanADouble_ThenItIsReadAsText) {
  const std::vector<std::byte> image = bytes(
      {1, 0, 0, 0, 0, 0, 0x20, 0, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0, 0, 0, 0, 0x20, 0});
  EXPECT_EQ(read_text({ElementaryType::Lint, 0, kNoBit}, image), "9007199254740993");
  EXPECT_EQ(read_text({ElementaryType::Ulint, 8, kNoBit}, image), "18446744073709551615");
  EXPECT_FALSE(read_text({ElementaryType::Lint, 8, kNoBit}, image).has_value()) << "-1";
  EXPECT_FALSE(read_text({ElementaryType::Lint, 16, kNoBit}, image).has_value()) << "a double has 2^53";
  EXPECT_FALSE(read_text({ElementaryType::Ulint, 20, kNoBit}, image).has_value()) << "behind the image";
  EXPECT_FALSE(read_text({ElementaryType::Dint, 0, kNoBit}, image).has_value());
}

TEST(ImageValue, WhenItIsATime_ThenItIsInSeconds) {
  const std::vector<std::byte> image = bytes({0x80, 0x2B, 0x2B, 0x59, 0, 0, 0, 0});  // 1496 ms and some
  const auto value = read({ElementaryType::Time, 0, kNoBit}, image);
  ASSERT_TRUE(value.has_value());
  EXPECT_DOUBLE_EQ(*value, 1.496001408);
  EXPECT_DOUBLE_EQ(*read({ElementaryType::Lint, 0, kNoBit}, image), 1'496'001'408);
}

TEST(ImageValue, WhenATextIsLong_ThenItIsCutAtTheEndOfACharacter) {
  std::vector<std::byte> image = bytes({0, 2, 0, 1});  // 512 characters, of them 256
  image.resize(516, std::byte{0xFC});
  const auto text = read_text({ElementaryType::String, 0, kNoBit}, image);
  ASSERT_TRUE(text.has_value());
  EXPECT_EQ(text->size(), kMostTextBytes + 3);
  EXPECT_TRUE(text->ends_with("\xC3\xBC\xE2\x80\xA6"));
}

TEST(CellViewer, WhenTheImageIsShorterThanTheProgramSays_ThenTheMissingValuesAreUnknown) {
  CellViewer viewer({});

  const auto state = viewer.view(running(bytes({0b10, 0, 7}))).state;

  EXPECT_EQ(state.tags[0], 1.0);
  EXPECT_FALSE(state.tags[1].has_value());
  EXPECT_TRUE(state.active_steps.empty());
}

TEST(CellViewer, WhenAPointHasSources_ThenTheFirstWithAValueIsScaled) {
  CellViewer viewer({{{PointSourceKind::Tag, "no_such_tag"}, {PointSourceKind::Tag, "s1_FILTERED", 0.5, 10}},
                     {{PointSourceKind::Address, "%QX0.0"}},
                     {{PointSourceKind::PlantTruth, "level_a1_percent"}},
                     {{PointSourceKind::PlantTruth, "no such truth"}}});

  const auto state = viewer.view(running(bytes({0, 0, 1, 1, 0, 0, 0}))).state;

  ASSERT_EQ(state.points.size(), 4u);
  EXPECT_EQ(state.points[0], 0.5 * 257 + 10);
  EXPECT_EQ(state.points[1], 1.0);
  EXPECT_EQ(state.points[2], 47.5);
  EXPECT_FALSE(state.points[3].has_value());
}

// fc1 is a bit of the word at %IW0; the level is filtered, and its raw counts are an input.
TEST(CellViewer, WhenTagsShareAPlaceWithAPoint_ThenTheyAreTold) {
  CellViewer viewer(
      {{{PointSourceKind::Address, "%IX0.1"}},
       {{PointSourceKind::Address, "%IX0.2"}},
       {{PointSourceKind::Tag, "S1_filtered"}, {PointSourceKind::Address, "%IW0"}},
       {{PointSourceKind::Tag, "no_such_tag"}, {PointSourceKind::PlantTruth, "level_a1_percent"}}});

  const auto view = viewer.view(running(bytes({0, 0, 0, 0, 0, 0, 0})));

  ASSERT_NE(view.points, nullptr);
  EXPECT_EQ(*view.points, (protocol::PointTags{{0}, {}, {0, 1}, {}}));
}

TEST(CellViewer, WhenASensorHasATare_ThenItIsSubtractedFromItsCounts) {
  CellViewer viewer({{{PointSourceKind::Tag, "S1_filtered", 0.5, 10, "S1"}},
                     {{PointSourceKind::Tag, "S1_filtered", 0.5, 10, "S2"}},
                     {{PointSourceKind::Tag, "S1_filtered", 0.5, 10}}});
  Observation seen = running(bytes({0, 0, 1, 1, 0, 0, 0}));
  seen.tare = {{"", 1000}, {"s1", 57}};

  const auto state = viewer.view(seen).state;

  EXPECT_EQ(state.points[0], 0.5 * 200 + 10);
  EXPECT_EQ(state.points[1], 0.5 * 257 + 10);
  EXPECT_EQ(state.points[2], 0.5 * 257 + 10);
}

// fc1 lies in the word at %IW0, as does the raw count of the first point.
TEST(CellViewer, WhenADeviceDoesNotAnswer_ThenItsTagsAreNamedAndItsPointsHaveNoValue) {
  CellViewer viewer({{{PointSourceKind::Tag, "S1_filtered"}, {PointSourceKind::Address, "%IW0"}},
                     {{PointSourceKind::Address, "%QX0.0"}},
                     {{PointSourceKind::PlantTruth, "level_a1_percent"}}});
  Observation seen = running(bytes({0b10, 0, 1, 1, 0, 0, 0}));
  seen.layout = small_layout();
  seen.unread = {{"tank", protocol::Unread::Lost, {{ElementaryType::Int, 0, kNoBit}}},
                 {"spare", protocol::Unread::Never, {{ElementaryType::Int, 40, kNoBit}}}};

  auto state = viewer.view(seen).state;

  using Devices = std::vector<protocol::UnreadDevice>;
  EXPECT_EQ(state.unread,
            (Devices{{"tank", protocol::Unread::Lost, {0}}, {"spare", protocol::Unread::Never, {}}}));
  EXPECT_EQ(state.tags[0], 1.0) << "what the program works with";
  EXPECT_FALSE(state.points[0].has_value());
  EXPECT_EQ(state.points[1], 1.0);
  EXPECT_EQ(state.points[2], 47.5);

  seen.unread.resize(1);
  seen.unread[0].why = protocol::Unread::Never;
  EXPECT_EQ(viewer.view(seen).state.unread, (Devices{{"tank", protocol::Unread::Never, {0}}}));
  seen.unread.clear();
  state = viewer.view(seen).state;
  EXPECT_TRUE(state.unread.empty());
  EXPECT_EQ(state.points[0], 257.0);
}

TEST(CellViewer, WhenTheProgramChangesWhileADeviceIsLost_ThenTheTagsOfTheNewOneAreNamed) {
  CellViewer viewer({});
  Observation seen = running(bytes({0b10, 0, 1, 1, 0, 0, 0}));
  seen.unread = {{"tank", protocol::Unread::Lost, {{ElementaryType::Int, 0, kNoBit}}}};
  EXPECT_EQ(viewer.view(seen).state.unread.at(0).tags, std::vector<std::uint32_t>{0});
  auto next = small_layout();
  std::swap(next->program.tags[0], next->program.tags[1]);
  std::swap(next->tags[0], next->tags[1]);
  seen.layout = next;
  EXPECT_EQ(viewer.view(seen).state.unread.at(0).tags, std::vector<std::uint32_t>{1});
  seen.layout = nullptr;
  EXPECT_TRUE(viewer.view(seen).state.unread.empty());
}

TEST(CellViewer, WhenNothingIsThere_ThenEveryPointIsUnknown) {
  CellViewer viewer({{{PointSourceKind::Tag, "fc1"}}});

  const auto view = viewer.view({});

  EXPECT_FALSE(view.state.runtime_alive);
  EXPECT_EQ(view.layout, nullptr);
  EXPECT_EQ(view.points, nullptr);
  ASSERT_EQ(view.state.points.size(), 1u);
  EXPECT_FALSE(view.state.points[0].has_value());
}

TEST(FindTag, WhenTheLastPartIsAmbiguous_ThenOnlyTheWholeNameFinds) {
  ProgramLayout layout;
  layout.program.tags = {{"a.x", "BOOL", ""}, {"b.x", "BOOL", ""}, {"c.x", "BOOL", ""}, {"b.y", "BOOL", ""}};
  for (std::uint32_t i = 0; i < 4; ++i) layout.tags.push_back({ElementaryType::Bool, i, kNoBit});

  EXPECT_FALSE(find_tag(layout, "x").has_value());
  EXPECT_EQ(find_tag(layout, "B.X")->address, 1u);
  EXPECT_EQ(find_tag(layout, "Y")->address, 3u);
}

TEST(VariableAt, WhenTheAddressIsInAnIoArea_ThenItIsFound) {
  EXPECT_EQ(variable_at("%IX0.2", 64)->bit, 2);
  EXPECT_EQ(variable_at("%IW1", 64)->address, 2u);
  EXPECT_EQ(variable_at("%QX1.0", 64)->address, 65u);
  EXPECT_EQ(variable_at("%QD2", 64)->address, 72u);
}

TEST(VariableAt, WhenTheAddressIsNone_ThenNothingIsFound) {
  for (const char* text : {"", "%", "%I", "%IX", "%IX0.", "%IX0.8", "%IX0.1x", "%MX0.0", "%IW", "%IW1.2",
                           "%IW99999999999999999999", "%IZ1", "IX0.0", "%IX.1", "%IW-1"}) {
    EXPECT_FALSE(variable_at(text, 64).has_value()) << text;
  }
  EXPECT_TRUE(variable_at("%IX0", 64).has_value());
}

}  // namespace
}  // namespace stepwright::server
