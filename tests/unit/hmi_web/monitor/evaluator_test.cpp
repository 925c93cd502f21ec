#include "hmi_web/monitor/evaluator.h"

#include <gtest/gtest.h>

#include <map>

#include "hmi_web/monitor/texts.h"

namespace stepwright::monitor {
namespace {

using bytecode::ElementaryType;

// Values of a, b, n, r, t and x[7].y; everything else is not known.
class Values {
 public:
  Values() {
    set("a", ElementaryType::Bool, {1});
    set("b", ElementaryType::Bool, {0});
    set("n", ElementaryType::Int, {7});
    set("big", ElementaryType::Int, {32'767});
    set("count", ElementaryType::Uint, {0});
    set("bits", ElementaryType::Word, {0xF0});
    set("r", ElementaryType::Real, {0, 2.5});
    set("near", ElementaryType::Real, {0, 2.5001});
    set("t", ElementaryType::Time, {5'000'000'000});
    set("x[7].y", ElementaryType::Int, {3});
  }

  // "" of what is not known; a number, or the type in front of it: "BOOL 1".
  std::string of(const std::string& text) {
    const Value value = evaluator_.value(texts_.expression(text));
    if (!value) return "";
    const semantics::Type& type = *value->type;
    const std::string number =
        type.is_real() ? std::to_string(value->constant.real) : semantics::to_string(value->constant.integer);
    return (type.is_bool() ? "BOOL " : "") + number;
  }

 private:
  void set(const std::string& name, ElementaryType type, semantics::Constant constant) {
    values_.emplace(name, Known{types_.elementary(type), std::move(constant)});
  }

  semantics::TypeTable types_;
  std::map<std::string, Known> values_;
  Lookup lookup_ = [this](const std::string& path) -> Value {
    const auto found = values_.find(path);
    return found == values_.end() ? Value() : Value(found->second);
  };
  Texts texts_;
  Evaluator evaluator_{types_, lookup_};
};

TEST(Evaluator, WhenValuesAreKnown_ThenAnExpressionHasTheEnginesValue) {
  const std::map<std::string, std::string> cases = {{"a AND NOT b", "BOOL 1"},
                                                    {"a XOR b AND FALSE", "BOOL 1"},
                                                    {"b OR (n > 5)", "BOOL 1"},
                                                    {"n + 2 * 3", "13"},
                                                    {"(n + 2) * 3", "27"},
                                                    {"n / 2", "3"},
                                                    {"-n / 2", "-3"},
                                                    {"n MOD 4", "3"},
                                                    {"2 ** 3", "8.000000"},
                                                    {"n = 7", "BOOL 1"},
                                                    {"n <> 7", "BOOL 0"},
                                                    {"r >= 2.0", "BOOL 1"},
                                                    {"r + n", "9.500000"},
                                                    {"t < T#5s1ms", "BOOL 1"},
                                                    {"t = TIME#5000ms", "BOOL 1"},
                                                    {"t - T#2s", "3000000000"},
                                                    {"t / 2", "2500000000"},
                                                    {"x[n].y", "3"},
                                                    {"16#1F", "31"},
                                                    {"2#1_01", "5"},
                                                    {"INT#5", "5"},
                                                    {"MAX(n, 9)", "9"},
                                                    {"LIMIT(0, n, 5)", "5"},
                                                    {"LIMIT(MN := 0, IN := n, MX := 5)", "5"},
                                                    {"SEL(b, 4, 5)", "4"},
                                                    {"GT(9, n, 2)", "BOOL 1"},
                                                    {"ADD(n, 1, 1)", "9"},
                                                    {"INT_TO_REAL(n) / 2.0", "3.500000"},
                                                    {"REAL_TO_INT(r)", "2"},
                                                    {"SQRT(INT_TO_REAL(n) + 2.0)", "3.000000"},
                                                    {"a & b", "BOOL 0"},
                                                    {"bits AND 16#30", "48"},
                                                    {"n (* seven *) = 7 // so", "BOOL 1"},
                                                    {"1.5E2 = 150", "BOOL 1"},
                                                    {"TRUE", "BOOL 1"}};
  Values values;
  for (const auto& [text, expected] : cases) EXPECT_EQ(values.of(text), expected) << text;
}

// Numbers wrap to their type, and REAL is compared as it is: no decimals are left out on the way.
TEST(Evaluator, WhenNumbersReachTheirLimitsOrLieCloseTogether_ThenItComputesAsTheMachine) {
  Values values;
  EXPECT_EQ(values.of("big + 1"), "-32768");
  EXPECT_EQ(values.of("count - 1"), "65535");
  EXPECT_EQ(values.of("r > 2.5"), "BOOL 0");
  EXPECT_EQ(values.of("near > r"), "BOOL 1");
}

TEST(Evaluator, WhenAPartIsNotKnown_ThenAndAndOrKnowMoreThanTheirOperands) {
  const std::map<std::string, std::string> cases = {{"unknown AND b", "BOOL 0"},
                                                    {"unknown OR a", "BOOL 1"},
                                                    {"unknown OR b", ""},
                                                    {"NOT unknown", ""},
                                                    {"unknown(n)", ""},
                                                    {"x[8].y", ""},
                                                    {"x[unknown].y", ""},
                                                    {"n / 0", ""},
                                                    {"p^.x", ""},
                                                    {"'text' = x", ""},
                                                    {"SEL(unknown, 4, 5)", ""}};
  Values values;
  for (const auto& [text, expected] : cases) EXPECT_EQ(values.of(text), expected) << text;
}

TEST(Evaluator, WhenATextIsNoExpression_ThenItHasNoValue) {
  Values values;
  for (const std::string text : {"", "n +", "(n", "n )", "a := b", "a; b"})
    EXPECT_EQ(values.of(text), "") << text;
  std::string inverted;
  for (int i = 0; i < 3'000; ++i) inverted += "NOT ";
  EXPECT_EQ(values.of(std::string(5'000, '(') + "a" + std::string(5'000, ')')), "");
  EXPECT_EQ(values.of(inverted + "a"), "");
}

}  // namespace
}  // namespace stepwright::monitor
