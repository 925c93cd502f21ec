// Programs that people wrote, compiled beside the planned chart: they run behind it and have the last word.

#include "supervisor/executive/hand_written.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/compiled_program.h"

namespace stepwright::executive {
namespace {

constexpr const char* kHead = R"(<?xml version="1.0" encoding="utf-8"?>
<project xmlns="http://www.plcopen.org/xml/tc6_0201" xmlns:xhtml="http://www.w3.org/1999/xhtml">
  <fileHeader companyName="a" productName="b" productVersion="1" creationDateTime="2026-01-01T00:00:00"/>
  <contentHeader name="c"><coordinateInfo><fbd><scaling x="0" y="0"/></fbd><ld><scaling x="0" y="0"/></ld><sfc><scaling x="0" y="0"/></sfc></coordinateInfo></contentHeader>
)";

std::string bool_variable(const std::string& name, const std::string& address = "") {
  return "<variable name=\"" + name + "\"" + (address.empty() ? "" : " address=\"" + address + "\"") +
         "><type><BOOL/></type></variable>";
}

// A POU whose rung is: motor AND permit -> motor.
std::string pou(const std::string& name, const std::string& type = "program") {
  return "<pou name=\"" + name + "\" pouType=\"" + type + "\"><interface><externalVars>" +
         bool_variable("motor") + bool_variable("permit") + R"(</externalVars></interface><body><LD>
<leftPowerRail localId="1"><position x="0" y="0"/><connectionPointOut formalParameter=""/></leftPowerRail>
<contact localId="2"><position x="50" y="0"/><connectionPointIn><connection refLocalId="1"/></connectionPointIn><connectionPointOut/><variable>motor</variable></contact>
<contact localId="3"><position x="150" y="0"/><connectionPointIn><connection refLocalId="2"/></connectionPointIn><connectionPointOut/><variable>permit</variable></contact>
<coil localId="4"><position x="250" y="0"/><connectionPointIn><connection refLocalId="3"/></connectionPointIn><connectionPointOut/><variable>motor</variable></coil>
<rightPowerRail localId="5"><position x="350" y="0"/><connectionPointIn><connection refLocalId="4"/></connectionPointIn></rightPowerRail>
</LD></body></pou>)";
}

std::string document(const std::string& pous, const std::string& instances = "<configurations/>") {
  return kHead + ("<types><dataTypes/><pous>" + pous + "</pous></types><instances>" + instances +
                  "</instances></project>\n");
}

std::string configuration(const std::string& instance, const std::string& globals) {
  return "<configurations><configuration name=\"c\"><resource name=\"r\"><task name=\"t\" priority=\"0\" "
         "interval=\"T#50ms\"><pouInstance name=\"" +
         instance + "\" typeName=\"safety\"/></task><globalVars>" + globals +
         "</globalVars></resource></configuration></configurations>";
}

// What a plan would be: a program that always wants the motor.
graphic::Project generated() {
  graphic::Project project;
  project.name = "plan";
  for (const auto& [name, address] :
       {std::pair<const char*, const char*>{"motor", "%QX0.0"}, {"permit", "%IX0.0"}}) {
    graphic::Variable global;
    global.name = name;
    global.type = "BOOL";
    global.section = graphic::VariableSection::Global;
    global.address = address;
    project.globals.push_back(global);
  }
  graphic::Pou plan;
  plan.name = "plan";
  plan.variables.push_back(project.globals[0]);
  plan.variables[0].section = graphic::VariableSection::External;
  plan.variables[0].address.clear();
  plan.body = graphic::StBody{"motor := TRUE;\n"};
  project.pous = {plan};
  project.tasks = {{"main", 10'000, 0}};
  project.instances = {{"planned", "plan", "main"}};
  return project;
}

class HandWrittenTest : public testing::Test {
 protected:
  HandWrittenTest()
      : folder_(
            std::filesystem::temp_directory_path() /
            ("stepwright-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::create_directories(folder_);
  }
  ~HandWrittenTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  result::Result<JoinedPrograms> join(const std::string& text) {
    auto loaded = HandWritten::load({write("safety.xml", text)});
    if (!loaded) return result::forward(loaded);
    return loaded->joined(generated());
  }

  std::filesystem::path folder_;
};

TEST_F(HandWrittenTest, WhenItRunsBehindThePlan_ThenItHasTheLastWordOverAnOutput) {
  auto joined = join(document(pou("safety")));
  ASSERT_TRUE(joined.has_value()) << result::to_string(joined.error());
  support::CompiledProgram program({.texts = {}, .projects = joined->projects()});
  program.scan();
  EXPECT_EQ(program.get("motor"), 0);
  program.set("permit", 1);
  program.scan();
  EXPECT_EQ(program.get("motor"), 1);
}

TEST_F(HandWrittenTest, WhenAFileHasItsOwnConfiguration_ThenItsInstancesAndGlobalsJoinThePlansTask) {
  auto joined = join(document(pou("safety"), configuration("guard", bool_variable("lamp", "%QX0.7") +
                                                                        bool_variable("motor", "%QX0.0"))));
  ASSERT_TRUE(joined.has_value()) << result::to_string(joined.error());
  ASSERT_EQ(joined->generated.instances.size(), 2u);
  EXPECT_EQ(joined->generated.instances[1].name, "guard");
  EXPECT_EQ(joined->generated.instances[1].task, "main");
  EXPECT_EQ(joined->generated.globals.size(), 3u);
  support::CompiledProgram program({.texts = {}, .projects = joined->projects()});
  program.scan();
  EXPECT_EQ(program.get("motor"), 0);
  EXPECT_EQ(program.get("lamp"), 0);
}

TEST_F(HandWrittenTest, WhenThereAreNone_ThenThePlanIsAsItWas) {
  auto joined = HandWritten().joined(generated());
  ASSERT_TRUE(joined.has_value());
  EXPECT_EQ(joined->projects().size(), 1u);
  EXPECT_EQ(joined->generated.instances.size(), 1u);
}

TEST_F(HandWrittenTest, WhenAGlobalContradictsTheBinding_ThenItIsRefusedAtItsPlace) {
  const auto joined = join(document(pou("safety"), configuration("guard", bool_variable("motor", "%QX0.1"))));
  ASSERT_FALSE(joined.has_value());
  EXPECT_EQ(joined.error()[0].code, "X0006");
  EXPECT_NE(joined.error()[0].message.find("%QX0.1"), std::string::npos);
  EXPECT_GT(joined.error()[0].where.line, 1u);
}

TEST_F(HandWrittenTest, WhenAnInstanceHasThePlansName_ThenItIsRefused) {
  const auto joined = join(document(pou("planned")));
  ASSERT_FALSE(joined.has_value());
  EXPECT_EQ(joined.error()[0].code, "X0006");
}

TEST_F(HandWrittenTest, WhenFilesAreWrong_ThenEveryOneIsReported) {
  const auto loaded = HandWritten::load({folder_ / "missing.xml", write("broken.xml", "<project"),
                                         write("none.xml", document(pou("block", "functionBlock")))});
  ASSERT_FALSE(loaded.has_value());
  std::vector<std::string> codes;
  for (const auto& problem : loaded.error()) codes.push_back(problem.code);
  EXPECT_EQ(codes, (std::vector<std::string>{"E0001", "E0801", "X0007"}));
}

}  // namespace
}  // namespace stepwright::executive
