// Projects that were made by program, written and read back: the same file again, and the same behaviour.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ladder/exchange/plcopen_reader.h"
#include "ladder/exchange/plcopen_writer.h"
#include "ladder/lowering/sfc_to_ladder.h"
#include "tests/support/compiled_program.h"
#include "tests/unit/ladder/lowering/random_chart.h"

namespace stepwright::exchange {
namespace {

graphic::Project project_of(graphic::Pou pou) {
  graphic::Project project;
  project.name = "demo";
  project.tasks = {{"fast", 10'000, 1}};
  project.instances = {{"run", pou.name, "fast"}};
  project.pous.push_back(std::move(pou));
  return project;
}

std::string written(const graphic::Project& project) {
  const auto xml = write_plcopen(project);
  if (!xml) throw std::runtime_error(result::to_string(xml.error()));
  return *xml;
}

graphic::Project read(const std::string& xml) {
  auto project = read_plcopen("plc.xml", xml);
  if (!project) throw std::runtime_error(result::to_string(project.error()));
  return std::move(*project);
}

driver::CompileInput input_of(const graphic::Project& project) {
  driver::CompileInput input;
  input.projects = {&project};
  return input;
}

// Both run on the same random inputs; what differs first.
std::string difference(const graphic::Project& original, const graphic::Project& copy, std::mt19937& random) {
  support::CompiledProgram a(input_of(original));
  support::CompiledProgram b(input_of(copy));
  for (int scan = 1; scan <= 40; ++scan) {
    for (const char* name : {"i0", "i1", "i2", "i3", "n0", "n1"}) {
      const auto value = static_cast<std::int64_t>(random() % (name[0] == 'i' ? 2 : 5));
      a.set(std::string("run.") + name, value);
      b.set(std::string("run.") + name, value);
    }
    if (a.scan().trap || b.scan().trap) return "trap in scan " + std::to_string(scan);
    for (const char* name : {"o0", "o1", "o2", "o3", "c0", "c1"}) {
      const std::string path = std::string("run.") + name;
      if (a.get(path) != b.get(path)) return path + " in scan " + std::to_string(scan);
    }
  }
  return {};
}

void expect_same(const graphic::Project& original, std::mt19937& random) {
  const std::string xml = written(original);
  const graphic::Project copy = read(xml);
  EXPECT_EQ(written(copy), xml);
  EXPECT_EQ(difference(original, copy, random), "");
}

TEST(PlcopenRoundTrip, WhenChartsAreRandom_ThenFileAndBehaviourAreTheSame) {
  for (unsigned seed = 1; seed <= 60 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    expect_same(project_of(lowering::random_pou(random)), random);
  }
}

TEST(PlcopenRoundTrip, WhenRungsAreRandom_ThenFileAndBehaviourAreTheSame) {
  for (unsigned seed = 1; seed <= 60 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    expect_same(project_of(*lowering::lower_sfc(lowering::random_pou(random))), random);
  }
}

TEST(PlcopenRoundTrip, WhenChartHasFinalScan_ThenTheCopyHasIt) {
  for (const bool final_scan : {false, true}) {
    std::mt19937 random(3);
    graphic::Pou pou = lowering::random_pou(random);
    std::get<graphic::SfcChart>(pou.body).final_scan = final_scan;
    const std::string xml = written(project_of(pou));
    const graphic::Project copy = read(xml);
    EXPECT_EQ(std::get<graphic::DrawnBody>(copy.pous[0].body).final_scan, final_scan);
    EXPECT_EQ(written(copy), xml);
  }
}

}  // namespace
}  // namespace stepwright::exchange
