#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "hmi_web/recorder/cell_alarms.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::recorder {
namespace {

using bytecode::ElementaryType;
using nlohmann::json;

std::shared_ptr<const server::ProgramLayout> program(const std::vector<std::string>& variables) {
  auto layout = std::make_shared<server::ProgramLayout>();
  for (const std::string& name : variables) {
    const auto address = static_cast<std::uint32_t>(4 * layout->tags.size());
    layout->program.tags.push_back({name, "DINT", ""});
    layout->tags.push_back({ElementaryType::Dint, address, bytecode::kNoBit});
  }
  return layout;
}

alarms::AlarmDefinition alarm(std::string name, std::string source, std::string suppress_when = {}) {
  alarms::AlarmDefinition one;
  one.name = std::move(name);
  one.source = std::move(source);
  one.suppress_when = std::move(suppress_when);
  return one;
}

class MissingSourceTest : public testing::Test {
 protected:
  void open(std::vector<alarms::AlarmDefinition> definitions) {
    auto made = CellAlarms::open(folder_ / "alarms.db", std::move(definitions),
                                 {{"a1.level", "A1", "%", true}}, {}, 0, notes_);
    ASSERT_TRUE(made.has_value()) << result::to_string(made.error());
    alarms_ = std::move(*made);
  }
  // A program with these variables, all of that value; null: the runtime does not answer.
  void look(const std::shared_ptr<const server::ProgramLayout>& layout, std::int32_t value = 0,
            std::optional<double> level = 50.0, std::uint64_t scan = 1) {
    server::Observation seen;
    server::CellView view;
    seen.runtime_alive = layout != nullptr;
    seen.layout = view.layout = layout;
    seen.unread = unread_;
    if (layout) {
      std::vector<std::byte> image(4 * layout->tags.size());
      for (std::size_t i = 0; i < layout->tags.size(); ++i)
        std::memcpy(image.data() + 4 * i, &value, sizeof value);
      seen.snapshot = server::ImageSnapshot{scan, 0.0, image, {}};
    }
    view.state.points = {level};
    alarms_->take({time_ns_ += 1'000'000'000, &seen, &view});
  }
  json listed(bool all = false) const {
    const json told = json::parse(alarms_->json(all));
    json by_name = json::object();
    for (const json& one : told["alarms"]) by_name[one["name"].get<std::string>()] = one;
    return by_name;
  }
  json figure(const char* name = "no_value") const {
    return json::parse(alarms_->json(false))["figures"][name];
  }

  support::TemporaryFolder folder_;
  std::unique_ptr<CellAlarms> alarms_;
  std::int64_t time_ns_ = 0;
  std::vector<protocol::TagNote> notes_;
  std::vector<server::UnreadInputs> unread_;
};

TEST_F(MissingSourceTest, WhenTheProgramHasNoSuchVariable_ThenItsAlarmIsNotNormalAndSaysWhy) {
  open({alarm("good", "main.level"), alarm("misspelt", "main.levle")});
  look(program({"main.level"}));
  EXPECT_EQ(listed(true)["good"]["state"], "normal");
  EXPECT_EQ(listed(true)["good"]["problem"], "");
  ASSERT_TRUE(listed().contains("misspelt")) << "it stands among those that are not normal";
  EXPECT_EQ(listed()["misspelt"]["state"], "no variable");
  EXPECT_EQ(listed()["misspelt"]["problem"], "the program has no variable 'main.levle'");
  EXPECT_EQ(figure("no_variable"), 1);
  EXPECT_EQ(figure(), 0);
}

TEST_F(MissingSourceTest, WhenTheDeviceOfAnInputDoesNotAnswer_ThenItsValueRaisesNothing) {
  open({alarm("first", "main.first"), alarm("second", "main.second")});
  unread_ = {{"drive", protocol::Unread::Lost, {{ElementaryType::Int, 6, bytecode::kNoBit}}}};
  look(program({"main.first", "main.second"}), 1);
  EXPECT_EQ(listed()["first"]["state"], "unacknowledged") << "another device";
  EXPECT_EQ(listed()["second"]["state"], "no value");
  EXPECT_EQ(listed()["second"]["problem"], "the device of 'main.second' does not answer");
  unread_.clear();
  look(program({"main.first", "main.second"}), 1);
  EXPECT_EQ(listed()["second"]["state"], "unacknowledged");
}

TEST_F(MissingSourceTest, WhenAValueIsNoNumber_ThenItIsNotNormal) {
  open({alarm("high", "a1.level")});
  look(program({"main.level"}), 0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(listed()["high"]["state"], "no value");
  EXPECT_EQ(listed()["high"]["problem"], "'a1.level' has no value");
  look(program({"main.level"}), 0, 50.0);
  EXPECT_EQ(listed(true)["high"]["problem"], "");
}

TEST_F(MissingSourceTest, WhenTheProgramHasNotScannedYet_ThenItsValuesRaiseNothing) {
  open({alarm("on", "main.on")});
  look(program({"main.on"}), 1, 50.0, 0);
  EXPECT_EQ(listed()["on"]["state"], "no value");
  EXPECT_EQ(listed()["on"]["problem"], "'main.on' has no value");
  look(program({"main.on"}), 1, 50.0, 1);
  EXPECT_EQ(listed()["on"]["state"], "unacknowledged");
}

TEST_F(MissingSourceTest, WhenNoImageIsThereForAMoment_ThenAVariableThatIsGoneIsNotThereAgain) {
  const std::vector<std::pair<std::string, std::string>> gone = {{"high", "main.high"}};
  open({alarm("high", "main.high")});
  look(nullptr);
  EXPECT_TRUE(alarms_->without_variable().empty()) << "nobody knows yet";
  look(program({"main.low"}));
  EXPECT_EQ(alarms_->without_variable(), gone);
  look(nullptr);
  EXPECT_EQ(alarms_->without_variable(), gone);
  look(program({"main.other"}));
  EXPECT_EQ(alarms_->without_variable(), gone);
  look(program({"main.high"}));
  EXPECT_TRUE(alarms_->without_variable().empty());
}

TEST_F(MissingSourceTest,
       WhenAnOnlineChangeTakesTheVariableAway_ThenPagesAreToldAndTheAlarmIsNoLongerNormal) {
  open({alarm("high", "main.high"), alarm("low", "main.low")});
  look(program({"main.high", "main.low"}));
  EXPECT_EQ(listed().size(), 0u);
  const std::uint64_t before = alarms_->revision();
  look(program({"main.low"}));
  EXPECT_GT(alarms_->revision(), before);
  EXPECT_EQ(listed()["high"]["state"], "no variable");
  EXPECT_EQ(alarms_->without_variable(),
            (std::vector{std::pair<std::string, std::string>("high", "main.high")}));
  EXPECT_FALSE(listed().contains("low"));
  const std::uint64_t after = alarms_->revision();
  look(program({"main.low"}));
  EXPECT_EQ(alarms_->revision(), after) << "once";
  look(program({"main.high", "main.low"}));
  EXPECT_EQ(listed(true)["high"]["state"], "normal") << "it is back";
  EXPECT_TRUE(alarms_->without_variable().empty());
}

TEST_F(MissingSourceTest, WhenAnAlarmWasRaisedBefore_ThenItStaysSoAndTheReasonIsTold) {
  open({alarm("high", "main.high")});
  look(program({"main.high"}), 1);
  look(program({"main.other"}));
  EXPECT_EQ(listed()["high"]["state"], "unacknowledged");
  EXPECT_EQ(listed()["high"]["problem"], "the program has no variable 'main.high'");
  const auto done = alarms_->command("high", {.event = alarms::AlarmEvent::Acknowledge, .user = "anna"});
  ASSERT_TRUE(done.has_value());
  EXPECT_EQ(done->after, "no variable") << "what can never return does not stand acknowledged for ever";
  EXPECT_EQ(listed()["high"]["state"], "no variable");
  look(program({"main.high"}));
  EXPECT_EQ(listed(true)["high"]["state"], "normal") << "it is back, and not high";
}

TEST_F(MissingSourceTest, WhenAlarmsStandUnacknowledged_ThenThoseAndNoOthersAreHandedOut) {
  alarms::AlarmDefinition told = alarm("high", "main.high");
  told.words["de"] = {"voll", "", "leeren"};
  open({told, alarm("low", "main.low")});
  look(program({"main.high", "main.low"}));
  EXPECT_TRUE(alarms_->unacknowledged().empty());
  look(program({"main.high", "main.other"}), 1);
  ASSERT_EQ(alarms_->unacknowledged().size(), 1u);
  EXPECT_EQ(alarms_->unacknowledged()[0].definition.name, "high");
  EXPECT_EQ(alarms_->unacknowledged()[0].view.raised_ns, time_ns_);
  EXPECT_EQ(listed()["high"]["words"]["de"]["response"], "leeren");
  EXPECT_FALSE(listed()["low"].contains("words"));
  ASSERT_TRUE(alarms_->command("high", {.event = alarms::AlarmEvent::Acknowledge, .user = "anna"}));
  EXPECT_TRUE(alarms_->unacknowledged().empty());
}

TEST_F(MissingSourceTest, WhenTheSourceIsABool_ThenThatIsHandedOutToo) {
  open({alarm("hot", "main.hot"), alarm("count", "main.count")});
  auto layout = std::make_shared<server::ProgramLayout>(*program({"main.hot", "main.count"}));
  layout->tags[0].type = ElementaryType::Bool;
  layout->tags[0].bit = 0;
  look(layout, 1);
  ASSERT_EQ(alarms_->unacknowledged().size(), 2u);
  EXPECT_TRUE(alarms_->unacknowledged()[0].told.is_bool);
  EXPECT_FALSE(alarms_->unacknowledged()[1].told.is_bool);
}

TEST_F(MissingSourceTest, WhenTheSourceIsDescribed_ThenItsValueIsToldSo) {
  notes_.resize(1);
  notes_[0].name = "Main.level";
  notes_[0].unit = "l";
  notes_[0].decimals = 2;
  open({alarm("full", "main.level"), alarm("lost", std::string(kServerAway))});
  look(program({"main.level"}), 95);
  ASSERT_EQ(alarms_->unacknowledged().size(), 1u);
  EXPECT_EQ(alarms_->unacknowledged()[0].told.text, "95.00 l");
  EXPECT_EQ(alarms_->unacknowledged()[0].told.unit, "l");
  EXPECT_EQ(alarms_->told("main.level", 7).text, "7.00 l");
  EXPECT_EQ(alarms_->told(std::string(kServerAway), 1).text, "") << "that number says nothing";
}

TEST_F(MissingSourceTest, WhenATimeIsWatched_ThenItsLimitIsInSeconds) {
  alarms::AlarmDefinition late = alarm("late", "main.delay");
  late.condition.kind = alarms::ConditionKind::High;
  late.condition.limit = 60;
  open({late});
  auto layout = std::make_shared<server::ProgramLayout>(*program({"main.delay", "main.upper"}));
  layout->tags[0].type = ElementaryType::Time;
  look(layout, 0x0F);  // about 64 s: of the upper half of the nanoseconds 15
  ASSERT_EQ(alarms_->unacknowledged().size(), 1u);
  EXPECT_EQ(alarms_->unacknowledged()[0].told.text, "1 min 4 s");
  look(layout, 0x0D);
  EXPECT_EQ(listed()["late"]["active"], false);
}

TEST_F(MissingSourceTest, WhenNoImageIsThere_ThenNoAlarmCountsAsNormalAndTheListStaysShort) {
  open({alarm("high", "main.high"), alarm("fault", std::string(kRuntimeFault))});
  EXPECT_EQ(figure(), 2) << "before the first look";
  look(nullptr);
  EXPECT_EQ(listed().size(), 0u);
  EXPECT_EQ(figure(), 2);
  EXPECT_EQ(listed(true)["high"]["state"], "no value");
  EXPECT_EQ(listed(true)["fault"]["state"], "no value") << "nobody knows whether it is one";
}

TEST_F(MissingSourceTest, WhenAPointHasNoValueOrASuppressorIsMissing_ThenThatIsTold) {
  open({alarm("level", "a1.level"), alarm("idle", "main.level", "main.cleaning")});
  look(program({"main.level"}), 0, std::nullopt);
  EXPECT_EQ(listed()["level"]["problem"], "'a1.level' has no value");
  EXPECT_EQ(listed(true)["idle"]["state"], "normal");
  EXPECT_EQ(listed(true)["idle"]["problem"],
            "the program has no variable 'main.cleaning', which would suppress it");
}

}  // namespace
}  // namespace stepwright::recorder
