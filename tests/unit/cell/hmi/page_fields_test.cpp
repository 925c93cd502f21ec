// The fields of a runtime's status and health on their way to the page, against the list by which they travel
// (runtime/service/internal/message_fields.h) and against the page's own types. A field that is added to the
// list has to reach the page, or to be named here.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "cell/hmi/scan_report.h"
#include "hmi_web/protocol/live_state.h"
#include "hmi_web/protocol/messages.h"
#include "hmi_web/server/cell_viewer.h"
#include "runtime/service/internal/message_fields.h"
#include "tests/support/typescript.h"

namespace stepwright::hmi {
namespace {

using nlohmann::json;

// Visits every number, text and choice of a message in the order of the list, and changes the one with that
// number.
class ChangeField {
 public:
  explicit ChangeField(std::size_t number) : number_(number) {}

  template <typename... T>
  void operator()(T&&... values) {
    (visit(values), ...);
  }
  const void* changed() const { return changed_; }

 private:
  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void visit(T& value) {
    if (!is_meant(value)) return;
    if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(static_cast<int>(value) + 1);
    } else if constexpr (std::is_same_v<T, bool>) {
      value = !value;
    } else {
      value = static_cast<T>(value + 1);
    }
  }
  void visit(std::string& text) {
    if (is_meant(text)) text += "a";
  }
  template <typename T>
  void visit(std::vector<T>& list) {
    for (T& each : list) visit(each);
  }
  template <typename T>
  void visit(service::internal::First<T>& bounded) {
    visit(bounded.value);
  }
  template <typename T>
  void visit(service::internal::AtMost<T>& bounded) {
    visit(bounded.value);
  }
  template <typename T>
  void visit(service::internal::Within<T>& bounded) {
    visit(bounded.value);
  }
  template <typename T>
  requires std::is_class_v<T>
  void visit(T& structure) { service::internal::fields(*this, structure); }

  bool is_meant(const auto& value) {
    if (next_++ != number_) return false;
    changed_ = &value;
    return true;
  }

  std::size_t number_;
  std::size_t next_ = 0;
  const void* changed_ = nullptr;
};

// One of each list, so that the fields of its elements are visited.
FollowedRuntime followed() {
  host::RuntimeStatus status;
  status.plant = {{"level", 1.0}};
  status.tasks = {{"fast", 1, 2, 3, 4, 5, {}, {}, {}}};
  FollowedRuntime runtime{.runtime = "bench", .own = true, .alive = true, .status = status};
  runtime.health.emplace();
  runtime.health->tasks = {{"fast", 5, 2, 1, 4, {1, {1}}, {1, {1}}, {1, {1}}}};
  runtime.health->devices = {
      {"valves", "10.0.0.2:502", 7, true, false, "", 1, 2, 3, 4, 5, 1.5, 2.5, 3.5, 40}};
  runtime.traffic = {{"stepwright/status/3", 1, 50, 0, 2, 0.05}};
  return runtime;
}

json scan_of(const FollowedRuntime& runtime) {
  return json::parse(scan_report(std::array{runtime}))["runtimes"][0];
}

json state_of(const FollowedRuntime& runtime) {
  server::Observation seen;
  seen.status = runtime.status;
  protocol::CellState state = server::CellViewer(std::vector<server::PointSources>{}).view(seen).state;
  state.unread = {{"valves", protocol::Unread::Lost, {0}}};
  protocol::LiveState live;
  live.take(state, 1, true);
  return json::parse(live.message({0, protocol::TagChoice::everything(), {}}));
}

// Everything that the page is told of a runtime.
std::string told(const FollowedRuntime& runtime) {
  return scan_of(runtime).dump() + state_of(runtime).dump();
}

// The places of the fields that the page is not told of.
std::vector<const void*> left_out(const FollowedRuntime& runtime) {
  const host::RuntimeStatus& status = *runtime.status;
  const host::TaskStatus& task = status.tasks[0];
  return {
      &status.incarnation,                                   // for whoever counts events
      &status.last_event,                                    // likewise
      &status.last_change_pause_us,                          // told of each change where it is made
      &status.plant[0].name,        &status.plant[0].value,  // a simulated plant comes with the image
      &task.latency.p9999_us,       &task.execution.p9999_us,
      &task.jitter.p9999_us,  // a histogram shows more
  };
}

template <typename Message>
void every_field_is_told(const std::function<Message&(FollowedRuntime&)>& message) {
  const std::string before = told(followed());
  std::size_t number = 0;
  while (true) {
    FollowedRuntime changed = followed();
    ChangeField change(number++);
    service::internal::fields(change, message(changed));
    if (change.changed() == nullptr) break;
    const auto silent = left_out(changed);
    const bool is_left_out = std::find(silent.begin(), silent.end(), change.changed()) != silent.end();
    EXPECT_EQ(told(changed) == before, is_left_out)
        << "field " << number << " of the list, with those inside";
  }
  EXPECT_GT(number, 20u);
}

TEST(PageFields, WhenAFieldOfTheStatusChanges_ThenThePageIsToldOrItIsNamedHere) {
  every_field_is_told<host::RuntimeStatus>([](FollowedRuntime & of) -> auto& { return *of.status; });
}

TEST(PageFields, WhenAFieldOfTheHealthChanges_ThenThePageIsTold) {
  every_field_is_told<dds::RuntimeHealth>([](FollowedRuntime & of) -> auto& { return *of.health; });
}

TEST(PageFields, WhenTheReportIsWritten_ThenThePageKnowsExactlyItsMembers) {
  const auto page = support::read_interfaces(STEPWRIGHT_SOURCE_DIR "/hmi_web/client/src/scan/figures.ts");
  ASSERT_TRUE(page.contains("Runtime"));
  EXPECT_EQ(support::difference(scan_of(followed()), page, "Runtime"), "");
}

TEST(PageFields, WhenTheStateIsWritten_ThenThePageKnowsExactlyItsMembers) {
  const auto page = support::read_interfaces(STEPWRIGHT_SOURCE_DIR "/hmi_web/client/src/lib/protocol.ts");
  ASSERT_TRUE(page.contains("StateMessage"));
  EXPECT_EQ(support::difference(state_of(followed()), page, "StateMessage"), "");
}

TEST(PageFields, WhenThePlantIsDescribed_ThenThePageKnowsExactlyItsMembers) {
  protocol::Synoptic plant;
  plant.points.resize(1);
  plant.places.resize(1);
  plant.vehicles.resize(1);
  plant.tanks.resize(1);
  plant.pumps.resize(1);
  plant.pipes.resize(1);
  plant.belts.resize(1);
  plant.beams.resize(1);
  plant.pushers.resize(1);
  plant.boxes.resize(1);
  plant.floor.maps.resize(1);
  plant.floor.forklifts.resize(1);
  plant.floor.pallets.resize(1);
  plant.floor.blockages.resize(1);
  const auto page = support::read_interfaces(STEPWRIGHT_SOURCE_DIR "/hmi_web/client/src/lib/protocol.ts");
  protocol::Greeting greeting{"bench", "1.0"};
  greeting.tags = {{.name = "Main.level",
                    .unit = "l",
                    .description = "of the tank",
                    .group = "tanks",
                    .decimals = 1,
                    .normal = std::pair(0.0, 9.0),
                    .values = {"low"}}};
  const json hello = json::parse(protocol::hello_message(greeting, plant, "7"));
  EXPECT_EQ(support::difference(hello, page, "HelloMessage"), "");
}

TEST(PageFields, WhenOnlyDifferencesAreWritten_ThenThePageKnowsExactlyTheirMembers) {
  const FollowedRuntime runtime = followed();
  server::Observation seen;
  seen.status = runtime.status;
  protocol::LiveState live;
  protocol::CellState state = server::CellViewer(std::vector<server::PointSources>{}).view(seen).state;
  live.take(state, 1, true);
  state.figures.overruns += 1;
  state.active_steps.push_back(3);
  live.take(state, 2, false);
  const auto page = support::read_interfaces(STEPWRIGHT_SOURCE_DIR "/hmi_web/client/src/lib/protocol.ts");
  ASSERT_TRUE(page.contains("DeltaMessage"));
  const json delta = json::parse(live.message({1, protocol::TagChoice::everything(), 7}));
  EXPECT_EQ(support::difference(delta, page, "DeltaMessage"), "");
  EXPECT_EQ(delta["type"], "delta");
  EXPECT_TRUE(delta.contains("figures") && delta.contains("steps")) << delta;
}

TEST(PageFields, WhenTheProgramIsDescribed_ThenThePageKnowsExactlyItsMembers) {
  const protocol::TagNote note{.name = {},
                               .unit = "l",
                               .description = {},
                               .group = "tanks",
                               .decimals = 1,
                               .normal = std::pair(0.0, 9.0),
                               .values = {"low"}};
  const protocol::Program program{.digest = "00",
                                  .charts = {{"main", 1, 1}},
                                  .steps = {{"s0", "idle", true}},
                                  .transitions = {{"t0", {0}, {0}, "go"}},
                                  .tags = {{"main.go", "BOOL", "%IX0.0", "by hand", 0, note}},
                                  .enumerations = {{{1, "RUNS"}}}};
  const auto page = support::read_interfaces(STEPWRIGHT_SOURCE_DIR "/hmi_web/client/src/lib/protocol.ts");
  // The number of the program is put in front of what is written once.
  const json message = json::parse(protocol::with_revision(protocol::program_message(program, {{0}}), 3));
  EXPECT_EQ(support::difference(message, page, "ProgramMessage"), "");
}

TEST(PageFields, WhenTrendsAreWritten_ThenThePageKnowsExactlyTheirMembers) {
  const std::vector<protocol::TrendRow> rows(1);
  const auto page = support::read_interfaces(STEPWRIGHT_SOURCE_DIR "/hmi_web/client/src/lib/protocol.ts");
  const json message = json::parse(protocol::trend_message(rows, {.run = 1, .first = 2, .restart = true}));
  EXPECT_EQ(support::difference(message, page, "TrendMessage"), "");
}

}  // namespace
}  // namespace stepwright::hmi
