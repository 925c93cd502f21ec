#include "supervisor/translate/binding.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "bench_run.h"

namespace stepwright::translate {
namespace {

// A binding without faults, to be spoilt in one place by each test.
const std::string kGood = R"toml([times]
start_s = 1.0
[tags]
here = { address = "%IX0.0" }
there = { address = "%IX0.1" }
L = { address = "%IW1", type = "INT" }
left = { address = "%QX0.0" }
right = { address = "%QX0.1" }
[sensors.L1]
tag = "L"
fluent = "(lev v1)"
calibration = [[0, 100], [10, 1100]]
[[facts]]
fact = "(is-at v1 f1)"
tag = "here"
[[facts]]
fact = "(is-at v1 a1)"
tag = "there"
[[one_of]]
facts = ["(is-at v1 f1)", "(is-at v1 a1)"]
search = [{ output = "left", timeout_s = 5 }]
[[exclusive]]
outputs = ["left", "right"]
[[actions]]
action = "(move ?v ?from ?to)"
outputs = ["left"]
until = { fact = "(is-at ?v ?to)" }
hold = []
timeout_s = 10
[[actions]]
action = "(load ?v ?f ?l)"
outputs = ["right"]
until = { fluent = "(lev ?v)", pre_act = 0.1 }
hold = ["(is-at ?v ?f)"]
timeout_s = 10
transfers = [{ from = "(lev ?v)", to = "(received ?f)" }]
duration = { fixed_s = 1, per_unit_s = 2, of = "(lev ?v)" }
)toml";

model::Vocabulary vocabulary() {
  model::Vocabulary names;
  names.actions = {{"move", 3}, {"load", 3}};
  names.predicates = {{"is-at", 2}};
  names.functions = {{"lev", 1}, {"received", 1}};
  names.objects = {"v1", "f1", "a1"};
  return names;
}

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = kGood;
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

struct Slip {
  const char* name;
  const char* from;
  const char* to;
  const char* code;
  const char* message;  // part of the first diagnostic
  const char* hint;     // part of its hint
  std::uint32_t line;   // 0: not known
};

void PrintTo(const Slip& slip, std::ostream* out) {
  *out << slip.name;
}

class BindingSlip : public ::testing::TestWithParam<Slip> {};

TEST_P(BindingSlip, WhenRead_ThenIsReportedOnceWithPlaceAndHint) {
  const Slip& slip = GetParam();
  const model::Vocabulary names = vocabulary();
  const auto binding = read_binding(replaced(slip.from, slip.to), "b.toml", &names);
  ASSERT_FALSE(binding);
  const result::Diagnostic& first = binding.error().front();
  EXPECT_EQ(binding.error().size(), 1U) << to_string(binding.error());
  EXPECT_EQ(first.code, slip.code);
  EXPECT_EQ(first.where.file, "b.toml");
  EXPECT_EQ(first.where.line, slip.line) << to_string(first);
  EXPECT_NE(first.message.find(slip.message), std::string::npos) << first.message;
  EXPECT_NE(first.hint.find(slip.hint), std::string::npos) << first.hint;
}

const std::vector<Slip> kSlips = {
    {"Syntax", "[times]", "[times", "B0001", "", "TOML", 1},
    {"UnknownKey", "pre_act", "pre_akt", "B0002", "actions.until.pre_akt", "pre_act", 33},
    {"UnknownSection", "[[exclusive]]", "[[exclusiv]]", "B0002", "exclusiv", "exclusive", 22},
    {"WrongType", "start_s = 1.0", "start_s = \"1\"", "B0003", "times.start_s", "", 2},
    {"NegativeTimeout", "hold = []\ntimeout_s = 10", "hold = []\ntimeout_s = -10", "B0004", "timeout_s",
     "between", 29},
    {"NegativeRate", "fluent = \"(lev v1)\"\n", "fluent = \"(lev v1)\"\nmax_rate = -1\n", "B0004", "max_rate",
     "between", 12},
    {"MissingTimeout", "hold = []\ntimeout_s = 10", "hold = []", "B0005", "timeout_s", "", 24},
    {"MissingUntil", "until = { fact = \"(is-at ?v ?to)\" }\n", "", "B0005", "until", "fluent", 24},
    {"UntilBoth", "{ fact = \"(is-at ?v ?to)\" }", "{ fact = \"(is-at ?v ?to)\", fluent = \"(lev ?v)\" }",
     "B0006", "one fact or one fluent", "", 27},
    {"BadAddress", "%IX0.1", "%IX0.9", "B0006", "'%IX0.9' is not an address", "%IX0.0", 5},
    {"AddressOfOtherSize", "\"%IW1\"", "\"%IX4.1\"", "B0006", "does not fit the type INT", "W", 6},
    {"UnknownType", "type = \"INT\"", "type = \"INTEGER\"", "B0006", "INTEGER", "INT", 6},
    {"Overlap", "\"%IX0.1\"", "\"%IX2.3\"", "B0008", "overlaps 'there'", "%IW1", 6},
    {"KeywordTag", "here = {", "while = { address = \"%IX0.5\" }\nhere = {", "B0006", "'while' cannot name",
     "keyword", 4},
    {"TakenName", "here = {", "L1_filtered = { address = \"%IX0.5\" }\nhere = {", "B0006", "'L1_filtered'",
     "rename", 10},
    {"NameOfASearch", "here = {", "search_1_1 = { address = \"%IX0.5\" }\nhere = {", "B0006", "'search_1_1'",
     "rename", 4},
    {"UnknownTagOfFact", "tag = \"there\"", "tag = \"ther\"", "B0007", "no tag 'ther'", "'there'", 18},
    {"UnknownTagOfSensor", "tag = \"L\"", "tag = \"LL\"", "B0007", "no tag 'LL'", "L", 10},
    {"UnknownOutput", "outputs = [\"right\"]", "outputs = [\"rigth\"]", "B0007", "no tag 'rigth'", "'right'",
     32},
    {"InputAsOutput", "outputs = [\"right\"]", "outputs = [\"here\"]", "B0006", "'here' cannot be driven",
     "%IX0.0", 32},
    {"DriftBelowTheTolerance", "calibration = [[0, 100], [10, 1100]]",
     "calibration = [[0, 100], [10, 1100]]\ntolerance = 0.4\nmax_drift = 0.3", "B0004", "max_drift",
     "between 0.4", 14},
    {"BoundOfNoTare", "calibration = [[0, 100], [10, 1100]]",
     "calibration = [[0, 100], [10, 1100]]\nmax_bias_counts = 20", "B0006", "'L1' is not tared",
     "tare = true", 13},
    {"RangeUpsideDown", "calibration = [[0, 100], [10, 1100]]",
     "calibration = [[0, 100], [10, 1100]]\nrange = [10, 0]", "B0006", "not a lowest and a highest value",
     "[0, 10]", 13},
    {"CalibrationNotMonotone", "[10, 1100]", "[10, 100]", "B0006", "not strictly monotone", "rising", 12},
    {"CalibrationNotFinite", "[10, 1100]", "[10, inf]", "B0006", "not strictly monotone", "", 12},
    {"CalibrationOfOnePoint", "[[0, 100], [10, 1100]]", "[[0, 100]]", "B0006", "not strictly monotone", "",
     12},
    {"SensorWithVariable", "fluent = \"(lev v1)\"", "fluent = \"(lev ?v)\"", "B0006", "variable",
     "name the object", 11},
    {"UnknownAction", "(load ?v ?f ?l)", "(laod ?v ?f ?l)", "B0007", "no action 'laod'", "'load'", 31},
    {"MissingAction",
     "[[actions]]\naction = \"(move ?v ?from ?to)\"\noutputs = [\"left\"]\nuntil = { fact = "
     "\"(is-at ?v ?to)\" }\nhold = []\ntimeout_s = 10\n",
     "", "B0009", "action 'move' has no entry", "(move ?p1 ?p2 ?p3)", 24},
    {"UnknownPredicate", "hold = [\"(is-at ?v ?f)\"]", "hold = [\"(isat ?v ?f)\"]", "B0007",
     "no predicate 'isat'", "'is-at'", 34},
    {"UnknownFunction", "to = \"(received ?f)\"", "to = \"(recieved ?f)\"", "B0007", "no function 'recieved'",
     "'received'", 36},
    {"UnknownObject", "hold = [\"(is-at ?v ?f)\"]", "hold = [\"(is-at ?v a9)\"]", "B0007", "no object 'a9'",
     "'a1'", 34},
    {"NothingObserves", "hold = [\"(is-at ?v ?f)\"]", "hold = [\"(is-at f1 ?f)\"]", "B0007",
     "no [[facts]] entry observes (is-at f1 ?f)", "(is-at v1 f1)", 34},
    {"WrongArity", "(move ?v ?from ?to)", "(move ?v ?to)", "B0007", "takes 3 arguments, here are 2", "", 25},
    {"UnknownVariable", "of = \"(lev ?v)\"", "of = \"(lev ?w)\"", "B0007", "'?w' is not in (load ?v ?f ?l)",
     "", 37},
    {"NotAnAtom", "hold = [\"(is-at ?v ?f)\"]", "hold = [\"is-at\"]", "B0006", "not an atom", "PDDL", 34},
    {"NothingMeasures", "until = { fluent = \"(lev ?v)\"", "until = { fluent = \"(received ?v)\"", "B0007",
     "no sensor measures (received ?v)", "(lev v1)", 33},
    {"ShadowedEntry", "[[actions]]\naction = \"(load",
     "[[actions]]\naction = \"(move ?v f1 ?l)\"\noutputs = [\"left\"]\nuntil = { fact = \"(is-at ?v ?l)\" "
     "}\ntimeout_s = 1\n[[actions]]\naction = \"(load",
     "B0006", "never used", "special entry", 31},
    {"ExclusiveOutputsTogether", "outputs = [\"right\"]", "outputs = [\"right\", \"left\"]", "B0006",
     "exclude each other", "", 32},
    {"GroupOfOne", "facts = [\"(is-at v1 f1)\", \"(is-at v1 a1)\"]", "facts = [\"(is-at v1 f1)\"]", "B0006",
     "two facts", "", 20},
    {"UnitsOfNothing", ", of = \"(lev ?v)\"", "", "B0006", "needs 'of'", "", 37},
};

INSTANTIATE_TEST_SUITE_P(Each, BindingSlip, ::testing::ValuesIn(kSlips),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(ReadBinding, WhenFileIsGood_ThenEverythingIsRead) {
  const model::Vocabulary names = vocabulary();
  const auto binding = read_binding(kGood, "b.toml", &names);
  ASSERT_TRUE(binding) << to_string(binding.error());
  EXPECT_EQ(binding->tags.size(), 5U);
  EXPECT_EQ(binding->start, milliseconds(1000));
  EXPECT_EQ(binding->sensor_of("(lev v1)")->label, "lev of v1");
  EXPECT_DOUBLE_EQ(binding->sensor_of("(lev v1)")->max_drift, 0.3);  // of a tolerance of 0.2
  EXPECT_EQ(binding->one_of.front().searches.front().timeout, milliseconds(5000));
  Assignment assignment;
  const ActionBinding* entry = binding->action_for({"load", {"v1", "f1", "l"}}, assignment);
  ASSERT_NE(entry, nullptr);
  EXPECT_EQ(instantiate(entry->hold.front(), assignment), "(is-at v1 f1)");
  EXPECT_EQ(binding->action_for({"fly", {}}, assignment), nullptr);
}

TEST(ReadBinding, WhenSeveralSlips_ThenAllAreReportedInFileOrder) {
  std::string text = replaced("tag = \"there\"", "tag = \"ther\"");
  text.replace(text.find("start_s = 1.0"), 13, "start_s = 0.0");
  const auto binding = read_binding(text, "b.toml");
  ASSERT_FALSE(binding);
  ASSERT_EQ(binding.error().size(), 2U);
  EXPECT_EQ(binding.error()[0].code, "B0004");
  EXPECT_EQ(binding.error()[1].code, "B0007");
}

TEST(ReadBinding, WhenTruncatedAnywhere_ThenNeverCrashes) {
  for (std::size_t length = 0; length < kGood.size(); ++length) {
    const auto binding = read_binding(kGood.substr(0, length), "b.toml");
    EXPECT_TRUE(binding || !binding.error().empty());
  }
}

TEST(LoadBinding, WhenFileIsMissing_ThenSaysSo) {
  const auto binding = load_binding("no/such/binding.toml");
  ASSERT_FALSE(binding);
  EXPECT_EQ(binding.error().front().code, "B0001");
}

TEST(LoadBinding, WhenBenchIsRead_ThenHoldsThePapersTables) {
  const Binding binding = testing::bench_binding();
  EXPECT_EQ(binding.tag("fc1")->omron, "I0.00");
  EXPECT_EQ(binding.tag("drive_left")->omron, "Q1.02");
  EXPECT_EQ(binding.sensor_of("(lev v1)")->omron, "D100");
  EXPECT_DOUBLE_EQ(binding.sensor_of("(level a1)")->calibration.counts_at(5), 1854);
  EXPECT_DOUBLE_EQ(binding.sensor_of("(level a2)")->calibration.counts_at(2), 1061);
  for (const char* from : {"f1", "a1", "a2"}) {
    for (const char* to : {"f1", "a1", "a2"}) {
      if (std::string(from) == to) continue;
      Assignment assignment;
      EXPECT_NE(binding.action_for({"move", {"v1", from, to}}, assignment), nullptr) << from << " " << to;
    }
  }
}

// What can fail as one: by the outputs of an action, by its pattern, or an output of its own.
TEST(BindingDevices, WhenAnActionDrivesOutputs_ThenItDependsOnTheirDevices) {
  const model::Vocabulary names = vocabulary();
  const auto binding = read_binding(kGood + R"toml([[devices]]
name = "drive"
outputs = ["left"]
[[devices]]
name = "gate"
actions = ["(move ?v ?from a1)"]
)toml",
                                    "b.toml", &names);
  ASSERT_TRUE(binding) << to_string(binding.error());
  using Names = std::vector<std::string>;
  EXPECT_EQ(binding->devices_of({"move", {"v1", "a1", "f1"}}), Names{"drive"});
  EXPECT_EQ(binding->devices_of({"move", {"v1", "f1", "a1"}}), (Names{"drive", "gate"}));
  EXPECT_EQ(binding->devices_of({"load", {"v1", "f1", "a1"}}), Names{"right"});
  EXPECT_EQ(binding->devices_of({"fly", {"v1"}}), Names{});
}

TEST(BindingDevices, WhenAnEntryIsWrong_ThenItIsReportedAtItsPlace) {
  const model::Vocabulary names = vocabulary();
  const std::string first = "[[devices]]\nname = \"drive\"\noutputs = [\"left\"]\n[[devices]]\n";
  const std::pair<const char*, const char*> slips[] = {
      {"name = \"drive\"\noutputs = [\"right\"]\n", "another device is called 'drive'"},
      {"name = \"d\"\noutputs = [\"left\"]\n", "'left' is an output of 'drive' already"},
      {"name = \"d\"\noutputs = [\"lefd\"]\n", "no tag 'lefd'"},
      {"name = \"d\"\noutputs = [\"here\"]\n", "'here' cannot be driven"},
      {"name = \"d\"\nactions = [\"(mofe ?v ?a ?b)\"]\n", "no action 'mofe'"},
      {"name = \"d\"\n", "nothing depends on this device"},
      {"outputs = [\"right\"]\n", "name"}};
  for (const auto& [text, message] : slips) {
    const auto binding = read_binding(kGood + first + text, "b.toml", &names);
    ASSERT_FALSE(binding) << text;
    EXPECT_EQ(binding.error().size(), 1U) << to_string(binding.error());
    EXPECT_NE(binding.error().front().message.find(message), std::string::npos) << to_string(binding.error());
    EXPECT_GE(binding.error().front().where.line, 41U);
  }
}

}  // namespace
}  // namespace stepwright::translate
