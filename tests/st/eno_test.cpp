// A standard function with ENO connected beside the same without, on every engine: ENO is FALSE exactly where
// the other traps, and the values are the same. Texts that are literals, nearly so and not at all; reals at
// and around the ends of what the types hold.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "tests/st/compiled_text.h"
#include "tests/st/machine.h"

namespace {

using namespace stepwright;

struct Function {
  std::string name;
  std::string from;
  std::string to;
  std::string argument = "x";
};

reader::LoadedProgram calling(const Function& function, const std::string& arguments) {
  return st_test::compiled("PROGRAM main VAR x : " + function.from + "; y, none : " + function.to +
                               "; ok : BOOL; END_VAR\ny := " + function.name + "(" + arguments +
                               ");\nEND_PROGRAM\n",
                           *source::find_dialect("matiec"));
}

// False where the two differ, which is said.
bool agree(const Function& function, const std::vector<std::string>& values) {
  const reader::LoadedProgram with = calling(function, "IN := " + function.argument + ", ENO => ok");
  const reader::LoadedProgram without = calling(function, function.argument);
  for (const st_test::EngineKind engine : st_test::engines()) {
    st_test::Machine guarded(with, engine);
    st_test::Machine plain(without, engine);
    for (const std::string& value : values) {
      guarded.set("x", value);
      plain.set("x", value);
      const bool has_value = plain.scan().trap.code == bytecode::TrapCode::None;
      const bool ran = guarded.scan().trap.code == bytecode::TrapCode::None;
      const std::string expected = has_value ? plain.shown("y") : guarded.shown("none");
      const bool right =
          ran && guarded.equals("ok", has_value ? "TRUE" : "FALSE") && guarded.shown("y") == expected;
      EXPECT_TRUE(right) << st_test::name_of(engine) << ": " << function.name << " of " << value
                         << (ran ? "" : " traps") << ": ENO " << guarded.shown("ok") << ", value "
                         << guarded.shown("y") << "; expected " << has_value << ", " << expected;
      if (!right) return false;  // one of a kind is enough
      plain.restart_after_trap();
    }
  }
  return true;
}

const std::vector<std::string> kIntegers{"SINT",  "INT",   "DINT", "LINT", "USINT", "UINT",
                                         "UDINT", "ULINT", "BYTE", "WORD", "DWORD", "LWORD"};

// Literals of all types, and each with a character changed, put in or taken out.
std::vector<std::string> texts() {
  const std::vector<std::string> literals{"",
                                          "0",
                                          "1",
                                          "-1",
                                          "127",
                                          "128",
                                          "-128",
                                          "-129",
                                          "255",
                                          "256",
                                          "32767",
                                          "32768",
                                          "-32768",
                                          "-32769",
                                          "65535",
                                          "65536",
                                          "2147483647",
                                          "2147483648",
                                          "-2147483648",
                                          "-2147483649",
                                          "4294967295",
                                          "4294967296",
                                          "9223372036854775807",
                                          "9223372036854775808",
                                          "-9223372036854775808",
                                          "-9223372036854775809",
                                          "18446744073709551615",
                                          "18446744073709551616",
                                          "16#FF",
                                          "2#1_0",
                                          "8#377",
                                          "1_000",
                                          "1.5",
                                          "1.0E38",
                                          "1.0E39",
                                          "-1.0E308",
                                          "1.0E309",
                                          "TRUE",
                                          "false",
                                          "T#1s500ms",
                                          "TIME#2d",
                                          "T#-1h",
                                          "D#2024-02-29",
                                          "D#2023-02-29",
                                          "DATE#1969-12-31",
                                          "D#3000-01-01",
                                          "TOD#23:59:59.999",
                                          "TOD#24:00:00",
                                          "DT#2024-02-29-12:30:00",
                                          "DT#2262-04-12-00:00:00",
                                          "Infinity",
                                          "NaN"};
  const std::string characters = "0129-+._:#EeTDx ";
  std::mt19937 random(1);
  std::vector<std::string> all = literals;
  for (int round = 0; round < 6; ++round) {
    for (std::string text : literals) {
      const std::string character(1, characters[random() % characters.size()]);
      const std::size_t at = random() % (text.size() + 1);
      const std::size_t removed = random() % 2;
      const std::string added = removed == 0 || random() % 2 == 0 ? character : "";
      text.replace(at, removed, added);
      all.push_back(std::move(text));
    }
  }
  for (std::string& text : all) text = "'" + text + "'";
  return all;
}

std::string written(double value) {
  if (std::isnan(value)) return "NAN";
  if (std::isinf(value)) return value > 0 ? "INF" : "-INF";
  char text[40];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

// The ends of the types, in their units and seconds and days, with the neighbours that are real numbers.
std::vector<std::string> reals(bool single) {
  std::vector<double> middles{0.0, 0.5, 1.0, 9.223372036854775807e12, 9223372036.854775807, 106751.0};
  for (int bits = 7; bits <= 64; ++bits) middles.push_back(std::ldexp(1.0, bits));
  middles.push_back(std::numeric_limits<float>::max());
  middles.push_back(0x1.ffffffp127);
  const auto next = [single](double value, double to) {
    return single ? double{std::nextafter(static_cast<float>(value), static_cast<float>(to))}
                  : std::nextafter(value, to);
  };
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<std::string> all{"NAN", "INF", "-INF", written(single ? 3.0e38 : 1.0e300)};
  for (const double middle : middles) {
    for (const double offset : {0.0, -0.5, 0.5, -1.0, 1.0}) {
      for (const double sign : {-1.0, 1.0}) {
        const double value = sign * (middle + offset);
        const double held = single ? double{static_cast<float>(value)} : value;
        for (const double each : {held, next(held, infinity), next(held, -infinity)})
          if (std::fpclassify(each) != FP_SUBNORMAL) all.push_back(written(each));
      }
    }
  }
  return all;
}

TEST(Eno, Reading_WhenTextsAreRandom_ThenItIsFalseWhereTheFunctionTraps) {
  std::vector<std::string> types = kIntegers;
  types.insert(types.end(), {"REAL", "LREAL", "BOOL", "TIME", "DATE", "TOD", "DT"});
  for (const std::string& type : types) {
    EXPECT_TRUE(agree({"STRING_TO_" + type, "STRING", type}, texts()));
    EXPECT_TRUE(agree({"WSTRING_TO_" + type, "STRING", type, "STRING_TO_WSTRING(x)"}, texts()));
  }
}

TEST(Eno, Conversion_WhenRealsAreAtTheEndsOfTheType_ThenItIsFalseWhereTheFunctionTraps) {
  for (const std::string from : {"REAL", "LREAL"}) {
    const std::vector<std::string> values = reals(from == "REAL");
    std::vector<std::string> types = kIntegers;
    types.insert(types.end(), {"TIME", "DATE", "TOD", "DT"});
    for (const std::string& type : types) EXPECT_TRUE(agree({from + "_TO_" + type, from, type}, values));
    for (const std::string type : {"SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT"})
      EXPECT_TRUE(agree({from + "_TRUNC_" + type, from, type}, values));
  }
  EXPECT_TRUE(agree({"LREAL_TO_REAL", "LREAL", "REAL"}, reals(false)));
}

}  // namespace
