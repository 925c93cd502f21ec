#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cell/device_status/status_socket.h"
#include "cell/modbus_client/client_metrics.h"
#include "cell/modbus_client/status_json.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::modbus_client {
namespace {

using modbus::client::DeviceStatus;
using modbus::client::Quality;

DeviceStatus press() {
  DeviceStatus device;
  device.name = "pr\"ess";
  device.endpoint = "10.0.0.7:502";
  device.unit = 3;
  device.online = true;
  device.counters.requests = 12;
  device.counters.timeouts = 2;
  device.counters.answer.record(3'000'000);
  device.groups.push_back({"fast", 100, 10, 1, {}});
  device.groups.back().period.record(120'000'000);
  device.tags.push_back(
      {"level", "%IW0", false, 12.5, Quality::Good, 40, std::chrono::system_clock::time_point{}});
  device.tags.push_back(
      {"flow", "%ID1", false, std::numeric_limits<double>::quiet_NaN(), Quality::NotConnected, -1, {}});
  return device;
}

TEST(Status, WhenItIsToldAsJson_ThenTagsHaveTheirQualityAndTime) {
  const auto json = to_json("cell", std::vector{press()});
  const auto& device = json.at("devices").at(0);
  EXPECT_EQ(device.at("unit"), 3);
  EXPECT_EQ(device.at("requests"), 12);
  const auto& level = device.at("tags").at(0);
  EXPECT_EQ(level.at("value"), 12.5);
  EXPECT_EQ(level.at("quality"), 192);
  EXPECT_EQ(level.at("age_ms"), 40);
  EXPECT_EQ(level.at("time"), "1970-01-01T00:00:00.000Z");
  const auto& flow = device.at("tags").at(1);
  EXPECT_TRUE(flow.at("value").is_null());
  EXPECT_FALSE(flow.contains("age_ms"));
  EXPECT_EQ(flow.at("quality_text"), "bad: not connected");
}

TEST(Status, WhenItIsToldToPeopleAndPrometheus_ThenItIsTheSame) {
  const auto json = to_json("cell", std::vector{press()});
  const std::string lines = to_lines(json);
  EXPECT_NE(lines.find("10.0.0.7:502 unit 3: online"), std::string::npos) << lines;
  EXPECT_NE(lines.find("12.5, good, 40 ms ago"), std::string::npos) << lines;
  EXPECT_NE(lines.find("no number, bad: not connected, never"), std::string::npos) << lines;
  const std::string figures = to_metrics(json);
  EXPECT_NE(figures.find("stepwright_modbus_timeouts_total{cell=\"cell\",device=\"pr\\\"ess\"} 2\n"),
            std::string::npos)
      << figures;
  const auto has = [&](const std::string& line) {
    return figures.find("\n" + line + "\n") != std::string::npos;
  };
  const std::string labels = "cell=\"cell\",device=\"pr\\\"ess\"";
  EXPECT_TRUE(has("stepwright_modbus_tag_quality{" + labels + ",tag=\"level\",address=\"%IW0\"} 192"))
      << figures;
  EXPECT_TRUE(has("stepwright_modbus_tags{" + labels + ",quality=\"good\"} 1"));
  EXPECT_TRUE(has("stepwright_modbus_tags{" + labels + ",quality=\"bad: not connected\"} 1"));
  EXPECT_TRUE(has("stepwright_modbus_tags{" + labels + ",quality=\"bad: no answer\"} 0"));
  EXPECT_TRUE(has("stepwright_modbus_device_online{" + labels + "} 1"));
  EXPECT_TRUE(has("stepwright_modbus_polls_total{" + labels + ",group=\"fast\"} 10"));
  EXPECT_TRUE(has("stepwright_modbus_poll_overruns_total{" + labels + ",group=\"fast\"} 1"));
  EXPECT_TRUE(has("stepwright_modbus_poll_period_seconds{" + labels + ",group=\"fast\"} 0.1"));
  EXPECT_TRUE(has("stepwright_modbus_poll_cycle_max_seconds{" + labels + ",group=\"fast\"} 0.12"));
  EXPECT_TRUE(has("stepwright_modbus_answer_max_seconds{" + labels + "} 0.003"));
}

TEST(StatusSocket, WhenSomebodyAsks_ThenTheTextIsWholeAndNobodyElseMay) {
  const support::TemporaryFolder folder;
  const auto socket = folder / "s.sock";
  const std::string long_text(3'000'000, 'x');
  {
    const auto server = device_status::StatusServer::create(socket, [&] { return long_text; });
    ASSERT_TRUE(server);
    for (int i = 0; i < 3; ++i) {
      const auto told = device_status::ask_status(socket);
      ASSERT_TRUE(told);
      EXPECT_EQ(*told, long_text);
    }
    const auto rights = std::filesystem::status(socket).permissions();
    EXPECT_EQ(rights & (std::filesystem::perms::group_all | std::filesystem::perms::others_all),
              std::filesystem::perms::none);
  }
  const auto nobody = device_status::ask_status(socket);
  ASSERT_FALSE(nobody);
  EXPECT_EQ(nobody.error()[0].code, "R0127");
}

// Somebody who asks, with a socket of before.
class Asking {
 public:
  Asking() : socket_(::socket(AF_UNIX, SOCK_STREAM, 0)) {}
  ~Asking() { close(socket_); }
  Asking(const Asking&) = delete;
  Asking& operator=(const Asking&) = delete;

  bool ask(const std::filesystem::path& path) const {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.native().copy(address.sun_path, sizeof address.sun_path - 1);
    return connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  bool answered_within(int milliseconds) const {
    pollfd waiting{socket_, POLLIN, 0};
    return poll(&waiting, 1, milliseconds) == 1;
  }

 private:
  int socket_;
};

TEST(StatusSocket, WhenThereAreNoDescriptorsForAWhile_ThenItAnswersAgainAfterwards) {
  const support::TemporaryFolder folder;
  const auto socket = folder / "s.sock";
  const auto server = device_status::StatusServer::create(socket, [] { return std::string("status"); });
  ASSERT_TRUE(server);
  const Asking first, second;
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const rlimit none{0, before.rlim_max};
  setrlimit(RLIMIT_NOFILE, &none);
  // An accept that waits has the descriptor that it will return, so that one of the two may be answered.
  const bool asked = first.ask(socket) && second.ask(socket);
  const bool answered = second.answered_within(300);
  setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_TRUE(asked);
  EXPECT_FALSE(answered);
  EXPECT_TRUE(second.answered_within(10'000));
  const auto told = device_status::ask_status(socket);
  ASSERT_TRUE(told) << result::to_string(told.error());
  EXPECT_EQ(*told, "status");
}

}  // namespace
}  // namespace stepwright::modbus_client
