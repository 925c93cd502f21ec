#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "ladder/driver/compile.h"
#include "runtime/service/connection.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_process.h"

namespace stepwright::cells {
namespace {

using support::kPatience;
using support::TestProcess;
using namespace std::chrono_literals;

constexpr char kProgram[] = R"(
TYPE Mode : (Manual, Auto, Off); END_TYPE
TYPE Point : STRUCT x : REAL; n : INT; END_STRUCT; END_TYPE
PROGRAM MAIN
  VAR
    lamp AT %QX0.2 : BOOL;
    count : DINT;
    levels : ARRAY[0..4] OF INT;
    grid : ARRAY[0..1, 0..2] OF REAL;
    timer : TON;
    mode : Mode;
    point : Point;
    speed : LREAL;
    mask : WORD;
    name : STRING[20] := 'a,"b"';
    delay : TIME := T#250ms;
  END_VAR
  count := count + 1;
  lamp := (count MOD 3) = 0;
  levels[3] := levels[3] + 1;
  timer(IN := TRUE, PT := delay);
  speed := speed + 0.1;
  point.x := point.x * 1.5 + 1.0;
  IF point.x > 1000.0 THEN point.x := 0.0; END_IF;
END_PROGRAM
)";

constexpr char kStill[] = "[clock]\nmode = \"simulated\"\nspeed = 20.0\n";
constexpr char kReal[] = "[clock]\nmode = \"real\"\n";

// A runtime without a plant, and the commands beside it.
class Monitor : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  // Starts a runtime and, unless told otherwise, the program in it.
  void start(const std::string& config, const char* program = kProgram, bool running = true) {
    std::ofstream(path("cell.toml")) << "[cell]\nname = \"monitortest\"\nstate_dir = \"state\"\n"
                                     << "[plant]\nkind = \"none\"\n"
                                     << config;
    runtime_.emplace(
        std::vector<std::string>{STEPWRIGHT_BIN_DIR "/stepwright", "runtime", "--config", path("cell.toml")},
        path("runtime.log"));
    ASSERT_TRUE(runtime_->wait_for("listens on")) << runtime_->output();
    auto connection = service::Connection::open(path("state/runtime.sock"),
                                                {.role = service::Role::Controller, .name = "test"});
    ASSERT_TRUE(connection) << result::to_string(connection.error());
    client_ = std::move(*connection);
    ASSERT_TRUE(client_->download(compiled(program), kPatience));
    if (!running) return;
    ASSERT_TRUE(client_->call(service::Start{}, kPatience));
  }

  static std::vector<std::byte> compiled(const char* program) {
    driver::CompileInput input;
    input.texts.push_back({"main.st", program});
    auto output = driver::compile(input);
    EXPECT_TRUE(output) << result::to_string(output.error());
    return output ? std::move(output->container) : std::vector<std::byte>();
  }
  TestProcess beside(const std::string& command, const std::vector<std::string>& arguments) {
    std::vector<std::string> line = {STEPWRIGHT_BIN_DIR "/stepwright", command, "--config",
                                     path("cell.toml")};
    line.insert(line.end(), arguments.begin(), arguments.end());
    return TestProcess(line, path(command + ".log"));
  }

  // Runs a command on the cell; its exit code. `out` and `err` are what it said.
  int run(const std::string& command, const std::string& arguments) {
    return run_plain(command, "--config " + path("cell.toml") + " " + arguments);
  }
  int run_plain(const std::string& command, const std::string& arguments) {
    const std::string line = STEPWRIGHT_BIN_DIR "/stepwright " + command + " " + arguments + " >" +
                             path("out") + " 2>" + path("err");
    const int status = std::system(line.c_str());
    out = text("out");
    err = text("err");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string text(const std::string& name) const {
    std::stringstream text;
    text << std::ifstream(path(name)).rdbuf();
    return text.str();
  }
  nlohmann::json json() const { return nlohmann::json::parse(text("report.json")); }
  // All values of one scan.
  nlohmann::json values() {
    EXPECT_EQ(run("snapshot", "--json " + path("report.json")), 0) << err;
    return json()["values"];
  }
  // A figure of the recording that is under way.
  std::uint64_t recorded(const char* figure) {
    EXPECT_EQ(run("record", "--status --json " + path("report.json")), 0) << err;
    return json()[figure];
  }
  static bool eventually(const std::function<bool()>& condition) {
    for (const auto end = std::chrono::steady_clock::now() + kPatience; !condition();) {
      if (std::chrono::steady_clock::now() > end) return false;
    }
    return true;
  }

  const support::TemporaryFolder folder_;
  std::optional<TestProcess> runtime_;
  std::unique_ptr<service::Connection> client_;
  std::string out;
  std::string err;
};

TEST_F(Monitor, WhenVariablesOfEveryTypeAreForced_ThenTheyHoldAndAreListed) {
  start(kStill);
  const std::vector<std::array<const char*, 3>> forces = {
      {"MAIN.count", "-12", "-12"},        {"main.levels[3]", "16#7F", "127"},
      {"'MAIN.grid[1, 2]'", "2.5", "2.5"}, {"MAIN.timer.PT", "T#1s", "T#1s"},
      {"MAIN.mode", "Auto", "Auto"},       {"MAIN.point.n", "7", "7"},
      {"MAIN.speed", "1E3", "1000.0"},     {"MAIN.mask", "16#ABCD", "43981"},
      {"%QX0.2", "TRUE", "TRUE"},          {"MAIN.delay", "T#2s", "T#2s"},
  };
  for (const auto& [name, value, shown] : forces) {
    EXPECT_EQ(run("force", std::string(name) + " " + value), 0) << name << err;
    EXPECT_NE(out.find(std::string("is forced to ") + shown), std::string::npos) << out;
  }
  ASSERT_EQ(run("forces", "--json " + path("report.json")), 0) << err;
  EXPECT_EQ(json()["forces"].size(), forces.size());
  EXPECT_NE(out.find("MAIN.grid[1][2] = 2.5"), std::string::npos) << out;
  EXPECT_NE(out.find("MAIN.lamp = TRUE"), std::string::npos) << out;  // %QX0.2 by its name
  EXPECT_NE(out.find("10 of 64 places"), std::string::npos) << out;
  const nlohmann::json now = values();
  EXPECT_EQ(now["MAIN.count"], -12);
  EXPECT_EQ(now["MAIN.speed"], 1000.0);
  EXPECT_EQ(now["MAIN.lamp"], true);
  EXPECT_EQ(run("unforce", "MAIN.count"), 0) << err;
  EXPECT_EQ(run("unforce", "MAIN.count"), 1);  // it is not forced any more
  EXPECT_EQ(run("unforce", "--all"), 0) << err;
  EXPECT_NE(out.find("9 variables"), std::string::npos) << out;
  ASSERT_EQ(run("forces", "--json " + path("report.json")), 0);
  EXPECT_TRUE(json()["forces"].empty());
}

TEST_F(Monitor, WhenAForceHasATime_ThenItIsToldAndEndsByItself) {
  start(kStill);
  ASSERT_EQ(run("force", "--seconds 3600 MAIN.mask 5"), 0) << err;
  ASSERT_EQ(run("forces", "--json " + path("report.json")), 0) << err;
  EXPECT_NE(out.find("MAIN.mask = 5, for another 3"), std::string::npos) << out;
  EXPECT_GT(json()["forces"][0]["left_s"], 1'800.0);
  ASSERT_EQ(run("force", "--seconds 0.1 MAIN.mask 5"), 0) << err;
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  do ASSERT_EQ(run("forces", "--json " + path("report.json")), 0) << err;
  while (!json()["forces"].empty() && std::chrono::steady_clock::now() < deadline);
  EXPECT_TRUE(json()["forces"].empty());
  ASSERT_EQ(run("force", "MAIN.mask 5"), 0) << err;
  ASSERT_EQ(run("forces", "--json " + path("report.json")), 0) << err;
  EXPECT_TRUE(json()["forces"][0]["left_s"].is_null());
}

// Where the first program has `named` the second has `foreign`, which nobody names. Either the force came
// first and ended with its program, or it was looked up again.
TEST_F(Monitor, WhenForcedBesideDownloads_ThenNoForeignVariableIsForced) {
  constexpr char kFirst[] = "PROGRAM MAIN VAR named, count : DINT; END_VAR count := count + 1; END_PROGRAM";
  constexpr char kSecond[] =
      "PROGRAM MAIN VAR foreign, count, named : DINT; END_VAR count := count + 1; END_PROGRAM";
  start(kReal, kFirst, false);
  const std::vector<std::byte> first = compiled(kFirst);
  const std::vector<std::byte> second = compiled(kSecond);
  std::ofstream(path("second.swb"), std::ios::binary)
      .write(reinterpret_cast<const char*>(second.data()), static_cast<std::streamsize>(second.size()));
  const std::vector<std::string> download = {path("second.swb"), "--replace"};
  const std::vector<std::string> force = {"MAIN.named", "7", "--seconds", "3600"};
  for (int round = 0; round < 12; ++round) {
    ASSERT_TRUE(client_->download(first, kPatience));
    TestProcess one = round % 2 == 0 ? beside("force", force) : beside("download", download);
    TestProcess other = round % 2 == 0 ? beside("download", download) : beside("force", force);
    ASSERT_EQ(one.wait(), 0) << one.output();
    ASSERT_EQ(other.wait(), 0) << other.output();
    EXPECT_EQ(values()["MAIN.foreign"], 0) << round;
    ASSERT_EQ(run("forces", "--json " + path("report.json")), 0) << err;
    const auto report = json();
    for (const auto& place : report["forces"]) EXPECT_EQ(place["name"], "MAIN.named") << round;
  }
}

TEST_F(Monitor, WhenItIsStoppedAndStarted_ThenItRunsAgain) {
  start(kReal, kProgram, false);
  EXPECT_EQ(run("start", ""), 0) << err;
  EXPECT_NE(run("start", ""), 0) << "it runs already";
  EXPECT_NE(err.find("R0002"), std::string::npos) << err;
  EXPECT_EQ(run("stop", ""), 0) << err;
  EXPECT_EQ(run("start", "--cold"), 0) << err;
  EXPECT_NE(out.find("initial values"), std::string::npos) << out;
}

TEST_F(Monitor, WhenAForceIsWrong_ThenItIsRefusedWithAHintAndNothingIsForced) {
  start(kStill);
  const std::vector<std::array<const char*, 3>> wrong = {
      {"MAIN.cuont", "1", "did you mean `MAIN.count`"}, {"MAIN.levels", "1", "MAIN.levels[0]"},
      {"MAIN.levels[5]", "1", "did you mean"},          {"MAIN.count", "3.5", "DINT"},
      {"MAIN.mode", "Fast", "Manual Auto Off"},         {"MAIN.name", "\"'x'\"", "cannot be forced"},
      {"%QX9.0", "TRUE", "beyond the outputs"},         {"MAIN.point.n", "40000", "INT"},
  };
  for (const auto& [name, value, said] : wrong) {
    EXPECT_EQ(run("force", std::string(name) + " " + value), 1) << name;
    EXPECT_NE(err.find(said), std::string::npos) << name << ": " << err;
  }
  EXPECT_EQ(run("force", "MAIN.count"), 2);
  EXPECT_EQ(run("unforce", ""), 2);
  ASSERT_EQ(run("forces", ""), 0);
  EXPECT_NE(out.find("0 of 64"), std::string::npos);
}

TEST_F(Monitor, WhenNoRuntimeRuns_ThenEveryCommandSaysSo) {
  std::ofstream(path("cell.toml")) << "[cell]\nstate_dir = \"state\"\n";
  for (const char* command : {"force MAIN.x 1", "unforce MAIN.x", "forces", "watch MAIN.x", "snapshot",
                              "step", "continue", "record x", "trace MAIN.x --csv x"}) {
    const std::string line = command;
    const std::size_t space = std::min(line.find(' '), line.size());
    EXPECT_EQ(run(line.substr(0, space), line.substr(space)), 1) << command;
    EXPECT_NE(err.find("R0001"), std::string::npos) << command << err;
  }
}

TEST_F(Monitor, WhenItIsWatched_ThenChangedValuesAreMarkedAndSamplesAreOfOneScan) {
  start(kStill);
  std::ofstream(path("list")) << "# more\nMAIN.levels[3]\nMAIN.name\n";
  ASSERT_EQ(run("watch",
                "MAIN.count --list " + path("list") + " --period 20 --count 5 --json " + path("report.json")),
            0)
      << err;
  const nlohmann::json samples = json()["samples"];
  ASSERT_EQ(samples.size(), 5u);
  for (const auto& sample : samples) {
    EXPECT_EQ(sample["values"]["MAIN.count"], sample["scan"]);
    EXPECT_EQ(sample["values"]["MAIN.levels[3]"], sample["scan"]);
    EXPECT_EQ(sample["values"]["MAIN.name"], "a,\"b\"");
  }
  EXPECT_NE(out.find(" *"), std::string::npos) << out;
  std::ofstream(path("list")) << "\n\n  MAIN.cuont\n";
  EXPECT_EQ(run("watch", "--list " + path("list")), 1);
  EXPECT_NE(err.find("list:3:3: R0057"), std::string::npos) << err;
}

TEST_F(Monitor, WhenItIsStepped_ThenItStandsAndTheChangesAreShown) {
  start(kStill);
  ASSERT_EQ(run("step", "0 --json " + path("report.json")), 0) << err;
  const std::uint64_t at = json()["scan"];
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(values()["MAIN.count"], at);
  ASSERT_EQ(run("step", "3 --changes --json " + path("report.json")), 0) << err;
  EXPECT_EQ(json()["scan"], at + 3);
  ASSERT_EQ(json()["steps"].size(), 3u);
  EXPECT_EQ(json()["steps"][0]["changes"][0]["from"], std::to_string(at));
  EXPECT_NE(out.find("MAIN.count: " + std::to_string(at) + " -> " + std::to_string(at + 1)),
            std::string::npos)
      << out;
  EXPECT_EQ(values()["MAIN.count"], at + 3);
  EXPECT_EQ(run("continue", ""), 0) << err;
  EXPECT_TRUE(eventually([&] { return values()["MAIN.count"] > at + 3; }));
}

TEST_F(Monitor, WhenTheProgramDoesNotRun_ThenStepSaysWhyItStands) {
  start(kStill, kProgram, false);
  ASSERT_EQ(run("step", "2"), 0) << err;
  EXPECT_NE(out.find("does not run"), std::string::npos) << out;
}

TEST_F(Monitor, WhenTheClockIsReal_ThenAStepIsRefused) {
  start(kReal);
  EXPECT_EQ(run("step", ""), 1);
  EXPECT_NE(err.find("in real time nothing stands still"), std::string::npos) << err;
}

TEST_F(Monitor, WhenItIsRecordedInRealTime_ThenTheReplayIsEqualOnBothEngines) {
  start(kReal);
  ASSERT_EQ(
      run("record", path("run.swrec") + " --seconds 1 --keyframe-every 10 --json " + path("report.json")), 0)
      << err;
  const std::uint64_t scans = json()["scans"];
  EXPECT_GT(scans, 20u);
  EXPECT_EQ(json()["gaps"], 0);
  ASSERT_EQ(run_plain("replay", path("run.swrec") + " --json " + path("report.json")), 0) << out << err;
  EXPECT_EQ(json()["engines"].size(), 2u);
  const auto report = json();
  for (const auto& engine : report["engines"]) {
    EXPECT_EQ(engine["scans"], scans);
    EXPECT_TRUE(engine["equal"]);
    EXPECT_GT(engine["realtime_factor"], 1.0);
  }
  EXPECT_EQ(json()["engines"][0]["trace_hash"], json()["engines"][1]["trace_hash"]);
  // A table on the way, up to a scan.
  const std::uint64_t first = json()["engines"][0]["first_scan"];
  ASSERT_EQ(run_plain("replay", path("run.swrec") + " --engine vm --until " + std::to_string(first + 4) +
                                    " --trace MAIN.count --csv " + path("t.csv")),
            0)
      << err;
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(std::ifstream(path("t.csv")).rdbuf()), {}, '\n'), 6);
  EXPECT_EQ(run_plain("replay", path("run.swrec") + " --trace MAIN.cuont --csv " + path("t.csv")), 1);
  EXPECT_NE(err.find("did you mean `MAIN.count`"), std::string::npos) << err;
}

TEST_F(Monitor, WhenARecordingIsDetached_ThenItIsEndedByAnotherCommand) {
  start(kStill);
  ASSERT_EQ(run("record", path("run.swrec") + " --detach"), 0) << err;
  EXPECT_EQ(run("record", path("other.swrec")), 1);
  EXPECT_NE(err.find("R0052"), std::string::npos) << err;
  EXPECT_EQ(run("record", "--status"), 0);
  EXPECT_EQ(out.rfind("recording", 0), 0u) << out;
  EXPECT_EQ(run("force", "MAIN.count 5"), 0) << err;
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(run("record", "--stop"), 0) << err;
  EXPECT_EQ(out.rfind("done", 0), 0u) << out;
  ASSERT_EQ(run_plain("replay", path("run.swrec") + " --json " + path("report.json")), 0) << err;
  EXPECT_EQ(json()["engines"][0]["commands"], 1);
}

TEST_F(Monitor, WhenTheRuntimeIsKilled_ThenItsRecordingIsReplayedWithAWarning) {
  start(std::string(kStill) + "[record]\nfile = \"run.swrec\"\n");
  ASSERT_TRUE(eventually([&] { return recorded("scans") > 20; }));
  // Recorded is not yet written: the file itself says when they are there.
  const auto in_file = [&] {
    return run_plain("replay", path("state/run.swrec") + " --json " + path("report.json")) == 0 &&
           json()["engines"][0]["scans"] > 20;
  };
  ASSERT_TRUE(eventually(in_file)) << out << err;
  runtime_->kill();
  ASSERT_EQ(run_plain("replay", path("state/run.swrec") + " --json " + path("report.json")), 0) << out << err;
  EXPECT_NE(err.find("R0053"), std::string::npos) << err;
  EXPECT_GT(json()["engines"][0]["scans"], 20);
  // One byte of it changed: refused there, with its place.
  std::fstream file(path("state/run.swrec"), std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(100);
  file.put('\x55');
  file.close();
  EXPECT_EQ(run_plain("replay", path("state/run.swrec")), 1);
  EXPECT_NE(err.find("run.swrec: R0053"), std::string::npos) << err;
  EXPECT_NE(err.find("at byte 16"), std::string::npos) << err;
}

TEST_F(Monitor, WhenItIsTraced_ThenTheTableHasEveryScan) {
  start(kReal);
  ASSERT_EQ(run("trace", "MAIN.count MAIN.timer.ET MAIN.name %QX0.2 --seconds 0.5 --csv " + path("t.csv")), 0)
      << err;
  std::ifstream table(path("t.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "scan,time_s,MAIN.count,MAIN.timer.ET [s],MAIN.name,%QX0.2\r");
  std::uint64_t before = 0;
  std::uint64_t rows = 0;
  while (std::getline(table, line)) {
    std::uint64_t scan = 0;
    double time_s = 0.0;
    std::uint64_t count = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lu,%lf,%lu", &scan, &time_s, &count), 3) << line;
    EXPECT_EQ(scan, count);
    EXPECT_NE(line.find(",\"a,\"\"b\"\"\","), std::string::npos) << line;
    EXPECT_EQ(scan, before == 0 ? scan : before + 1);
    before = scan;
    ++rows;
  }
  EXPECT_GT(rows, 10u);
  EXPECT_EQ(run("trace", "MAIN.cuont --csv " + path("t.csv")), 1);
  EXPECT_NE(err.find("did you mean"), std::string::npos);
  EXPECT_EQ(run("trace", "--csv " + path("t.csv")), 1);
  EXPECT_NE(err.find("nothing to trace"), std::string::npos);
  // Nothing of its recording is left.
  for (const auto& entry : std::filesystem::directory_iterator(path("state"))) {
    EXPECT_NE(entry.path().extension(), ".swrec");
  }
}

}  // namespace
}  // namespace stepwright::cells
