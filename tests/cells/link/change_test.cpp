// Online change over the real processes: the command `stepwright download`, and a client on Fast DDS.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "ladder/driver/compile.h"
#include "tests/cells/link/test_cell.h"

namespace stepwright::cells {
namespace {

using dds::DownloadMode;
using dds::EventKind;
using dds::RuntimeState;

constexpr char kRealTime[] =
    "[clock]\nmode = \"real\"\n[plant]\nkind = \"none\"\n[change]\ntrial_scans = 5\n";

std::vector<std::byte> counting(const std::string& more, const std::string& body = "") {
  auto output =
      driver::compile({{{"count.st", "PROGRAM main\nVAR n : DINT; out AT %QB0 : USINT; END_VAR\n" + more +
                                         "n := n + 1; out := 17;\n" + body + "END_PROGRAM\n"}}});
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  return std::move(output->container);
}

// `stepwright download` of a container, and what came of it.
struct Downloaded {
  std::optional<int> exit;
  std::string output;
  std::string report;  // --json
};

Downloaded download(const TestCell& cell, const std::vector<std::byte>& container, const std::string& flag) {
  static int number = 0;
  const std::string name = (cell.folder() / ("program" + std::to_string(++number))).string();
  std::ofstream(name, std::ios::binary)
      .write(reinterpret_cast<const char*>(container.data()), static_cast<std::streamsize>(container.size()));
  std::vector<std::string> arguments{STEPWRIGHT_BIN_DIR "/stepwright",
                                     "download",
                                     "--config",
                                     cell.config().string(),
                                     name,
                                     "--json",
                                     name + ".json"};
  if (!flag.empty()) arguments.push_back(flag);
  support::TestProcess process(arguments, name + ".log");
  Downloaded result;
  result.exit = process.wait();
  result.output = process.output();
  std::ifstream report(name + ".json");
  result.report.assign(std::istreambuf_iterator<char>(report), {});
  return result;
}

TEST(DownloadCommand, WhenAProgramRuns_ThenItSaysWhatBecomesOfIt) {
  TestCell cell(87, kRealTime);
  const support::TestProcess runtime = cell.start_runtime();
  const Downloaded first = download(cell, counting(""), "");
  EXPECT_EQ(first.exit, 0) << first.output;
  EXPECT_NE(first.output.find("is loaded"), std::string::npos) << first.output;
  const auto client = cell.attach(service::Role::Controller);
  ASSERT_TRUE(client->call(service::Start{}, kPatience));

  const Downloaded careless = download(cell, counting(""), "");
  EXPECT_EQ(careless.exit, 1);
  EXPECT_NE(careless.output.find("R0039"), std::string::npos) << careless.output;

  const Downloaded changed = download(cell, counting("VAR pad : LINT; END_VAR\n"), "--change");
  EXPECT_EQ(changed.exit, 0) << changed.output;
  EXPECT_NE(changed.output.find("took over within"), std::string::npos) << changed.output;
  EXPECT_NE(changed.output.find("main.pad"), std::string::npos) << changed.output;
  EXPECT_NE(changed.report.find("\"carried\": 2"), std::string::npos) << changed.report;
  EXPECT_NE(changed.report.find("\"pause_us\""), std::string::npos) << changed.report;

  const Downloaded restarted = download(cell, counting(""), "--restart-charts");
  EXPECT_EQ(restarted.exit, 0) << restarted.output;
  std::vector<std::byte> damaged = counting("");
  damaged[damaged.size() / 2] ^= std::byte{1};
  EXPECT_EQ(download(cell, damaged, "--change").exit, 1);
  EXPECT_EQ(download(cell, counting(""), "--change --replace").exit, 2);
  EXPECT_EQ(download(cell, counting(""), "--replace").exit, 0);
  EXPECT_NE(download(cell, counting(""), "--change").output.find("R0031"), std::string::npos);
}

TEST(DownloadCommand, WhenNoRuntimeAnswers_ThenItSaysSo) {
  TestCell cell(88, kRealTime);
  const Downloaded lonely = download(cell, counting(""), "");
  EXPECT_EQ(lonely.exit, 5);
  EXPECT_NE(lonely.output.find("R0001"), std::string::npos) << lonely.output;
}

TEST(LinkChange, WhenAClientChangesTheProgram_ThenEventAndStatusTellItAndARollbackToo) {
  TestCell cell(89, kRealTime);
  const support::TestProcess runtime = cell.start_runtime();
  const support::TestProcess link = cell.start("link");
  const auto client = cell.connect();
  const auto first = client->download(counting(""));
  ASSERT_TRUE(ok(first));
  ASSERT_TRUE(ok(client->start({})));
  EXPECT_EQ(client->wait_event(kPatience)->kind, EventKind::Started);

  const auto changed = client->download(counting("VAR pad : LINT; END_VAR\n"), DownloadMode::Change);
  ASSERT_TRUE(ok(changed));
  EXPECT_EQ(changed->change.carried, 2u);
  EXPECT_FALSE(changed->notes.empty());
  const auto event = client->wait_event(kPatience);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::Changed);
  EXPECT_EQ(event->program_digest, changed->digest);
  EXPECT_TRUE(eventually([&] { return client->status()->program_digest == changed->digest; }));
  // The trial of the first change is over, so that the second one would not end it.
  const std::uint64_t scan = client->status()->scan;
  EXPECT_TRUE(eventually([&] { return client->status()->scan > scan + 10; }));

  const auto bad = client->download(counting("VAR zero : DINT; END_VAR\n", "n := n / zero;\n"),
                                    DownloadMode::ChangeRestartCharts);
  ASSERT_TRUE(ok(bad));
  EXPECT_EQ(client->wait_event(kPatience)->kind, EventKind::Changed);
  const auto back = client->wait_event(kPatience);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->kind, EventKind::RolledBack);
  EXPECT_EQ(back->program_digest, changed->digest);
  EXPECT_NE(back->detail.find("count.st:"), std::string::npos) << back->detail;
  EXPECT_TRUE(eventually([&] { return client->status()->program_digest == changed->digest; }));
  EXPECT_EQ(client->status()->state, RuntimeState::Running);
  EXPECT_EQ(client->program().value(), counting("VAR pad : LINT; END_VAR\n"));
}

}  // namespace
}  // namespace stepwright::cells
