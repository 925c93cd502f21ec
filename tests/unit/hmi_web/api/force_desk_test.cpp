#include "hmi_web/api/force_desk.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"
#include "tests/unit/hmi_web/api/fake_cell.h"

namespace stepwright::api {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

class ForceDeskTest : public testing::Test {
 protected:
  ForceDeskTest() : audit_(*access::AuditLog::open(folder_ / "audit.jsonl")) { open(); }
  void open() {
    desk_.reset();
    auto desk = ForceDesk::open(
        folder_ / "forces.json", cell_, *audit_,
        [this] { return std::chrono::system_clock::time_point(now_.load()); },
        [this](const std::string& list) { told_ = list; });
    ASSERT_TRUE(desk) << result::to_string(desk.error());
    desk_ = std::move(*desk);
  }
  std::size_t listed() const { return json::parse(desk_->json())["forces"].size(); }

  support::TemporaryFolder folder_;
  std::atomic<std::chrono::seconds> now_{1'000s};
  FakeCell cell_;
  std::unique_ptr<access::AuditLog> audit_;
  std::string told_;
  std::unique_ptr<ForceDesk> desk_;
};

TEST_F(ForceDeskTest, WhenTheTimeIsOver_ThenItIsReleasedAndTheTrailTellsOfIt) {
  ASSERT_TRUE(desk_->force({"A", "TRUE", 2min, "ada", "test"}));
  EXPECT_EQ(listed(), 1u);
  now_ = 1'119s;
  desk_->look();
  EXPECT_EQ(listed(), 1u);
  now_ = 1'120s;
  desk_->look();
  EXPECT_EQ(listed(), 0u);
  EXPECT_EQ(cell_.asked().back(), "unforce A");
  EXPECT_EQ(audit_->entries(), 1u);
  EXPECT_EQ(json::parse(told_)["forces"].size(), 0u);
}

TEST_F(ForceDeskTest, WhenForced_ThenTheRuntimeGetsTheTime) {
  ASSERT_TRUE(desk_->force({"A", "TRUE", 2min, "ada", "test"}));
  EXPECT_EQ(cell_.duration(), 2min);
}

TEST_F(ForceDeskTest, WhenTheRuntimeHasEndedItInTime_ThenTheTrailSaysThatTheTimeIsOver) {
  ASSERT_TRUE(desk_->force({"A", "TRUE", 2min, "ada", "test"}));
  cell_.unforce_unseen("A");
  now_ = 1'119s;
  desk_->look();
  now_ = 1'120s;
  desk_->look();
  EXPECT_EQ(listed(), 0u);
  EXPECT_NE(cell_.asked().back(), "unforce A");
  std::ifstream trail(folder_ / "audit.jsonl");
  const std::string text{std::istreambuf_iterator<char>(trail), {}};
  EXPECT_NE(text.find("the time is over that ada had set"), std::string::npos) << text;
}

TEST_F(ForceDeskTest, WhenSomebodyElseForcesTheSameValueWithoutAnEnd_ThenOurTimerLeavesIt) {
  ASSERT_TRUE(desk_->force({"A", "TRUE", 2min, "ada", "test"}));
  cell_.force_unseen("A", "TRUE");
  now_ = 2'000s;
  for (int i = 0; i < 3; ++i) desk_->look();
  for (const std::string& asked : cell_.asked()) EXPECT_NE(asked, "unforce A");
  const json forces = json::parse(told_)["forces"];
  ASSERT_EQ(forces.size(), 1u);
  EXPECT_EQ(forces[0]["user"], "");
}

TEST_F(ForceDeskTest, WhenAnotherProgramHasJustCome_ThenItIsTriedAgain) {
  ASSERT_TRUE(desk_->force({"A", "TRUE", 1min, "ada", "test"}));
  now_ = 2'000s;
  cell_.fail_with("R0009");
  for (int i = 0; i < 3; ++i) desk_->look();
  EXPECT_EQ(listed(), 1u);
}

TEST_F(ForceDeskTest, WhenItIsForcedAgain_ThenItIsListedOnceWithTheNewTime) {
  ASSERT_TRUE(desk_->force({"A", "TRUE", 2min, "ada", "test"}));
  ASSERT_TRUE(desk_->force({"A", "FALSE", 10min, "ada", "longer"}));
  EXPECT_EQ(listed(), 1u);
  now_ = 1'200s;
  desk_->look();
  EXPECT_EQ(listed(), 1u);
}

TEST_F(ForceDeskTest, WhenTheServerRestarts_ThenWhatIsDueIsReleased) {
  ASSERT_TRUE(desk_->force({"A", "TRUE", 2min, "ada", "test"}));
  ASSERT_TRUE(desk_->force({"B", "TRUE", 20min, "ada", "test"}));
  open();
  EXPECT_EQ(listed(), 2u);
  now_ = 1'300s;
  desk_->look();
  EXPECT_EQ(listed(), 1u);
}

TEST_F(ForceDeskTest, WhenNoRuntimeAnswers_ThenItIsTriedAgainUntilOneDoes) {
  ASSERT_TRUE(desk_->force({"A", "TRUE", 1min, "ada", "test"}));
  now_ = 2'000s;
  cell_.fail_with("D0001");
  desk_->look();
  EXPECT_EQ(listed(), 1u);
  cell_.fail_with("");
  desk_->look();
  EXPECT_EQ(listed(), 0u);
}

TEST_F(ForceDeskTest, WhenTheProgramHasNoSuchVariableAnyMore_ThenTheEntryGoes) {
  ASSERT_TRUE(desk_->force({"A", "TRUE", 1min, "ada", "test"}));
  now_ = 2'000s;
  cell_.fail_with("R0057");
  desk_->look();
  EXPECT_EQ(listed(), 0u);
}

// Not that of a program that has just changed, after which one asks again at once.
TEST_F(ForceDeskTest, WhenAsMuchIsForcedAsARuntimeTakes_ThenThatHasACodeOfItsOwn) {
  for (std::size_t i = 0; i < kMostForces; ++i)
    ASSERT_TRUE(desk_->force({"V" + std::to_string(i), "TRUE", 1min, "ada", "test"}));
  const auto refused = desk_->force({"A", "TRUE", 1min, "ada", "test"});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "H0068");
  EXPECT_EQ(listed(), kMostForces);
}

TEST_F(ForceDeskTest, WhenForcingFails_ThenNothingIsListed) {
  cell_.fail_with("D0002");
  EXPECT_FALSE(desk_->force({"A", "TRUE", 1min, "ada", "test"}));
  EXPECT_EQ(listed(), 0u);
}

// The runtime has to say so twice.
TEST_F(ForceDeskTest, WhenTheRuntimeForcesItNoMore_ThenTheEntryGoesAndTheTrailTellsOfIt) {
  ASSERT_TRUE(desk_->force({"A", "TRUE", 20min, "ada", "test"}));
  cell_.unforce_unseen("A");
  desk_->look();
  desk_->look();
  EXPECT_EQ(listed(), 0u);
  EXPECT_EQ(json::parse(told_)["forces"].size(), 0u) << "the pages are told";
  EXPECT_EQ(audit_->entries(), 1u);
  open();
  EXPECT_EQ(listed(), 0u) << "nor does the next server take it for forced";
}

TEST_F(ForceDeskTest, WhenSomebodyElseForces_ThenItIsListedWithoutUserAndTimeAndIsNeverReleasedHere) {
  cell_.force_unseen("B", "7");
  desk_->look();
  const json forces = json::parse(told_)["forces"];
  ASSERT_EQ(forces.size(), 1u);
  EXPECT_EQ(forces[0]["name"], "B");
  EXPECT_EQ(forces[0]["value"], "7");
  EXPECT_EQ(forces[0]["user"], "");
  EXPECT_TRUE(forces[0]["until_s"].is_null());
  EXPECT_EQ(desk_->names(), std::vector<std::string>{"B"});
  now_ = 100'000s;
  desk_->look();
  EXPECT_EQ(listed(), 1u);
  ASSERT_TRUE(desk_->unforce("B")) << "unless somebody wants it";
  EXPECT_EQ(listed(), 0u);
}

TEST_F(ForceDeskTest, WhenSomebodyElseForcesOursToAnotherValue_ThenOurTimerLeavesIt) {
  ASSERT_TRUE(desk_->force({"A", "TRUE", 2min, "ada", "test"}));
  cell_.force_unseen("A", "FALSE");
  now_ = 2'000s;
  for (int i = 0; i < 3; ++i) desk_->look();
  for (const std::string& asked : cell_.asked()) EXPECT_NE(asked, "unforce A");
  const json forces = json::parse(told_)["forces"];
  ASSERT_EQ(forces.size(), 1u);
  EXPECT_EQ(forces[0]["value"], "FALSE");
  EXPECT_EQ(forces[0]["user"], "");
}

TEST_F(ForceDeskTest, WhenTheLinkCannotTell_ThenOursStayAndEndInTime) {
  cell_.forces_fail_with("D0008");
  ASSERT_TRUE(desk_->force({"A", "TRUE", 2min, "ada", "test"}));
  for (int i = 0; i < 3; ++i) desk_->look();
  EXPECT_EQ(listed(), 1u);
  now_ = 1'120s;
  desk_->look();
  EXPECT_EQ(listed(), 0u);
  EXPECT_EQ(cell_.asked().back(), "unforce A");
}

// Nothing was sent to it, so the force stands.
TEST_F(ForceDeskTest, WhenTheLinkIsOfAnotherVersionAtTheEnd_ThenTheForceIsReleasedOnceOneOfOursIsThere) {
  ASSERT_TRUE(desk_->force({"A", "TRUE", 2min, "ada", "test"}));
  now_ = 1'120s;
  cell_.fail_with("D0008");
  desk_->look();
  EXPECT_EQ(listed(), 1u);
  cell_.fail_with("");
  desk_->look();
  EXPECT_EQ(listed(), 0u);
  EXPECT_EQ(cell_.asked().back(), "unforce A");
}

TEST_F(ForceDeskTest, WhenNobodyAnswersOrTheProgramHasJustChanged_ThenTheListStaysAsItWas) {
  cell_.force_unseen("B", "7");
  ASSERT_TRUE(desk_->force({"A", "TRUE", 20min, "ada", "test"}));
  for (const char* code : {"D0001", "D0002"}) {
    cell_.fail_with(code);
    for (int i = 0; i < 3; ++i) desk_->look();
    EXPECT_EQ(listed(), 2u) << code;
  }
}

TEST_F(ForceDeskTest, WhenTheListIsDamaged_ThenItIsNotTakenForAnEmptyOne) {
  desk_.reset();
  for (const char* text : {"", "{", "{\"forces\": [1]}", "{\"forces\": [{\"name\": \"A\"}]}"}) {
    std::ofstream(folder_ / "forces.json") << text;
    const auto desk = ForceDesk::open(folder_ / "forces.json", cell_, *audit_, std::chrono::system_clock::now,
                                      [](const std::string&) {});
    ASSERT_FALSE(desk) << text;
    EXPECT_EQ(desk.error().front().code, "H0022");
  }
}

}  // namespace
}  // namespace stepwright::api
