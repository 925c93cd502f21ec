#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace stepwright::print {
namespace {

class ShowCommand : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("show_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  // Exit code; what it printed is in `output_`.
  int show(const std::string& arguments) {
    output_.clear();
    const std::string command =
        std::string(STEPWRIGHT_BIN_DIR) + "/stepwright-show show " + arguments + " 2>&1";
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return -1;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output_ += static_cast<char>(c);
    return WEXITSTATUS(pclose(pipe));
  }

  std::filesystem::path folder_;
  std::string output_;
};

constexpr const char* kGood = "PROGRAM p\nVAR x : BOOL; END_VAR\nx := NOT x;\nEND_PROGRAM\n";

TEST_F(ShowCommand, WhenProgramIsSound_ThenItIsPrinted) {
  const std::string path = file("a.st", kGood);
  EXPECT_EQ(show(path), 0);
  EXPECT_NE(output_.find("    3  x := NOT x;"), std::string::npos) << output_;
  const std::string svg = (folder_ / "a.svg").string();
  EXPECT_EQ(show(path + " --pou P --to svg -o " + svg), 0) << output_;
  EXPECT_TRUE(std::filesystem::exists(svg));
}

TEST_F(ShowCommand, WhenSourceIsWrong_ThenTheMistakeIsLocatedAndNothingIsWritten) {
  const std::string out = (folder_ / "a.txt").string();
  EXPECT_EQ(show(file("a.st", "PROGRAM p\nx := ;\nEND_PROGRAM\n") + " -o " + out), 1);
  EXPECT_NE(output_.find("a.st:2:6: error E01"), std::string::npos) << output_;
  // As `compile` says it: with a last line that counts.
  EXPECT_NE(output_.find("1 error; `stepwright explain E01"), std::string::npos) << output_;
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_EQ(show(file("b.st",
                      "PROGRAM p\nSTEP A: END_STEP\nTRANSITION FROM A TO B := TRUE; END_TRANSITION\n"
                      "END_PROGRAM\n")),
            1);
  EXPECT_NE(output_.find("b.st:3:"), std::string::npos) << output_;
  EXPECT_EQ(show(file("c.xml", "<project>")), 1);
  EXPECT_NE(output_.find("c.xml:1:"), std::string::npos) << output_;
}

TEST_F(ShowCommand, WhenFilesOrNamesAreMissing_ThenItSaysWhich) {
  const std::string path = file("a.st", kGood);
  EXPECT_EQ(show((folder_ / "none.st").string()), 1);
  EXPECT_NE(output_.find("none.st: error E0001"), std::string::npos) << output_;
  EXPECT_EQ(show(path + " -o " + (folder_ / "no" / "a.txt").string()), 1);
  EXPECT_NE(output_.find("E0002"), std::string::npos) << output_;
  EXPECT_EQ(show(path + " --pou q"), 1);
  EXPECT_NE(output_.find("E0003"), std::string::npos) << output_;
}

TEST_F(ShowCommand, WhenCommandLineIsWrong_ThenUsageIsSaid) {
  EXPECT_EQ(show(""), 2);
  EXPECT_EQ(show(file("a.st", kGood) + " --to pdf"), 2);
  EXPECT_EQ(show("--help"), 0);
}

TEST_F(ShowCommand, WhenFileIsEmpty_ThenNothingFails) {
  EXPECT_EQ(show(file("a.st", "")), 0);
  EXPECT_EQ(show(file("a.st", "") + " --to svg"), 0);
}

}  // namespace
}  // namespace stepwright::print
