// Values and programs that outlive a runtime process, however that ended.

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <span>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/record/retain_store.h"
#include "tests/cells/link/test_cell.h"

namespace stepwright::cells {
namespace {

using namespace std::chrono_literals;

constexpr char kReal[] = "[plant]\nkind = \"none\"\n[clock]\nmode = \"real\"\n[retain]\nperiod_ms = 5\n";

// Counts its scans twice: `total` is retained, `here` is not.
std::vector<std::byte> counting_program(const std::string& more = "",
                                        std::span<const driver::Watcher> watchers = {}) {
  const std::string text =
      "PROGRAM MAIN\nVAR RETAIN total : DINT; twice : DINT; END_VAR VAR here : DINT; END_VAR\n" + more +
      "total := total + 1; twice := 2 * total; here := here + 1;\nEND_PROGRAM\n"
      "CONFIGURATION C RESOURCE R ON PLC\nTASK fast (INTERVAL := T#1ms, PRIORITY := 0);\n"
      "PROGRAM MAIN WITH fast : MAIN;\nEND_RESOURCE END_CONFIGURATION\n";
  auto output = driver::compile({.texts = {{"counting.st", text}}, .watchers = watchers});
  EXPECT_TRUE(output) << (output ? "" : result::to_string(output.error()));
  return output ? std::move(output->container) : std::vector<std::byte>{};
}

double value(const std::vector<std::byte>& container, const std::string& path,
             const std::vector<std::byte>& image) {
  const auto info = reader::ProgramInfo::read(container);
  return info ? reader::read_number(*info->find(path), image) : -1.0;
}

std::int32_t stored_total(const TestCell& cell) {
  const auto found = record::RetainStore::read(cell.folder() / "state" / "retain.store");
  if (!found || !*found) return -1;
  std::int32_t total = 0;
  std::memcpy(&total, (*found)->payload.data() + (*found)->layout.find("MAIN.total")->address, sizeof total);
  return total;
}

// The image at the stop.
std::vector<std::byte> stop(service::Connection& client) {
  EXPECT_TRUE(ok(client.call(service::Stop{"test"}, kPatience)));
  while (true) {
    const auto message = client.receive(kPatience);
    if (!message) return {};
    const auto* event = std::get_if<dds::StepEvent>(&*message);
    if (event != nullptr && event->kind == host::EventKind::Stopped) return event->image;
  }
}

host::RuntimeStatus status(service::Connection& client) {
  while (true) {
    const auto message = client.receive(kPatience);
    if (!message) return {};
    if (const auto* found = std::get_if<host::RuntimeStatus>(&*message)) return *found;
  }
}

TEST(RetainProcess, WhenTheRuntimeIsKilled_ThenTheNextOneGoesOnWithProgramAndValues) {
  TestCell cell(91, std::string(kReal) + "[runtime]\nboot = true\nautostart = true\n");
  const std::vector<std::byte> container = counting_program();
  {
    TestProcess runtime = cell.start_runtime();
    const auto client = cell.attach(service::Role::Controller);
    ASSERT_TRUE(ok(client->download(container, kPatience)));
    ASSERT_TRUE(ok(client->call(service::Start{}, kPatience)));
    ASSERT_TRUE(eventually([&] { return stored_total(cell) > 20; }));
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(cell.folder() / "state" / "boot.swb"); }));
    runtime.kill();
  }
  for (int i = 0; i < 3; ++i) {
    const std::int32_t left = stored_total(cell);
    TestProcess runtime = cell.start_runtime();
    // Further than it was, while nobody has asked for anything.
    ASSERT_TRUE(eventually([&] { return stored_total(cell) > left + 5; })) << runtime.output();
    const auto client = cell.attach(service::Role::Controller, 1);
    const std::vector<std::byte> image = stop(*client);
    const double total = value(container, "MAIN.total", image);
    EXPECT_EQ(value(container, "MAIN.twice", image), 2 * total);
    EXPECT_EQ(total - value(container, "MAIN.here", image), left);
    ASSERT_TRUE(eventually([&] { return stored_total(cell) == total; }));
    runtime.kill();
  }
}

TEST(RetainProcess, WhenTheRuntimeEndsInOrder_ThenTheFinalValuesAreThere) {
  TestCell cell(
      92, std::string("[plant]\nkind = \"none\"\n[clock]\nmode = \"real\"\n[retain]\nperiod_ms = 3600000\n"));
  const std::vector<std::byte> container = counting_program();
  std::ofstream(cell.folder() / "line.swb", std::ios::binary)
      .write(reinterpret_cast<const char*>(container.data()), static_cast<std::streamsize>(container.size()));
  std::ofstream(cell.config(), std::ios::app) << "[runtime]\nprogram = \"line.swb\"\nautostart = true\n";
  TestProcess runtime = cell.start_runtime();
  {
    const auto client = cell.attach(service::Role::Observer);
    ASSERT_TRUE(eventually([&] { return status(*client).scan > 20; }));
  }
  EXPECT_LE(stored_total(cell), 1);  // of the first scan; the period is an hour
  runtime.send(SIGTERM);
  EXPECT_EQ(runtime.wait(), 0);
  EXPECT_GT(stored_total(cell), 20);
}

TEST(RetainProcess, WhenTheStartIsCold_ThenItCountsFromTheBeginning) {
  TestCell cell(93, kReal);
  const std::vector<std::byte> container = counting_program();
  const TestProcess runtime = cell.start_runtime();
  const auto client = cell.attach(service::Role::Controller, 1);
  ASSERT_TRUE(ok(client->download(container, kPatience)));
  ASSERT_TRUE(ok(client->call(service::Start{}, kPatience)));
  ASSERT_TRUE(eventually([&] { return stored_total(cell) > 20; }));
  stop(*client);
  ASSERT_TRUE(ok(client->call(service::Start{.cold = true}, kPatience)));
  const std::vector<std::byte> image = stop(*client);
  EXPECT_EQ(value(container, "MAIN.total", image), value(container, "MAIN.here", image));
}

TEST(RetainProcess, WhenTheBootProgramIsWrong_ThenItSaysWhereAndWaitsForADownload) {
  TestCell cell(94, std::string(kReal) + "[runtime]\nboot = true\nautostart = true\n");
  std::filesystem::create_directories(cell.folder() / "state");
  std::ofstream(cell.folder() / "state" / "boot.swb") << "no program";
  const TestProcess runtime = cell.start_runtime();
  EXPECT_TRUE(runtime.wait_for("boot.swb: B000")) << runtime.output();
  const auto client = cell.attach(service::Role::Controller);
  EXPECT_NE(status(*client).detail.find("boot.swb"), std::string::npos);
  ASSERT_TRUE(ok(client->download(counting_program(), kPatience)));
  ASSERT_TRUE(ok(client->call(service::Start{}, kPatience)));
  EXPECT_TRUE(eventually([&] { return status(*client).scan > 5; }));
}

TEST(RetainProcess, WhenTheBootProgramLacksAMonitorOfTheCell_ThenItIsRefusedAndADownloadIsWaitedFor) {
  TestCell cell(99, std::string(kReal) +
                        "[runtime]\nprogram = \"line.swb\"\nautostart = true\n"
                        "[[monitors]]\nname = \"few\"\nformula = \"never many\"\n"
                        "let = { many = \"MAIN.here > 100000\" }\n");
  const std::vector<std::byte> container = counting_program();
  std::ofstream(cell.folder() / "line.swb", std::ios::binary)
      .write(reinterpret_cast<const char*>(container.data()), static_cast<std::streamsize>(container.size()));
  const TestProcess runtime = cell.start_runtime();
  EXPECT_TRUE(runtime.wait_for("C0558")) << runtime.output();
  const auto client = cell.attach(service::Role::Controller);
  const host::RuntimeStatus said = status(*client);
  EXPECT_NE(said.detail.find("the program does not have the monitor 'few'"), std::string::npos)
      << said.detail;
  EXPECT_NE(said.detail.find("line.swb"), std::string::npos) << said.detail;
  EXPECT_EQ(said.scan, 0u);
  const driver::Watcher few{.name = "monitor_few",
                            .text =
                                "PROGRAM monitor_few\nVAR Failed : BOOL; END_VAR\nFailed := MAIN.here > "
                                "100000;\nEND_PROGRAM\n",
                            .outside_reads = 1};
  ASSERT_TRUE(ok(client->download(counting_program("", std::span(&few, 1)), kPatience)));
  ASSERT_TRUE(ok(client->call(service::Start{}, kPatience)));
  EXPECT_TRUE(eventually([&] { return status(*client).scan > 5; }));
}

TEST(RetainProcess, WhenTheProgramIsThatOfTheConfiguration_ThenItIsNotKeptAsADownload) {
  TestCell cell(97, std::string(kReal) + "[runtime]\nboot = true\nprogram = \"line.swb\"\n");
  const std::vector<std::byte> container = counting_program();
  std::ofstream(cell.folder() / "line.swb", std::ios::binary)
      .write(reinterpret_cast<const char*>(container.data()), static_cast<std::streamsize>(container.size()));
  TestProcess runtime = cell.start_runtime();
  const auto client = cell.attach(service::Role::Controller);
  ASSERT_TRUE(ok(client->call(service::Start{}, kPatience)));
  ASSERT_TRUE(ok(client->call(service::Stop{"test"}, kPatience)));
  const std::filesystem::path kept = cell.folder() / "state" / "boot.swb";
  EXPECT_FALSE(std::filesystem::exists(kept));
  ASSERT_TRUE(ok(client->download(counting_program("VAR more : INT; END_VAR\n"), kPatience)));
  runtime.send(SIGTERM);
  EXPECT_EQ(runtime.wait(), 0);
  EXPECT_TRUE(std::filesystem::exists(kept));  // it is kept when the process ends, at the latest
}

TEST(RetainProcess, WhenTheStoreIsDamaged_ThenItIsKeptAsideAndTheStatusSaysSo) {
  TestCell cell(95, kReal);
  std::filesystem::create_directories(cell.folder() / "state");
  std::ofstream(cell.folder() / "state" / "retain.store") << "SWRETAIN and no more";
  const TestProcess runtime = cell.start_runtime();
  const auto client = cell.attach(service::Role::Controller);
  const std::string detail = status(*client).detail;
  EXPECT_NE(detail.find("R0023"), std::string::npos) << detail;
  EXPECT_TRUE(std::filesystem::exists(cell.folder() / "state" / "retain.store.damaged"));
  ASSERT_TRUE(ok(client->download(counting_program(), kPatience)));
  ASSERT_TRUE(ok(client->call(service::Start{}, kPatience)));
  EXPECT_TRUE(eventually([&] { return stored_total(cell) > 5; }));
}

TEST(RetainProcess, WhenThePolicyIsRefuse_ThenAProgramThatDoesNotFitIsNotStarted) {
  TestCell cell(96, std::string(kReal) + "policy = \"refuse\"\n");
  const TestProcess runtime = cell.start_runtime();
  const auto client = cell.attach(service::Role::Controller);
  ASSERT_TRUE(ok(client->download(counting_program(), kPatience)));
  ASSERT_TRUE(ok(client->call(service::Start{}, kPatience)));
  ASSERT_TRUE(eventually([&] { return stored_total(cell) > 5; }));
  ASSERT_TRUE(ok(client->download(counting_program("VAR RETAIN more : INT; END_VAR\n"), kPatience)));
  const auto refused = client->call(service::Start{}, kPatience);
  ASSERT_FALSE(refused && refused->accepted());
  const auto& problems = refused ? refused->problems : refused.error();
  EXPECT_EQ(problems[0].code, "R0025");
  EXPECT_NE(problems[0].message.find("MAIN.more"), std::string::npos);
  ASSERT_TRUE(ok(client->call(service::Start{.cold = true}, kPatience)));
}

// A folder in its place stands for a disk without room.
TEST(BootProcess, WhenTheProgramCannotBeKept_ThenThatIsSaidAndTriedAgainUntilItIs) {
  TestCell cell(98, std::string(kReal) + "[runtime]\nboot = true\n");
  const std::filesystem::path kept = cell.folder() / "state" / "boot.swb";
  TestProcess runtime = cell.start_runtime();
  std::filesystem::create_directory(kept);
  const auto client = cell.attach(service::Role::Controller);
  const std::vector<std::byte> container = counting_program();
  ASSERT_TRUE(client->download(container, kPatience));
  EXPECT_TRUE(eventually(
      [&] { return status(*client).detail.find("not kept for the next start") != std::string::npos; }));
  std::filesystem::remove(kept);
  EXPECT_TRUE(eventually([&] { return std::filesystem::is_regular_file(kept); }));
  EXPECT_EQ(std::filesystem::file_size(kept), container.size());
  EXPECT_TRUE(eventually([&] { return status(*client).detail.find("not kept") == std::string::npos; }));
}

}  // namespace
}  // namespace stepwright::cells
