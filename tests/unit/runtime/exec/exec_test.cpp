// The command as a user runs it: its exit codes, its messages, its report.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "runtime/bytecode/writer/container_writer.h"
#include "tests/support/sample_model.h"
#include "tests/support/test_program.h"

namespace stepwright {
namespace {

class ExecCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ("exec_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string write(const std::string& name, const std::vector<std::byte>& bytes) const {
    std::ofstream file(path(name), std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path(name);
  }

  // Runs the command and gives its exit code; `errors` is what it said.
  int run(const std::string& arguments) {
    const std::string command =
        STEPWRIGHT_BIN_DIR "/stepwright-exec exec " + arguments + " >" + path("out") + " 2>" + path("err");
    const int status = std::system(command.c_str());
    errors = text("err");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string text(const std::string& name) const {
    std::stringstream out;
    out << std::ifstream(path(name)).rdbuf();
    return out.str();
  }

  nlohmann::json report() const { return nlohmann::json::parse(text("report.json")); }

  static std::vector<std::byte> sample() { return writer::write_container(support::sample_model()).value(); }

  std::string errors;

 private:
  std::filesystem::path folder_;
};

TEST_F(ExecCommand, Run_WhenTracing_ThenTheReportHasOneValuePerScan) {
  const std::string image = write("a.swb", sample());
  ASSERT_EQ(run(image + " --scans 3 --trace MAIN.count,SLOW.n,pump,MAIN.level,MAIN.history[2] --json " +
                path("report.json")),
            0)
      << errors;
  const nlohmann::json json = report();
  EXPECT_EQ(json["engine"], "vm");
  EXPECT_EQ(json["scans"], 3);
  EXPECT_EQ(json["trace"]["MAIN.count"], nlohmann::json({1, 2, 3}));
  EXPECT_EQ(json["trace"]["SLOW.n"], nlohmann::json({101, 101, 102}));
  EXPECT_EQ(json["trace"]["pump"], nlohmann::json({false, false, false}));
  EXPECT_EQ(json["trace"]["MAIN.level"], nlohmann::json({0.0, 0.0, 0.0}));
  EXPECT_EQ(json["trace"]["MAIN.history[2]"], nlohmann::json({0, 0, 0}));
  EXPECT_TRUE(json["traps"].empty());
  EXPECT_EQ(json["image_hash"].get<std::string>().size(), 16u);
}

TEST_F(ExecCommand, Run_WhenATableIsAskedFor_ThenItHasARowPerScan) {
  const std::string image = write("a.swb", sample());
  ASSERT_EQ(run(image + " --scans 2 --trace main.COUNT,MAIN.level --csv " + path("t.csv")), 0) << errors;
  EXPECT_EQ(text("t.csv"),
            "scan,time_s,MAIN.count,MAIN.level\r\n1,0.000000000,1,0.0\r\n2,0.010000000,2,0.0\r\n");
  EXPECT_EQ(run(image + " --trace MAIN.levle --csv " + path("none.csv")), 1);
  EXPECT_NE(errors.find("did you mean `MAIN.level`"), std::string::npos) << errors;
  EXPECT_FALSE(std::filesystem::exists(path("none.csv")));
}

TEST_F(ExecCommand, Run_WhenRepeated_ThenTheReportsAreEqual) {
  const std::string image = write("a.swb", sample());
  ASSERT_EQ(run(image + " --scans 50 --json " + path("report.json")), 0);
  const nlohmann::json first = report();
  ASSERT_EQ(run(image + " --scans 50 --json " + path("report.json")), 0);
  EXPECT_EQ(report(), first);
}

// The counter reaches zero in the fourth scan: 12 / (3 - n) traps there.
TEST_F(ExecCommand, Run_WhenTheProgramTraps_ThenExitsWithFiveAndNamesScanAndLine) {
  writer::ContainerModel model = support::one_program(4, [](writer::FunctionBuilder& f) {
    f.line(0, 4);
    f.load(bytecode::MemType::I32, bytecode::AddressMode::This, 0);
    f.const_i32(1);
    f.emit(bytecode::Opcode::AddI32);
    f.store(bytecode::MemType::I32, bytecode::AddressMode::This, 0);
    f.line(0, 7);
    f.const_i32(12);
    f.const_i32(4);
    f.load(bytecode::MemType::I32, bytecode::AddressMode::This, 0);
    f.emit(bytecode::Opcode::SubI32);
    f.emit(bytecode::Opcode::DivI32);
    f.emit(bytecode::Opcode::Drop);
  });
  model.source_files = {"divide.st"};
  const std::string image = write("t.swb", writer::write_container(model).value());
  EXPECT_EQ(run(image + " --scans 10 --json " + path("report.json")), 5);
  EXPECT_NE(errors.find("divide.st:7: R0401: division by zero in MAIN"), std::string::npos) << errors;
  const nlohmann::json json = report();
  EXPECT_EQ(json["scans"], 4);
  ASSERT_EQ(json["traps"].size(), 1u);
  EXPECT_EQ(json["traps"][0]["scan"], 4);
  EXPECT_EQ(json["traps"][0]["code"], "division by zero");
  EXPECT_EQ(json["traps"][0]["id"], "R0401");
  EXPECT_EQ(json["traps"][0]["column"], 0);
  EXPECT_EQ(json["traps"][0]["file"], "divide.st");
  EXPECT_EQ(json["traps"][0]["line"], 7);
}

TEST_F(ExecCommand, Run_WhenTheImageIsWrong_ThenExitsWithOneAndSaysWhy) {
  const std::vector<std::byte> good = sample();
  const auto expect = [&](const std::string& image, const std::string& part) {
    EXPECT_EQ(run(image + " --json " + path("report.json")), 1);
    EXPECT_NE(errors.find(part), std::string::npos) << errors;
    EXPECT_NE(errors.find(image), std::string::npos) << errors;
    EXPECT_FALSE(std::filesystem::exists(path("report.json")));
  };
  expect(write("short.swb", {good.begin(), good.begin() + 500}), "truncated");
  std::vector<std::byte> flipped = good;
  flipped[500] ^= std::byte{1};
  expect(write("flipped.swb", flipped), "damaged");
  std::vector<std::byte> newer = good;
  newer[4] = std::byte{9};
  expect(write("newer.swb", newer), "version 9");
  expect(write("text.swb", std::vector<std::byte>(64, std::byte{'x'})), "not a Stepwright container");
  expect(write("empty.swb", {}), "not a Stepwright container");
  expect(path("missing.swb"), "cannot be read");
}

TEST_F(ExecCommand, Run_WhenATracedVariableIsUnknown_ThenExitsWithOne) {
  EXPECT_EQ(run(write("a.swb", sample()) + " --trace MAIN.nothing"), 1);
  EXPECT_NE(errors.find("MAIN.nothing"), std::string::npos) << errors;
}

TEST_F(ExecCommand, Run_WhenTheCommandLineIsWrong_ThenExitsWithTwo) {
  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(run(write("a.swb", sample()) + " --engine steam"), 2);
  EXPECT_EQ(run(write("a.swb", sample()) + " --scans many"), 2);
}

}  // namespace
}  // namespace stepwright
