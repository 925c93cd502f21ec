#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "ladder/driver/compile.h"
#include "runtime/ground/files/files.h"
#include "tests/unit/hmi_web/api/request_guard_fixture.h"

namespace stepwright::api {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::byte>;

Bytes program(const std::string& variables) {
  driver::CompileInput input;
  input.texts.push_back(
      {"p.st", "PROGRAM P VAR count : INT; " + variables + " END_VAR count := count + 1; END_PROGRAM"});
  auto output = driver::compile(input);
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  return std::move(output->container);
}

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const auto byte = [&](std::size_t i) {
      return at + i < bytes.size() ? std::to_integer<unsigned>(bytes[at + i]) : 0u;
    };
    const unsigned three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (unsigned i = 0; i < 4; ++i)
      text += at + i > bytes.size() ? '=' : kDigits[three >> (18 - 6 * i) & 63u];
  }
  return text;
}

class ChangeRoutesTest : public testing::Test {
 protected:
  ChangeRoutesTest() { fixture_.programs.load(first_); }

  Answer ask(const std::string& method, const std::string& target, const json& body = {},
             Role role = Role::Engineer) {
    return fixture_.ask(method, target, body.is_null() ? "" : body.dump(), fixture_.session(role));
  }
  static std::string code(const Answer& answer) {
    const json read = json::parse(answer.text);
    return std::to_string(answer.status) + " " +
           (read.contains("problems") ? read["problems"][0]["code"].get<std::string>() : "");
  }
  Answer bring(const Bytes& container, const std::string& name = "next.swb") {
    return ask("POST", "/api/change/check", {{"name", name}, {"container", base64(container)}});
  }
  json order(const Bytes& next, const Bytes& base, const std::string& charts = "keep") {
    return {{"program", FakeChange::digest_of(next)},
            {"base", FakeChange::digest_of(base)},
            {"charts", charts},
            {"reason", "a new limit"}};
  }
  Answer apply(const Bytes& next, const Bytes& base, const std::string& charts = "keep") {
    return ask("POST", "/api/change/apply", order(next, base, charts));
  }
  json state() { return json::parse(ask("GET", "/api/change").text); }
  std::vector<json> trail() {
    std::istringstream lines(files::read_file(fixture_.audit->file()).value());
    std::vector<json> entries;
    for (std::string line; std::getline(lines, line);) entries.push_back(json::parse(line));
    return entries;
  }

  const Bytes first_ = program("gone : INT;");
  const Bytes next_ = program("fresh : TIME;");
  RequestGuardFixture fixture_;
};

TEST_F(ChangeRoutesTest, WhenAContainerIsBrought_ThenItIsComparedAndNothingHasChanged) {
  const Answer brought = bring(next_);
  ASSERT_EQ(brought.status, 200u) << brought.text;
  const std::string digest = json::parse(brought.text)["program"];
  EXPECT_EQ(digest, FakeChange::digest_of(next_));
  const Answer compared = ask("GET", "/api/change/diff?program=" + digest);
  ASSERT_EQ(compared.status, 200u) << compared.text;
  const json seen = json::parse(compared.text);
  EXPECT_EQ(seen["running"], FakeChange::digest_of(first_));
  EXPECT_EQ(seen["lists"]["added"]["rows"][0],
            (json{{"name", "P.fresh"}, {"before", ""}, {"after", "TIME"}}));
  EXPECT_EQ(seen["lists"]["removed"]["count"], 1);
  EXPECT_EQ(seen["refusals"],
            (json{{"now", json::array()}, {"keep", json::array()}, {"restart", json::array()}}));
  EXPECT_EQ(json::parse(ask("GET", "/api/change/sources?program=" + digest).text)["digest"], digest);
  EXPECT_EQ(fixture_.programs.changes, 0);
  EXPECT_TRUE(state()["versions"].empty());
}

TEST_F(ChangeRoutesTest, WhenWhatIsBroughtIsNoProgram_ThenItIsRefusedInWords) {
  EXPECT_EQ(code(bring({first_.begin(), first_.begin() + 200})), "400 B0003");
  EXPECT_EQ(code(bring(Bytes(50, std::byte{7}))), "400 B0001");
  Bytes flipped = next_;
  flipped[flipped.size() / 2] ^= std::byte{0xFF};
  EXPECT_EQ(bring(flipped).status, 400u);
  EXPECT_EQ(code(bring(next_, "../up.swb")), "400 H0094");
  EXPECT_EQ(code(ask("POST", "/api/change/check", {{"name", "a.swb"}, {"container", "no base64!"}})),
            "400 H0094");
  EXPECT_EQ(code(ask("POST", "/api/change/check", json::object())), "400 H0094");
  EXPECT_EQ(code(ask("POST", "/api/change/check",
                     {{"name", "a"}, {"container", "AAAA"}, {"files", {{"a.st", "x"}}}})),
            "400 H0094");
  EXPECT_EQ(code(ask("GET", "/api/change/diff?program=" + std::string(64, 'a'))), "404 H0091");
  EXPECT_EQ(code(ask("GET", "/api/change/diff?program=../../etc/passwd")), "404 H0091");
}

TEST_F(ChangeRoutesTest, WhenEveryByteOfAContainerIsCutOff_ThenNoneIsTaken) {
  for (std::size_t length = 1; length < next_.size(); length += 37)
    EXPECT_EQ(bring({next_.begin(), next_.begin() + static_cast<std::ptrdiff_t>(length)}).status, 400u)
        << length;
}

TEST_F(ChangeRoutesTest, WhenSourcesAreWrong_ThenEachProblemHasItsPlaceInItsFile) {
  const json files = {{"files", {{"main.st", "PROGRAM"}, {"more.st", "x"}}}};
  const Answer refused = ask("POST", "/api/change/check", files);
  EXPECT_EQ(refused.status, 400u);
  EXPECT_EQ(json::parse(refused.text)["problems"][0], (json{{"code", "E0201"},
                                                            {"message", "'speeed' is not declared"},
                                                            {"hint", "did you mean 'speed'?"},
                                                            {"severity", "error"},
                                                            {"file", "main.st"},
                                                            {"line", 3},
                                                            {"column", 7}}));
  fixture_.programs.compiled_to = std::make_unique<Bytes>(next_);
  const Answer taken = ask("POST", "/api/change/check", files);
  ASSERT_EQ(taken.status, 200u) << taken.text;
  EXPECT_EQ(json::parse(taken.text)["name"], "main.st, more.st");
  EXPECT_EQ(json::parse(taken.text)["warnings"][0]["file"], "a.st");
  EXPECT_EQ(fixture_.programs.compiled.at("more.st"), "x");
}

TEST_F(ChangeRoutesTest, WhenASourceIsTooLong_ThenItIsRefused) {
  EXPECT_EQ(
      code(ask("POST", "/api/change/check", {{"files", {{"a.st", std::string(kMostSourceBytes + 1, 'x')}}}})),
      "400 H0033");
  json files;
  for (std::size_t i = 0; i <= kMostSources; ++i) files[std::to_string(i)] = "x";
  EXPECT_EQ(code(ask("POST", "/api/change/check", {{"files", files}})), "400 H0033");
}

TEST_F(ChangeRoutesTest, WhenItTakesOver_ThenBothProgramsAreKeptAndTheTrailHasTheOutcome) {
  ASSERT_EQ(bring(next_).status, 200u);
  const Answer done = apply(next_, first_, "restart");
  ASSERT_EQ(done.status, 200u) << done.text;
  EXPECT_TRUE(fixture_.programs.restarted);
  const json record = json::parse(done.text);
  EXPECT_EQ(record["outcome"], "trial");
  EXPECT_EQ(record["takeover"]["carried"], 7);
  EXPECT_EQ(record["takeover"]["pause_us"], 5.5);
  EXPECT_EQ(code(apply(first_, next_)), "409 H0098") << "one trial at a time";
  fixture_.changes->turn();
  EXPECT_EQ(state()["newest"]["outcome"], "trial");
  fixture_.programs.end(Trial::State::Kept);
  fixture_.changes->turn();
  fixture_.changes->turn();
  const json now = state();
  EXPECT_EQ(now["newest"]["outcome"], "kept");
  ASSERT_EQ(now["versions"].size(), 2u);
  EXPECT_EQ(now["versions"][0]["program"], FakeChange::digest_of(next_));
  EXPECT_EQ(now["versions"][0]["outcome"], "kept");
  EXPECT_EQ(now["versions"][0]["user"], "engineer");
  EXPECT_EQ(now["versions"][0]["reason"], "a new limit");
  EXPECT_EQ(now["versions"][1]["outcome"], "found");
  const auto entries = trail();
  const auto& last = entries.back();
  EXPECT_EQ(last["action"], "change.outcome");
  EXPECT_EQ(last["result"], "kept");
  EXPECT_EQ(last["user"], "engineer");
  EXPECT_EQ(last["before"], FakeChange::digest_of(first_));
  EXPECT_EQ(last["after"], FakeChange::digest_of(next_));
  EXPECT_NE(entries[entries.size() - 2]["action"], "change.outcome") << "told once";
}

TEST_F(ChangeRoutesTest, WhenTheRuntimeRollsBack_ThenTheVersionAndTheTrailSayWhy) {
  ASSERT_EQ(bring(next_).status, 200u);
  ASSERT_EQ(apply(next_, first_).status, 200u);
  fixture_.programs.end(Trial::State::RolledBack, "p.st:3:1: division by zero");
  fixture_.changes->turn();
  EXPECT_EQ(state()["newest"]["why"], "p.st:3:1: division by zero");
  EXPECT_EQ(state()["versions"][0]["outcome"], "rolled_back");
  EXPECT_EQ(trail().back()["result"], "rolled back by the runtime: p.st:3:1: division by zero");
  EXPECT_EQ(trail().back()["after"], FakeChange::digest_of(first_));
}

TEST_F(ChangeRoutesTest, WhenAnEarlierProgramIsWanted_ThenItComesBackTheSameWay) {
  ASSERT_EQ(bring(next_).status, 200u);
  ASSERT_EQ(apply(next_, first_).status, 200u);
  fixture_.programs.end(Trial::State::Kept);
  fixture_.changes->turn();
  const std::string first = FakeChange::digest_of(first_);
  EXPECT_EQ(json::parse(ask("GET", "/api/change/diff?program=" + first).text)["lists"]["removed"]["count"],
            1);
  ASSERT_EQ(apply(first_, next_).status, 200u);
  fixture_.programs.end(Trial::State::Kept);
  fixture_.changes->turn();
  EXPECT_EQ(state()["running"], first);
  EXPECT_EQ(state()["versions"].size(), 2u);
  EXPECT_EQ(state()["versions"][0]["program"], first);
}

TEST_F(ChangeRoutesTest, WhenItCannotBe_ThenNothingHappensAndNothingIsKept) {
  ASSERT_EQ(bring(next_).status, 200u);
  EXPECT_EQ(code(apply(next_, next_)), "409 H0092") << "compared with another program than the one that runs";
  EXPECT_EQ(code(ask("POST", "/api/change/apply", order(first_, first_))), "409 H0097");
  EXPECT_EQ(code(apply(program("unknown : INT;"), first_)), "404 H0091");
  fixture_.programs.supervisor = "its run is in the phase 'executing'";
  EXPECT_EQ(code(apply(next_, first_)), "409 H0093");
  const json seen = json::parse(ask("GET", "/api/change/diff?program=" + FakeChange::digest_of(next_)).text);
  EXPECT_EQ(seen["refusals"]["now"][0]["code"], "H0093");
  EXPECT_EQ(state()["engaged"], "its run is in the phase 'executing'");
  fixture_.programs.supervisor = "";
  fixture_.programs.running = false;
  EXPECT_EQ(code(apply(next_, first_)), "409 R0031");
  fixture_.programs.running = true;
  fixture_.programs.refusal = "R0033";
  EXPECT_EQ(code(apply(next_, first_)), "409 R0033");
  EXPECT_EQ(fixture_.programs.changes, 0);
  EXPECT_TRUE(state()["versions"].empty()) << "a change that was refused leaves no version";
  EXPECT_TRUE(state()["newest"].is_null());
  EXPECT_EQ(trail().back()["result"], "refused: R0033: as the test wants it");
}

TEST_F(ChangeRoutesTest, WhenNobodyAnswersAChange_ThenBothProgramsAreKeptAsItMayHaveHappened) {
  ASSERT_EQ(bring(next_).status, 200u);
  fixture_.programs.refusal = "D0001";
  EXPECT_EQ(code(apply(next_, first_)), "503 D0001");
  const json versions = state()["versions"];
  ASSERT_EQ(versions.size(), 2u);
  EXPECT_EQ(versions[0]["outcome"], "unknown");
  EXPECT_EQ(versions[1]["outcome"], "found");
}

TEST_F(ChangeRoutesTest, WhenARefusedProgramWasKeptBefore_ThenItsVersionIsAsItWas) {
  ASSERT_EQ(bring(next_).status, 200u);
  ASSERT_EQ(apply(next_, first_).status, 200u);
  fixture_.programs.end(Trial::State::Kept);
  fixture_.changes->turn();
  const json before = state()["versions"];
  fixture_.programs.refusal = "R0036";
  EXPECT_EQ(code(apply(first_, next_)), "409 R0036");
  const json after = state()["versions"];
  for (const auto& each : after) {
    EXPECT_TRUE(std::find(before.begin(), before.end(), each) != before.end()) << each;
  }
}

TEST_F(ChangeRoutesTest, WhenAVersionsFileIsDamaged_ThenItIsNotBroughtBack) {
  ASSERT_EQ(bring(next_).status, 200u);
  ASSERT_EQ(apply(next_, first_).status, 200u);
  fixture_.programs.end(Trial::State::Kept);
  fixture_.changes->turn();
  const auto file = fixture_.folder / "programs" / (FakeChange::digest_of(first_) + ".version");
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 3);
  EXPECT_EQ(code(apply(first_, next_)), "409 H0095");
  EXPECT_EQ(fixture_.programs.changes, 1);
}

TEST_F(ChangeRoutesTest, WhenNoRuntimeAnswers_ThenThatIsSaid) {
  ASSERT_EQ(bring(next_).status, 200u);
  RequestGuardFixture without;
  EXPECT_EQ(
      json::parse(without.ask("GET", "/api/change", "", without.session(Role::Engineer)).text)["running"],
      "");
}

TEST_F(ChangeRoutesTest, WhenTooManyWait_ThenTheOldestIsForgotten) {
  for (std::size_t i = 0; i <= kMostCandidates; ++i)
    ASSERT_EQ(bring(program("v" + std::to_string(i) + " : INT;")).status, 200u);
  EXPECT_EQ(code(apply(program("v0 : INT;"), first_)), "404 H0091");
  EXPECT_EQ(apply(program("v1 : INT;"), first_).status, 200u);
}

}  // namespace
}  // namespace stepwright::api
