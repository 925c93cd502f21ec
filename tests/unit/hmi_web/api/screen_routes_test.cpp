#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "ladder/driver/compile.h"
#include "runtime/ground/files/files.h"
#include "tests/unit/hmi_web/api/request_guard_fixture.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

constexpr const char* kParts = R"(<svg viewBox="0 0 9 9">
<g data-part="setpoint" data-key="level" data-write="mixer.level" data-from="0" data-to="100"/>
<g data-part="switch" data-key="stir" data-write="mixer.stir" data-confirm="Stir now?"/>
<g data-part="choice" data-key="mode" data-write="mixer.mode" data-values="0=Off;2=Auto"/>
<g data-part="startstop" data-key="pump" data-write="mixer.start" data-stop="mixer.stop"/>
<g data-part="button" data-key="flush" data-write="mixer.flush" data-value="TRUE" data-least="engineer"/></svg>)";

class ScreenRoutesTest : public testing::Test {
 protected:
  ScreenRoutesTest() {
    for (const char* name : {"level", "stir", "mode", "start", "stop", "flush"})
      fixture_.cell.set(std::string("mixer.") + name, "0");
    EXPECT_EQ(save("Mixer", kParts, 0).status, 200u);
  }
  Answer ask(const std::string& method, const std::string& target, const std::string& body = {},
             Role role = Role::Engineer) {
    return fixture_.ask(method, target, body, fixture_.session(role));
  }
  Answer save(const std::string& name, const std::string& svg, int version, Role role = Role::Engineer) {
    return ask("PUT", "/api/screens/" + name, json{{"svg", svg}, {"version", version}}.dump(), role);
  }
  // "200", or status and code.
  std::string write(const std::string& part, const std::string& value, const json& more = {},
                    Role role = Role::Operator) {
    json body = {{"part", part}, {"value", value}, {"once", "deed number " + std::to_string(++deeds_)}};
    if (more.is_object()) body.update(more);
    return code(ask("POST", "/api/screens/Mixer/write", body.dump(), role));
  }
  static std::string code(const Answer& answer) {
    const json document = json::parse(answer.text);
    const std::string status = std::to_string(answer.status);
    return answer.status == 200 ? status : status + " " + document["problems"][0]["code"].get<std::string>();
  }
  std::size_t writes() const {
    std::size_t count = 0;
    for (const std::string& each : fixture_.cell.asked()) count += each.starts_with("write ") ? 1 : 0;
    return count;
  }
  json last_of_trail() {
    std::istringstream lines(files::read_file(fixture_.audit->file()).value());
    std::string last;
    for (std::string line; std::getline(lines, line);) last = line;
    return json::parse(last);
  }
  RequestGuardFixture fixture_;
  int deeds_ = 0;
};

TEST_F(ScreenRoutesTest, WhenAnOperatorWritesWithAPart_ThenTheProgramHasItAndTheTrailTellsWhere) {
  EXPECT_EQ(write("level", "20.5"), "200");
  EXPECT_EQ(fixture_.cell.value("mixer.level"), "20.5");
  const json entry = last_of_trail();
  EXPECT_EQ(entry["action"], "screen.write");
  EXPECT_EQ(entry["target"], "mixer.level (Mixer: level)");
  EXPECT_EQ(entry["before"], "0");
  EXPECT_EQ(entry["after"], "20.5");
  EXPECT_EQ(entry["role"], "operator");
}

TEST_F(ScreenRoutesTest, WhenTheRuntimeIsBeingStartedAgain_ThenTheTrailHasTheValueThatItStartedWith) {
  fixture_.cell.set("mixer.level", "55");
  fixture_.cell.start_with({{"mixer.level", "-7"}});
  EXPECT_EQ(write("level", "7"), "200");
  EXPECT_EQ(last_of_trail()["before"], "-7");
  EXPECT_EQ(last_of_trail()["after"], "7");
  for (const char* action : {"write", "force", "unforce"}) {
    fixture_.cell.set("mixer.level", "55");
    fixture_.cell.start_with({{"mixer.level", "-9"}});
    json body = {{"name", "mixer.level"}, {"reason", "a test"}};
    if (action != std::string("unforce")) body["value"] = "8";
    EXPECT_EQ(code(ask("POST", std::string("/api/tags/") + action, body.dump())), "200") << action;
    EXPECT_EQ(last_of_trail()["before"], "-9") << action;
  }
}

TEST_F(ScreenRoutesTest, WhenAValueIsNotOfThePart_ThenNothingIsWritten) {
  EXPECT_EQ(write("level", "100.5"), "400 H0126");
  EXPECT_EQ(write("level", "-1"), "400 H0126");
  EXPECT_EQ(write("level", "nan"), "400 H0126");
  EXPECT_EQ(write("level", "TRUE"), "400 H0126");
  EXPECT_EQ(write("mode", "1"), "400 H0126");
  EXPECT_EQ(write("pump", "TRUE"), "400 H0126");
  EXPECT_EQ(write("stir", "1", {{"confirmed", true}}), "400 H0126");
  EXPECT_EQ(write("nothing", "1"), "404 H0125");
  EXPECT_EQ(writes(), 0u);
  EXPECT_EQ(write("level", "T#20s"), "200") << "a TIME in seconds";
  EXPECT_EQ(write("mode", "2"), "200");
  EXPECT_EQ(write("pump", "stop"), "200");
  EXPECT_EQ(fixture_.cell.value("mixer.stop"), "TRUE");
}

TEST_F(ScreenRoutesTest, WhenAPartAsksOrTakesAnotherRole_ThenItIsHeeded) {
  EXPECT_EQ(write("stir", "TRUE"), "400 H0127");
  EXPECT_EQ(write("stir", "TRUE", {{"confirmed", true}}), "200");
  EXPECT_EQ(write("level", "1", {}, Role::Viewer), "403 H0042");
  EXPECT_EQ(write("flush", "x"), "403 H0128");
  EXPECT_EQ(write("flush", "x", {}, Role::Engineer), "200");
  EXPECT_EQ(fixture_.cell.value("mixer.flush"), "TRUE") << "what a button writes is in the drawing";
}

TEST_F(ScreenRoutesTest, WhenADeedIsAskedTwice_ThenItIsDoneOnce) {
  EXPECT_EQ(write("level", "20", {{"once", "the same deed"}}), "200");
  fixture_.cell.set("mixer.level", "7");
  EXPECT_EQ(write("level", "20", {{"once", "the same deed"}}), "200");
  EXPECT_EQ(writes(), 1u);
  EXPECT_EQ(fixture_.cell.value("mixer.level"), "7");
  // Who has not answered may have obeyed.
  fixture_.cell.fail_with("D0007");
  EXPECT_EQ(write("level", "30", {{"once", "another deed"}}), "504 D0007");
  fixture_.cell.fail_with("");
  EXPECT_EQ(write("level", "30", {{"once", "another deed"}}), "504 D0007");
  EXPECT_EQ(writes(), 1u);
}

TEST_F(ScreenRoutesTest, WhenAPartCanNeverWrite_ThenTheSaveIsDoneAndSaysSo) {
  EXPECT_EQ(json::parse(save("Mixer", kParts, 1).text)["warnings"], json::array()) << "no program is known";
  const auto made = driver::compile(
      {.texts = {{"main.st",
                  "PROGRAM mixer VAR level, mode : INT; stir, start, stop, flush : BOOL; END_VAR "
                  "END_PROGRAM"}}});
  fixture_.cell.run(std::make_shared<reader::ProgramInfo>(*reader::ProgramInfo::read(made->container)));
  EXPECT_EQ(json::parse(save("Mixer", kParts, 2).text)["warnings"], json::array());
  const Answer saved = save("Mixer",
                            "<svg viewBox='0 0 9 9'>\n<g data-part='button' data-key='b' "
                            "data-write='mixer.level' data-value='abc'/></svg>",
                            3);
  EXPECT_EQ(saved.status, 200u);
  const json warnings = json::parse(saved.text)["warnings"];
  ASSERT_EQ(warnings.size(), 1u) << saved.text;
  EXPECT_EQ(warnings[0]["code"], "C0645");
  EXPECT_EQ(warnings[0]["line"], 2);
  EXPECT_NE(warnings[0]["message"].get<std::string>().find("no value of the type INT"), std::string::npos);
}

TEST_F(ScreenRoutesTest, WhenAVersionIsNoWholeNumber_ThenNothingIsSaved) {
  EXPECT_EQ(code(ask("PUT", "/api/screens/x1", R"({"svg": "<svg viewBox='0 0 1 1'/>", "version": 1.5})")),
            "400 H0033");
}

TEST_F(ScreenRoutesTest, WhenTwoPeopleSave_ThenTheSecondIsToldOfBothVersions) {
  EXPECT_EQ(save("Mixer", R"(<svg viewBox="0 0 1 1"/>)", 1).status, 200u);
  const Answer late = save("Mixer", R"(<svg viewBox="0 0 2 2"/>)", 1);
  EXPECT_EQ(code(late), "409 H0122");
  const json document = json::parse(late.text);
  EXPECT_EQ(document["current"]["version"], 2);
  EXPECT_EQ(document["current"]["saved_by"], "engineer");
  EXPECT_EQ(document["kept"], 3);
  const Answer mine = ask("GET", "/api/screens/Mixer?version=3");
  EXPECT_NE(mine.text.find("0 0 2 2"), std::string::npos);
  const json versions = json::parse(ask("GET", "/api/screens/Mixer/versions").text);
  EXPECT_EQ(versions["current"], 2);
  EXPECT_EQ(versions["versions"].size(), 3u);
  EXPECT_EQ(versions["versions"][0]["aside"], true);
}

TEST_F(ScreenRoutesTest, WhenAScreenIsForARole_ThenOthersDoNotSeeIt) {
  EXPECT_EQ(save("Service", R"(<svg viewBox="0 0 1 1" data-least="engineer"/>)", 0).status, 200u);
  const auto names = [&](Role role) {
    std::string all;
    const json list = json::parse(ask("GET", "/api/screens", {}, role).text);
    for (const auto& each : list["screens"]) all += each["name"].get<std::string>() + " ";
    return all;
  };
  EXPECT_EQ(names(Role::Viewer), "Mixer ");
  EXPECT_EQ(names(Role::Engineer), "Mixer Service ");
  EXPECT_EQ(ask("GET", "/api/screens/Service", {}, Role::Operator).status, 404u);
  EXPECT_EQ(ask("GET", "/api/screens/Mixer?version=1", {}, Role::Operator).status, 403u);
  EXPECT_EQ(save("Mixer", "<svg/>", 1, Role::Operator).status, 403u);
}

TEST_F(ScreenRoutesTest, WhenASvgCouldDoHarm_ThenItsPlaceIsTold) {
  const Answer answer = save("Mixer", "<svg viewBox='0 0 1 1'>\n  <script/></svg>", 1);
  EXPECT_EQ(code(answer), "400 C0641");
  EXPECT_EQ(json::parse(answer.text)["problems"][0]["line"], 2);
}

TEST_F(ScreenRoutesTest, WhenAScreenIsExported_ThenItIsAFileThatCanBeSavedAgain) {
  const Answer file = ask("GET", "/api/screens/Mixer/export.svg", {}, Role::Viewer);
  EXPECT_EQ(file.content_type, "image/svg+xml");
  EXPECT_EQ(file.file_name, "Mixer.svg");
  EXPECT_EQ(save("Copy", file.text, 0).status, 200u);
  EXPECT_EQ(ask("GET", "/api/screens/Copy/export.svg").text, file.text) << "what is read again is the same";
}

TEST_F(ScreenRoutesTest, WhenARoleHasAStartOfItsOwn_ThenItsPagesOpenWithItIfItMaySeeIt) {
  EXPECT_EQ(save("Service", R"(<svg viewBox="0 0 1 1" data-least="engineer"/>)", 0).status, 200u);
  EXPECT_EQ(save("Face", R"(<svg viewBox="0 0 1 1" data-kind="symbol"/>)", 0).status, 200u);
  const auto choose = [&](const json& body, Role role = Role::Engineer) {
    return code(ask("PUT", "/api/screen-start", body.dump(), role));
  };
  const auto start = [&](Role role) {
    return json::parse(ask("GET", "/api/screens", {}, role).text)["start"].get<std::string>();
  };
  EXPECT_EQ(choose({{"screen", "Mixer"}}), "200");
  EXPECT_EQ(choose({{"screen", "Service"}, {"role", "engineer"}}), "200");
  EXPECT_EQ(last_of_trail()["target"], "engineer");
  EXPECT_EQ(start(Role::Engineer), "Service");
  EXPECT_EQ(start(Role::Administrator), "Service");
  EXPECT_EQ(start(Role::Operator), "Mixer");
  EXPECT_EQ(choose({{"screen", "Service"}, {"role", "viewer"}}), "200");
  EXPECT_EQ(start(Role::Viewer), "Mixer") << "what a role may not see it does not open with";
  EXPECT_EQ(choose({{"screen", "Face"}, {"role", "operator"}}), "200");
  EXPECT_EQ(start(Role::Operator), "Mixer") << "a face is none";
  EXPECT_EQ(choose({{"screen", ""}, {"role", "engineer"}}), "200");
  EXPECT_EQ(start(Role::Engineer), "Mixer");
  const json known = json::parse(ask("GET", "/api/screens").text)["starts"];
  EXPECT_EQ(known["everybody"], "Mixer");
  EXPECT_EQ(known["viewer"], "Service");
  EXPECT_FALSE(json::parse(ask("GET", "/api/screens", {}, Role::Viewer).text).contains("starts"));
  EXPECT_EQ(choose({{"screen", "Nowhere"}}), "404 H0120");
  EXPECT_EQ(choose({{"screen", "Mixer"}, {"role", "nobody"}}).substr(0, 3), "400");
  EXPECT_EQ(choose({{"screen", "Mixer"}}, Role::Operator).substr(0, 3), "403");
}

TEST_F(ScreenRoutesTest, WhenADrawingIsChecked_ThenItIsCleanedAndNothingIsSaved) {
  const auto check = [&](const std::string& svg, Role role = Role::Engineer) {
    return ask("POST", "/api/screen-check", json{{"svg", svg}}.dump(), role);
  };
  const Answer answer = check(R"(<svg viewBox="0 0 9 9"><style>.a{fill:red}</style><rect class="a"/></svg>)");
  EXPECT_EQ(answer.status, 200u) << answer.text;
  EXPECT_EQ(json::parse(answer.text)["svg"].get<std::string>().find("<style"), std::string::npos);
  const json idle = json::parse(
      check(R"(<svg viewBox="0 0 9 9"><g data-symbol="button" data-params="{}"><rect/></g></svg>)").text);
  EXPECT_EQ(idle["warnings"][0]["code"], "C0647");
  EXPECT_EQ(code(check("<svg viewBox='0 0 9 9'><script/></svg>")), "400 C0641");
  EXPECT_EQ(json::parse(check("").text)["problems"][0]["message"], "'svg' is empty");
  EXPECT_EQ(code(check(kParts, Role::Operator)).substr(0, 3), "403");
  EXPECT_EQ(json::parse(ask("GET", "/api/screens").text)["screens"].size(), 1u);
}

TEST_F(ScreenRoutesTest, WhenAScreenIsChosenOrRemoved_ThenPagesBeginElsewhere) {
  EXPECT_EQ(ask("PUT", "/api/screen-start", R"({"screen": "Mixer"})").status, 200u);
  EXPECT_EQ(json::parse(ask("GET", "/api/screens").text)["start"], "Mixer");
  EXPECT_EQ(code(ask("DELETE", "/api/screens/Mixer?version=7")), "409 H0122");
  EXPECT_EQ(ask("DELETE", "/api/screens/Mixer?version=1").status, 200u);
  EXPECT_TRUE(json::parse(ask("GET", "/api/screens", {}, Role::Viewer).text)["screens"].empty());
  EXPECT_EQ(code(ask("POST", "/api/screens/Mixer/write",
                     R"({"part": "level", "value": "1", "once": "12345678"})", Role::Operator)),
            "404 H0120");
}

}  // namespace
}  // namespace stepwright::api
