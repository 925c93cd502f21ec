// 200 random pairs of programs: what both have keeps its value, what only the new one has is as it starts.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>

#include "tests/unit/runtime/host/change_pair.h"

namespace stepwright::host {
namespace {

// A declaration and a statement that changes it in every scan; %s is the name.
struct Sort {
  const char* type;
  const char* statement;
};

constexpr std::array kSorts = {
    Sort{"BOOL", "%s := NOT %s;"},
    Sort{"SINT", "%s := n3;"},
    Sort{"UINT", "%s := %s + 7;"},
    Sort{"DINT := -4", "%s := %s - 1;"},
    Sort{"LINT", "%s := %s + 1000000007;"},
    Sort{"REAL := 0.5", "%s := %s * 1.25;"},
    Sort{"LREAL", "%s := %s + 0.125;"},
    Sort{"TIME", "%s := %s + T#3ms;"},
    Sort{"WORD", "%s := %s XOR 16#A5A5;"},
    Sort{"STRING[6]", "%s := CONCAT(%s, 'ab');"},
    Sort{"STRING[19]", "%s := CONCAT(%s, 'x');"},
    Sort{"WSTRING[5]", "%s := \"wide\";"},
    Sort{"ARRAY[1..5] OF INT", "%s[2] := %s[2] + 3; %s[5] := -1;"},
    Sort{"ARRAY[0..3] OF INT", "%s[2] := %s[2] + 5;"},
    Sort{"ARRAY[-1..1, 1..2] OF BOOL", "%s[0, 2] := TRUE;"},
    Sort{"ARRAY[1..3] OF STRING[4]", "%s[3] := 'end';"},
    Sort{"ARRAY[1..2] OF Point", "%s[1].x := %s[1].x + 2; %s[2].name := 'p';"},
    Sort{"Point", "%s.x := %s.x + 1; %s.on := NOT %s.on;"},
    Sort{"Place", "%s.x := %s.x + 1; %s.at.x := 4;"},
    Sort{"Mode", "%s := RUN;"},
    Sort{"TON", "%s(IN := n3 > 1, PT := T#40ms);"},
    Sort{"CTU", "%s(CU := n3 = 2, PV := 5);"},
    Sort{"R_TRIG", "%s(CLK := n3 > 2);"},
    Sort{"Count", "%s();"},
};

constexpr const char* kTypes =
    "TYPE Mode : (IDLE, RUN, HALT); END_TYPE\n"
    "TYPE Point : STRUCT x : INT; on : BOOL; name : STRING[3]; END_STRUCT; END_TYPE\n"
    "TYPE Place : STRUCT at : Point; x : LINT; END_STRUCT; END_TYPE\n"
    "FUNCTION_BLOCK Count VAR n : INT; t : TON; e : F_TRIG; END_VAR\n"
    "n := n + 1; t(IN := TRUE, PT := T#1s); e(CLK := n MOD 2 = 0); END_FUNCTION_BLOCK\n";

std::string with_name(std::string text, const std::string& name) {
  for (std::size_t at = text.find("%s"); at != std::string::npos; at = text.find("%s", at))
    text.replace(at, 2, name);
  return text;
}

using Variables = std::vector<std::pair<std::string, std::size_t>>;  // name, sort

std::string source_of(const Variables& variables) {
  std::string declarations = "VAR n3 : SINT;\n";
  std::string body = "n3 := (n3 + 1) MOD 5;\n";
  for (const auto& [name, sort] : variables) {
    declarations += "  " + name + " : " + kSorts[sort].type + ";\n";
    body += with_name(kSorts[sort].statement, name) + "\n";
  }
  return kTypes + program_text(declarations + "END_VAR", body);
}

std::size_t pick(std::mt19937& random, std::size_t below) {
  return std::uniform_int_distribution<std::size_t>(0, below - 1)(random);
}

Variables random_variables(std::mt19937& random) {
  Variables variables;
  for (std::size_t i = 0, count = 3 + pick(random, 25); i < count; ++i)
    variables.emplace_back("v" + std::to_string(i), pick(random, kSorts.size()));
  return variables;
}

// Some are gone, some have another type, some are new, and all stand elsewhere.
Variables changed(Variables variables, std::mt19937& random) {
  std::erase_if(variables, [&](const auto&) { return pick(random, 6) == 0; });
  for (auto& [name, sort] : variables)
    if (pick(random, 6) == 0) sort = pick(random, kSorts.size());
  for (std::size_t i = 0, count = pick(random, 6); i < count; ++i)
    variables.emplace_back("new" + std::to_string(i), pick(random, kSorts.size()));
  std::shuffle(variables.begin(), variables.end(), random);
  return variables;
}

struct Value {
  bytecode::ElementaryType type;
  std::string text;
};

std::map<std::string, Value> values_of(PreparedProgram& program) {
  std::map<std::string, Value> values;
  const auto info = reader::ProgramInfo::read(program.loaded().bytes());
  for (const reader::Tag& tag : info->tags()) {
    values[tag.name] = {tag.variable.type, reader::read_text(tag.variable, program.image().bytes())};
  }
  return values;
}

bool is_text(bytecode::ElementaryType type) {
  return bytecode::is_string(type);
}

// The old text as far as the new capacity goes.
bool is_cut(const std::string& old, const std::string& now) {
  const std::string inner = now.substr(0, now.empty() ? 0 : now.size() - 1);  // without the closing quote
  return old.starts_with(inner);
}

TEST(ChangeRandom, WhenProgramsChange_ThenTheVariablesOfBothKeepTheirValuesForEachOf200Pairs) {
  std::mt19937 random(20'261'122);
  std::size_t compared = 0;
  for (int round = 0; round < 200; ++round) {
    const Variables before = random_variables(random);
    const std::string old_text = source_of(before);
    const std::string new_text = source_of(changed(before, random));
    SCOPED_TRACE(old_text + "\n-----\n" + new_text);
    ChangePair pair(old_text, new_text);
    ASSERT_TRUE(pair.refusal.empty()) << result::to_string(pair.refusal);
    const auto initial = values_of(pair.after());
    pair.scan(1 + static_cast<int>(pick(random, 20)));
    ASSERT_EQ(pair.last.state, scan::ScanState::Running);
    const auto old = values_of(pair.before());
    ASSERT_TRUE(pair.change());
    for (const auto& [path, now] : values_of(pair.after())) {
      const auto known = old.find(path);
      if (known == old.end() || known->second.type != now.type) {
        ASSERT_EQ(now.text, initial.at(path).text) << path;
      } else if (is_text(now.type)) {
        ASSERT_TRUE(is_cut(known->second.text, now.text)) << path << " " << known->second.text << now.text;
      } else {
        ASSERT_EQ(now.text, known->second.text) << path;
      }
      ++compared;
    }
    pair.scan(10);
    ASSERT_EQ(pair.last.state, scan::ScanState::Running);
  }
  EXPECT_GT(compared, 5'000u);
}

}  // namespace
}  // namespace stepwright::host
