#include "hmi_web/api/force_service.h"

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "ladder/driver/compile.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/hmi_web/api/fake_cell.h"

namespace stepwright::api {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

class ForceServiceTest : public testing::Test {
 protected:
  ForceServiceTest() : audit_(*access::AuditLog::open(folder_ / "audit.jsonl")) { open(); }
  void open() {
    service_.reset();
    auto service = ForceService::open(
        folder_ / "forces.json", cell_, *audit_,
        [this] { return std::chrono::system_clock::time_point(now_.load()); },
        [this](const std::string& list) { told_ = list; });
    ASSERT_TRUE(service) << result::to_string(service.error());
    service_ = std::move(*service);
  }
  std::size_t listed() const { return json::parse(service_->json())["forces"].size(); }

  support::TemporaryFolder folder_;
  std::atomic<std::chrono::seconds> now_{1'000s};
  FakeCell cell_;
  std::unique_ptr<access::AuditLog> audit_;
  std::string told_;
  std::unique_ptr<ForceService> service_;
};

TEST_F(ForceServiceTest, WhenTheTimeIsOver_ThenItIsReleasedAndTheTrailTellsOfIt) {
  ASSERT_TRUE(service_->force({"A", "TRUE", 2min, "ada", "test"}));
  EXPECT_EQ(listed(), 1u);
  now_ = 1'119s;
  service_->look();
  EXPECT_EQ(listed(), 1u);
  now_ = 1'120s;
  service_->look();
  EXPECT_EQ(listed(), 0u);
  EXPECT_EQ(cell_.asked().back(), "unforce A");
  EXPECT_EQ(audit_->entries(), 1u);
  EXPECT_EQ(json::parse(told_)["forces"].size(), 0u);
}

TEST_F(ForceServiceTest, WhenForced_ThenTheRuntimeGetsTheTime) {
  ASSERT_TRUE(service_->force({"A", "TRUE", 2min, "ada", "test"}));
  EXPECT_EQ(cell_.duration(), 2min);
}

TEST_F(ForceServiceTest, WhenTheRuntimeHasEndedItInTime_ThenTheTrailSaysThatTheTimeIsOver) {
  ASSERT_TRUE(service_->force({"A", "TRUE", 2min, "ada", "test"}));
  cell_.unforce_unseen("A");
  now_ = 1'119s;
  service_->look();
  now_ = 1'120s;
  service_->look();
  EXPECT_EQ(listed(), 0u);
  EXPECT_NE(cell_.asked().back(), "unforce A");
  std::ifstream trail(folder_ / "audit.jsonl");
  const std::string text{std::istreambuf_iterator<char>(trail), {}};
  EXPECT_NE(text.find("the time is over that ada had set"), std::string::npos) << text;
}

TEST_F(ForceServiceTest, WhenSomebodyElseForcesTheSameValueWithoutAnEnd_ThenOurTimerLeavesIt) {
  ASSERT_TRUE(service_->force({"A", "TRUE", 2min, "ada", "test"}));
  cell_.force_unseen("A", "TRUE");
  now_ = 2'000s;
  for (int i = 0; i < 3; ++i) service_->look();
  for (const std::string& asked : cell_.asked()) EXPECT_NE(asked, "unforce A");
  const json forces = json::parse(told_)["forces"];
  ASSERT_EQ(forces.size(), 1u);
  EXPECT_EQ(forces[0]["user"], "");
}

TEST_F(ForceServiceTest, WhenAnotherProgramHasJustCome_ThenItIsTriedAgain) {
  ASSERT_TRUE(service_->force({"A", "TRUE", 1min, "ada", "test"}));
  now_ = 2'000s;
  cell_.fail_with("R0009");
  for (int i = 0; i < 3; ++i) service_->look();
  EXPECT_EQ(listed(), 1u);
}

TEST_F(ForceServiceTest, WhenItIsForcedAgain_ThenItIsListedOnceWithTheNewTime) {
  ASSERT_TRUE(service_->force({"A", "TRUE", 2min, "ada", "test"}));
  ASSERT_TRUE(service_->force({"A", "FALSE", 10min, "ada", "longer"}));
  EXPECT_EQ(listed(), 1u);
  now_ = 1'200s;
  service_->look();
  EXPECT_EQ(listed(), 1u);
}

TEST_F(ForceServiceTest, WhenTheServerRestarts_ThenWhatIsDueIsReleased) {
  ASSERT_TRUE(service_->force({"A", "TRUE", 2min, "ada", "test"}));
  ASSERT_TRUE(service_->force({"B", "TRUE", 20min, "ada", "test"}));
  open();
  EXPECT_EQ(listed(), 2u);
  now_ = 1'300s;
  service_->look();
  EXPECT_EQ(listed(), 1u);
}

TEST_F(ForceServiceTest, WhenNoRuntimeAnswers_ThenItIsTriedAgainUntilOneDoes) {
  ASSERT_TRUE(service_->force({"A", "TRUE", 1min, "ada", "test"}));
  now_ = 2'000s;
  cell_.fail_with("D0001");
  service_->look();
  EXPECT_EQ(listed(), 1u);
  cell_.fail_with("");
  service_->look();
  EXPECT_EQ(listed(), 0u);
}

TEST_F(ForceServiceTest, WhenTheProgramHasNoSuchVariableAnyMore_ThenTheEntryGoes) {
  ASSERT_TRUE(service_->force({"A", "TRUE", 1min, "ada", "test"}));
  now_ = 2'000s;
  cell_.fail_with("R0057");
  service_->look();
  EXPECT_EQ(listed(), 0u);
}

// Not that of a program that has just changed, after which one asks again at once.
TEST_F(ForceServiceTest, WhenAsMuchIsForcedAsARuntimeTakes_ThenThatHasACodeOfItsOwn) {
  for (std::size_t i = 0; i < kMostForces; ++i)
    ASSERT_TRUE(service_->force({"V" + std::to_string(i), "TRUE", 1min, "ada", "test"}));
  const auto refused = service_->force({"A", "TRUE", 1min, "ada", "test"});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "H0068");
  EXPECT_EQ(listed(), kMostForces);
}

TEST_F(ForceServiceTest, WhenForcingFails_ThenNothingIsListed) {
  cell_.fail_with("D0002");
  EXPECT_FALSE(service_->force({"A", "TRUE", 1min, "ada", "test"}));
  EXPECT_EQ(listed(), 0u);
}

// The runtime has to say so twice.
TEST_F(ForceServiceTest, WhenTheRuntimeForcesItNoMore_ThenTheEntryGoesAndTheTrailTellsOfIt) {
  ASSERT_TRUE(service_->force({"A", "TRUE", 20min, "ada", "test"}));
  cell_.unforce_unseen("A");
  service_->look();
  service_->look();
  EXPECT_EQ(listed(), 0u);
  EXPECT_EQ(json::parse(told_)["forces"].size(), 0u) << "the pages are told";
  EXPECT_EQ(audit_->entries(), 1u);
  open();
  EXPECT_EQ(listed(), 0u) << "nor does the next server take it for forced";
}

TEST_F(ForceServiceTest, WhenSomebodyElseForces_ThenItIsListedWithoutUserAndTimeAndIsNeverReleasedHere) {
  cell_.force_unseen("B", "7");
  service_->look();
  const json forces = json::parse(told_)["forces"];
  ASSERT_EQ(forces.size(), 1u);
  EXPECT_EQ(forces[0]["name"], "B");
  EXPECT_EQ(forces[0]["value"], "7");
  EXPECT_EQ(forces[0]["user"], "");
  EXPECT_TRUE(forces[0]["until_s"].is_null());
  EXPECT_EQ(service_->names(), std::vector<std::string>{"B"});
  now_ = 100'000s;
  service_->look();
  EXPECT_EQ(listed(), 1u);
  ASSERT_TRUE(service_->unforce("B")) << "unless somebody wants it";
  EXPECT_EQ(listed(), 0u);
}

TEST_F(ForceServiceTest, WhenSomebodyElseForcesOursToAnotherValue_ThenOurTimerLeavesIt) {
  ASSERT_TRUE(service_->force({"A", "TRUE", 2min, "ada", "test"}));
  cell_.force_unseen("A", "FALSE");
  now_ = 2'000s;
  for (int i = 0; i < 3; ++i) service_->look();
  for (const std::string& asked : cell_.asked()) EXPECT_NE(asked, "unforce A");
  const json forces = json::parse(told_)["forces"];
  ASSERT_EQ(forces.size(), 1u);
  EXPECT_EQ(forces[0]["value"], "FALSE");
  EXPECT_EQ(forces[0]["user"], "");
}

TEST_F(ForceServiceTest, WhenTheLinkCannotTell_ThenOursStayAndEndInTime) {
  cell_.forces_fail_with("D0008");
  ASSERT_TRUE(service_->force({"A", "TRUE", 2min, "ada", "test"}));
  for (int i = 0; i < 3; ++i) service_->look();
  EXPECT_EQ(listed(), 1u);
  now_ = 1'120s;
  service_->look();
  EXPECT_EQ(listed(), 0u);
  EXPECT_EQ(cell_.asked().back(), "unforce A");
}

// Nothing was sent to it, so the force stands.
TEST_F(ForceServiceTest, WhenTheLinkIsOfAnotherVersionAtTheEnd_ThenTheForceIsReleasedOnceOneOfOursIsThere) {
  ASSERT_TRUE(service_->force({"A", "TRUE", 2min, "ada", "test"}));
  now_ = 1'120s;
  cell_.fail_with("D0008");
  service_->look();
  EXPECT_EQ(listed(), 1u);
  cell_.fail_with("");
  service_->look();
  EXPECT_EQ(listed(), 0u);
  EXPECT_EQ(cell_.asked().back(), "unforce A");
}

TEST_F(ForceServiceTest, WhenNobodyAnswersOrTheProgramHasJustChanged_ThenTheListStaysAsItWas) {
  cell_.force_unseen("B", "7");
  ASSERT_TRUE(service_->force({"A", "TRUE", 20min, "ada", "test"}));
  for (const char* code : {"D0001", "D0002"}) {
    cell_.fail_with(code);
    for (int i = 0; i < 3; ++i) service_->look();
    EXPECT_EQ(listed(), 2u) << code;
  }
}

TEST_F(ForceServiceTest, WhenTheListIsDamaged_ThenItIsNotTakenForAnEmptyOne) {
  service_.reset();
  for (const char* text : {"", "{", "{\"forces\": [1]}", "{\"forces\": [{\"name\": \"A\"}]}"}) {
    std::ofstream(folder_ / "forces.json") << text;
    const auto service = ForceService::open(folder_ / "forces.json", cell_, *audit_,
                                            std::chrono::system_clock::now, [](const std::string&) {});
    ASSERT_FALSE(service) << text;
    EXPECT_EQ(service.error().front().code, "H0022");
  }
}

TEST_F(ForceServiceTest, WhenAPlaceIsForced_ThenAllThatLiesThereIsListedWithIt) {
  const auto made = driver::compile(
      {.texts = {{"main.st",
                  "PROGRAM P VAR free : BOOL; list : ARRAY[0..1] OF INT; END_VAR\n"
                  "VAR b1 AT %QX0.0 : BOOL; b2 AT %QX0.1 : BOOL; both AT %QB0 : BYTE; next AT %QW1 : WORD;\n"
                  "s1 AT %IX0.0 : BOOL; END_VAR END_PROGRAM\n"
                  "CONFIGURATION C RESOURCE R ON PLC TASK T(INTERVAL := T#10ms);\n"
                  "PROGRAM Main WITH T : P; END_RESOURCE END_CONFIGURATION"}}});
  ASSERT_TRUE(made) << result::to_string(made.error());
  const auto also = [&](const std::string& name) {
    EXPECT_TRUE(service_->force({name, "TRUE", 2min, "ada", "test"}));
    std::string names;
    const json forces = json::parse(service_->json())["forces"];
    for (const json& entry : forces) {
      for (const json& each : entry["also"]) names += each.get<std::string>() + " ";
    }
    EXPECT_TRUE(service_->unforce(name));
    return names;
  };
  EXPECT_EQ(also("%QX0.0"), "") << "no program runs";
  cell_.run(std::make_shared<reader::ProgramInfo>(*reader::ProgramInfo::read(made->container)));
  EXPECT_EQ(also("%QX0.0"), "Main.b1 Main.both ");
  EXPECT_EQ(also("%qb0"), "Main.b1 Main.b2 Main.both ");
  EXPECT_EQ(also("%QD0"), "Main.b1 Main.b2 Main.both Main.next ");
  EXPECT_EQ(also("main.B2"), "Main.both ") << "a variable that lies over another";
  EXPECT_EQ(also("Main.free"), "");
  EXPECT_EQ(also("Main.list"), "");
  EXPECT_EQ(also("Main.gone"), "");
}

}  // namespace
}  // namespace stepwright::api
