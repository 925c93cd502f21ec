// Files of robots, scenes, requests and cells, and thousands of mutations of them, through their readers:
// each is read, or refused with a code, words and its file.
//
// Longer: STEPWRIGHT_FUZZ_SEED=7 STEPWRIGHT_FUZZ_ROUNDS=50000 fuzz_arms_mutation.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "supervisor/motion/kinematics/link_frames.h"
#include "supervisor/motion/moveit/moveit_request.h"
#include "supervisor/motion/moveit/moveit_scene.h"
#include "supervisor/motion/robot/srdf_reader.h"
#include "supervisor/motion/robot/urdf_reader.h"
#include "supervisor/motion/scene/scene_file.h"
#include "supervisor/tamp/scene/cell_file.h"
#include "tests/fuzz/corpus.h"
#include "tests/fuzz/text_mutation.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::fuzz::arms {
namespace {

namespace fs = std::filesystem;

const fs::path kCell = fs::path(STEPWRIGHT_SOURCE_DIR) / "tests/cells/robot_cell";

const std::vector<std::string> kPieces = {"0",
                                          "-1",
                                          "1e308",
                                          "-1e308",
                                          "1e-300",
                                          "1e6",
                                          "0.1",
                                          "7",
                                          "NaN",
                                          "inf",
                                          "1e999",
                                          "\"\"",
                                          "[",
                                          "]",
                                          "{",
                                          "}",
                                          "=",
                                          ",",
                                          ":",
                                          "<",
                                          "/>",
                                          "<joint>",
                                          "</link>",
                                          "\"",
                                          "'",
                                          "\xff",
                                          "&amp;",
                                          "left_tcp",
                                          "left_arm",
                                          "true",
                                          "[[box]]",
                                          "[0, 0, 0]",
                                          "null",
                                          "- ",
                                          "\n  - {}",
                                          "revolute",
                                          "left_joint_1",
                                          "base_link",
                                          "mesh",
                                          "table",
                                          "\t",
                                          "1 2 3 4 5",
                                          "*a",
                                          "&a ",
                                          "!!binary",
                                          "cylinder",
                                          "<mimic/>",
                                          "4294967296",
                                          "-0.0",
                                          "\n"};

// An input, and what of it is refused; nothing: it was read.
using Reader = std::function<result::Diagnostics(const std::string&)>;

template <typename T>
result::Diagnostics refused(const result::Result<T>& read) {
  return read ? result::Diagnostics{} : read.error();
}

void expect_whole(const result::Diagnostics& found, const std::string& input) {
  for (const result::Diagnostic& each : found)
    EXPECT_TRUE(each.code.size() == 5 && !each.message.empty() && !each.where.file.empty())
        << to_string(found) << "\n"
        << input;
}

void fuzz(const std::string& text, std::uint64_t rounds, const Reader& read) {
  ASSERT_TRUE(read(text).empty()) << to_string(read(text));
  rounds = setting("STEPWRIGHT_FUZZ_ROUNDS", rounds);
  TextMutation mutation(setting("STEPWRIGHT_FUZZ_SEED", 1), kPieces);
  std::size_t good = 0;
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::string broken = mutation.mutated(text);
    const result::Diagnostics found = read(broken);
    expect_whole(found, broken);
    good += found.empty();
  }
  std::printf("%zu of %llu were read\n", good, static_cast<unsigned long long>(rounds));
  EXPECT_GT(good, 0u);
  EXPECT_LT(good, rounds);
}

const motion::Robot& robot() {
  static const motion::Robot read =
      motion::read_urdf(content(kCell / "two_arms.urdf"), "two_arms.urdf").value();
  return read;
}

TEST(ArmFiles, WhenRobotsAreMutated_ThenTheyAreRefusedOrStandSomewhere) {
  fuzz(content(kCell / "two_arms.urdf"), 1'500, [](const std::string& text) {
    const auto read = motion::read_urdf(text, "broken.urdf");
    if (!read) return read.error();
    std::vector<motion::Transform> frames(read->links.size());
    const std::vector<double> rest(read->coordinates.size(), 0.0);
    motion::LinkFrames(*read).place(rest, frames);
    for (const motion::Transform& each : frames) EXPECT_TRUE(std::isfinite(length(each.position_m))) << text;
    return result::Diagnostics{};
  });
}

TEST(ArmFiles, WhenSemanticsAreMutated_ThenTheyAreReadOrRefused) {
  fuzz(content(kCell / "two_arms.srdf"), 1'500,
       [](const std::string& text) { return refused(motion::read_srdf(text, "broken.srdf", robot())); });
}

TEST(ArmFiles, WhenScenesAreMutated_ThenTheyAreReadOrRefused) {
  fuzz(content(kCell / "table.toml"), 2'000,
       [](const std::string& text) { return refused(motion::read_scene(text, "broken.toml", kCell)); });
}

TEST(ArmFiles, WhenRequestsOfMoveItAreMutated_ThenTheyAreReadOrRefused) {
  fuzz(content(kCell / "swing.yaml"), 2'000,
       [](const std::string& text) { return refused(motion::read_moveit_request(text, "broken.yaml")); });
}

constexpr const char* kMoveItScene = R"(name: shelf
world:
  collision_objects:
    - id: board
      primitives: [{type: box, dimensions: [0.6, 0.4, 0.02]}]
      primitive_poses: [{position: [0.5, 0, 0.7], orientation: [0, 0, 0, 1]}]
    - id: can
      primitives: [{type: cylinder, dimensions: [0.12, 0.035]}, {type: sphere, dimensions: [0.04]}]
      primitive_poses:
        - {position: [0.5, 0, 0.78], orientation: [0, 0, 0, 1]}
        - {position: [0.5, 0, 0.86], orientation: [0, 0, 0, 1]}
)";

TEST(ArmFiles, WhenScenesOfMoveItAreMutated_ThenTheyAreReadOrRefused) {
  fuzz(kMoveItScene, 2'000,
       [](const std::string& text) { return refused(motion::read_moveit_scene(text, "broken.yaml")); });
}

// A cell that is read gets its spheres, which takes a while: few rounds.
TEST(ArmFiles, WhenCellsAreMutated_ThenTheyAreReadOrRefused) {
  const support::TemporaryFolder folder;
  for (const char* name : {"two_arms.urdf", "two_arms.srdf", "p1.hddl"})
    fs::copy_file(kCell / name, folder / name);
  std::string text = content(kCell / "tamp_p1.toml");
  const std::string domain = "../htn/";
  text.replace(text.find(domain), domain.size(), "");
  fuzz(text, 60, [&](const std::string& broken) {
    std::ofstream(folder / "broken.toml", std::ios::binary) << broken;
    return refused(tamp::scene::load_cell(folder / "broken.toml"));
  });
}

}  // namespace
}  // namespace stepwright::fuzz::arms
