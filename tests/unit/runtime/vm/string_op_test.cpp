// Strings: each operation of StringOp on STRING and WSTRING, aliasing, clamping, conversion, hostile headers.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/test_program.h"

namespace stepwright::vm {
namespace {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::StringOpId;
using bytecode::TrapCode;
using support::one_program;
using support::TestProgram;
using writer::FunctionBuilder;

constexpr std::uint32_t kTarget = 0;  // capacity 8
constexpr std::uint32_t kA = 32;      // capacity 12
constexpr std::uint32_t kB = 64;      // capacity 12
constexpr std::uint32_t kResult = 96;
constexpr std::uint32_t kBytes = 104;

// Runs one operation on three strings; `wide` chooses between STRING and WSTRING.
class Strings : public ::testing::TestWithParam<bool> {
 protected:
  static bool wide() { return GetParam(); }
  // The operation of the width under test; named by its STRING form.
  static StringOpId op(StringOpId narrow) {
    return static_cast<StringOpId>(static_cast<std::uint8_t>(narrow) + (wide() ? 1 : 0));
  }

  static void put(TestProgram& program, std::uint32_t address, std::uint16_t capacity,
                  const std::string& text) {
    program.write(address, capacity);
    program.write(address + 2, static_cast<std::uint16_t>(text.size()));
    for (std::uint32_t i = 0; i < text.size(); ++i) {
      if (wide()) {
        program.write(address + 4 + 2 * i, static_cast<std::uint16_t>(text[i]));
      } else {
        program.write(address + 4 + i, text[i]);
      }
    }
  }
  static std::string get(const TestProgram& program, std::uint32_t address) {
    std::string text;
    for (std::uint32_t i = 0; i < program.read<std::uint16_t>(address + 2); ++i) {
      text += wide() ? static_cast<char>(program.read<std::uint16_t>(address + 4 + 2 * i))
                     : program.read<char>(address + 4 + i);
    }
    return text;
  }

  struct Outcome {
    TrapCode trap = TrapCode::None;
    std::string text;
    std::int32_t number = 0;
    std::uint64_t used = 0;
  };

  // Pushes the refs and numbers, runs the operation, stores a number if it gives one.
  static Outcome run(StringOpId narrow, const std::string& a, const std::string& b,
                     const std::vector<std::uint32_t>& refs, const std::vector<std::int32_t>& numbers = {}) {
    const StringOpId id = op(narrow);
    const bool gives = *bytecode::kStringOps[static_cast<std::uint8_t>(id)].pushes != '\0';
    TestProgram program(one_program(kBytes, [&](FunctionBuilder& f) {
      if (gives) f.addr_this(kResult);
      for (const std::uint32_t ref : refs) f.addr_this(ref);
      for (const std::int32_t number : numbers) f.const_i32(number);
      f.string_op(id);
      if (gives) f.store(MemType::I32, AddressMode::Ind);
    }));
    put(program, kTarget, 8, "old");
    put(program, kA, 12, a);
    put(program, kB, 12, b);
    std::uint64_t budget = 10'000;
    Outcome outcome;
    outcome.trap = program.run(0, budget).code;
    outcome.text = get(program, refs[0]);
    outcome.number = program.read<std::int32_t>(kResult);
    outcome.used = 10'000 - budget;
    return outcome;
  }

  static std::string text(StringOpId narrow, const std::string& a, const std::string& b,
                          const std::vector<std::int32_t>& numbers = {}, bool two_sources = false) {
    const Outcome outcome =
        run(narrow, a, b, two_sources ? std::vector{kTarget, kA, kB} : std::vector{kTarget, kA}, numbers);
    return outcome.trap == TrapCode::None ? outcome.text : name_of(outcome.trap);
  }
  static std::string text2(StringOpId narrow, const std::string& a, const std::string& b,
                           const std::vector<std::int32_t>& numbers = {}) {
    return text(narrow, a, b, numbers, true);
  }
};

INSTANTIATE_TEST_SUITE_P(BothWidths, Strings, ::testing::Bool(),
                         [](const auto& each) { return each.param ? "Wstring" : "String"; });

const char* const kBadArgument = bytecode::name_of(TrapCode::BadArgument);

TEST_P(Strings, Init_WhenRun_ThenWritesAnEmptyHeader) {
  TestProgram program(one_program(64, [&](FunctionBuilder& f) {
    f.addr_this(10);
    f.const_i32(7);
    f.string_op(op(StringOpId::InitS));
  }));
  program.write<std::uint32_t>(10, 0xFFFFFFFF);
  ASSERT_FALSE(program.run());
  EXPECT_EQ(program.read<std::uint32_t>(10), 7u);
}

TEST_P(Strings, Init_WhenCapacityDoesNotFit_ThenTraps) {
  for (const std::int32_t capacity : {-1, 65536, 65535}) {
    const Outcome outcome = run(StringOpId::InitS, "", "", {kTarget}, {capacity});
    EXPECT_EQ(outcome.trap, capacity == 65535 ? TrapCode::BadReference : TrapCode::BadArgument);
    EXPECT_EQ(outcome.text, "old");
  }
}

TEST_P(Strings, ClearAndLength_WhenRun_ThenActOnTheLength) {
  EXPECT_EQ(run(StringOpId::ClearS, "", "", {kTarget}).text, "");
  EXPECT_EQ(run(StringOpId::LengthS, "hello", "", {kA}).number, 5);
}

TEST_P(Strings, Copy_WhenLongerThanTheTarget_ThenIsCut) {
  EXPECT_EQ(text(StringOpId::CopyS, "hello", ""), "hello");
  EXPECT_EQ(text(StringOpId::CopyS, "hello world!", ""), "hello wo");
}

TEST_P(Strings, LeftRightMid_WhenRun_ThenGiveParts) {
  EXPECT_EQ(text(StringOpId::LeftS, "abcde", "", {3}), "abc");
  EXPECT_EQ(text(StringOpId::LeftS, "abcde", "", {9}), "abcde");
  EXPECT_EQ(text(StringOpId::LeftS, "abcde", "", {0}), "");
  EXPECT_EQ(text(StringOpId::LeftS, "abcde", "", {-1}), kBadArgument);
  EXPECT_EQ(text(StringOpId::RightS, "abcde", "", {2}), "de");
  EXPECT_EQ(text(StringOpId::RightS, "abcde", "", {9}), "abcde");
  EXPECT_EQ(text(StringOpId::RightS, "abcde", "", {-1}), kBadArgument);
  EXPECT_EQ(text(StringOpId::MidS, "abcde", "", {2, 2}), "bc");
  EXPECT_EQ(text(StringOpId::MidS, "abcde", "", {9, 4}), "de");
  EXPECT_EQ(text(StringOpId::MidS, "abcde", "", {2, 0}), "ab");
  EXPECT_EQ(text(StringOpId::MidS, "abcde", "", {2, 6}), "");
  EXPECT_EQ(text(StringOpId::MidS, "abcde", "", {2, 2'000'000'000}), "");
  EXPECT_EQ(text(StringOpId::MidS, "abcde", "", {-2, 2}), kBadArgument);
  EXPECT_EQ(text(StringOpId::MidS, "abcde", "", {2, -2}), kBadArgument);
}

TEST_P(Strings, ConcatAndInsert_WhenRun_ThenJoin) {
  EXPECT_EQ(text2(StringOpId::ConcatS, "abc", "de"), "abcde");
  EXPECT_EQ(text2(StringOpId::ConcatS, "abcdefgh", "xy"), "abcdefgh");
  EXPECT_EQ(text2(StringOpId::ConcatS, "abcdefghijkl", "xy"), "abcdefgh");
  EXPECT_EQ(text2(StringOpId::InsertS, "abc", "xy", {1}), "axybc");
  EXPECT_EQ(text2(StringOpId::InsertS, "abc", "xy", {0}), "xyabc");
  EXPECT_EQ(text2(StringOpId::InsertS, "abc", "xy", {99}), "abcxy");
  EXPECT_EQ(text2(StringOpId::InsertS, "abc", "xy", {-1}), kBadArgument);
}

TEST_P(Strings, DeleteAndReplace_WhenRun_ThenChangeTheirPart) {
  EXPECT_EQ(text(StringOpId::DeleteS, "abcde", "", {2, 3}), "abe");
  EXPECT_EQ(text(StringOpId::DeleteS, "abcde", "", {9, 4}), "abc");
  EXPECT_EQ(text(StringOpId::DeleteS, "abcde", "", {2, 0}), "cde");
  EXPECT_EQ(text(StringOpId::DeleteS, "abcde", "", {2, 9}), "abcde");
  EXPECT_EQ(text(StringOpId::DeleteS, "abcde", "", {-1, 1}), kBadArgument);
  EXPECT_EQ(text2(StringOpId::ReplaceS, "abcde", "xyz", {2, 3}), "abxyze");
  EXPECT_EQ(text2(StringOpId::ReplaceS, "abcde", "x", {9, 2}), "ax");
  EXPECT_EQ(text2(StringOpId::ReplaceS, "abcde", "x", {1, 9}), "abcdex");
  EXPECT_EQ(text2(StringOpId::ReplaceS, "abcde", "x", {1, -9}), kBadArgument);
}

TEST_P(Strings, Target_WhenItIsASource_ThenTheResultIsAsIfComputedAside) {
  const auto aliased = [&](StringOpId id, std::vector<std::uint32_t> refs,
                           std::vector<std::int32_t> numbers) {
    return run(id, "abcde", "xyz", refs, numbers).text;
  };
  EXPECT_EQ(aliased(StringOpId::ConcatS, {kA, kA, kB}, {}), "abcdexyz");
  EXPECT_EQ(aliased(StringOpId::ConcatS, {kA, kB, kA}, {}), "xyzabcde");
  EXPECT_EQ(aliased(StringOpId::ConcatS, {kA, kA, kA}, {}), "abcdeabcde");
  EXPECT_EQ(aliased(StringOpId::InsertS, {kA, kA, kB}, {2}), "abxyzcde");
  EXPECT_EQ(aliased(StringOpId::InsertS, {kA, kB, kA}, {2}), "xyabcdez");
  EXPECT_EQ(aliased(StringOpId::InsertS, {kA, kA, kA}, {2}), "ababcdecde");
  EXPECT_EQ(aliased(StringOpId::ReplaceS, {kA, kA, kA}, {4, 2}), "aabcde");
  EXPECT_EQ(aliased(StringOpId::ReplaceS, {kB, kA, kB}, {4, 1}), "xyze");
  EXPECT_EQ(aliased(StringOpId::MidS, {kA, kA}, {2, 3}), "cd");
  EXPECT_EQ(aliased(StringOpId::RightS, {kA, kA}, {3}), "cde");
  EXPECT_EQ(aliased(StringOpId::DeleteS, {kA, kA}, {2, 2}), "ade");
}

// Every operation with two sources against a model, in all ways to alias, with results beyond the capacity.
TEST_P(Strings, Target_WhenAliasedInAnyWay_ThenAgreesWithAModel) {
  const std::string texts[] = {"abcdefg", "xyzuv"};
  const std::uint32_t places[] = {kA, kB, kTarget};
  for (int way = 0; way < 27; ++way) {
    const std::uint32_t target = places[way % 3], a = places[way / 3 % 3], b = places[way / 9];
    const auto content = [&](std::uint32_t ref) {
      return ref == kA ? texts[0] : ref == kB ? texts[1] : "old";
    };
    for (std::int32_t count = 0; count < 9; ++count) {
      for (std::int32_t position = 1; position < 9; ++position) {
        const Outcome outcome =
            run(StringOpId::ReplaceS, texts[0], texts[1], {target, a, b}, {count, position});
        std::string expected = content(a);
        const auto start = std::min<std::size_t>(static_cast<std::size_t>(position - 1), expected.size());
        expected.replace(start, static_cast<std::size_t>(count), content(b));
        expected.resize(std::min<std::size_t>(expected.size(), target == kTarget ? 8 : 12));
        ASSERT_EQ(outcome.text, expected) << way << " " << count << " " << position;
      }
    }
  }
}

TEST_P(Strings, FindAndCompare_WhenRun_ThenGiveNumbers) {
  const auto find = [&](const char* a, const char* b) {
    return run(StringOpId::FindS, a, b, {kA, kB}).number;
  };
  EXPECT_EQ(find("abcabc", "bc"), 2);
  EXPECT_EQ(find("abcabc", "cd"), 0);
  EXPECT_EQ(find("abc", "abcd"), 0);
  EXPECT_EQ(find("abc", ""), 0);
  EXPECT_EQ(find("abc", "c"), 3);
  const auto compare = [&](const char* a, const char* b) {
    return run(StringOpId::CompareS, a, b, {kA, kB}).number;
  };
  EXPECT_EQ(compare("abc", "abc"), 0);
  EXPECT_EQ(compare("abc", "abd"), -1);
  EXPECT_EQ(compare("abd", "abc"), 1);
  EXPECT_EQ(compare("ab", "abc"), -1);
  EXPECT_EQ(compare("abc", ""), 1);
  EXPECT_EQ(compare("a", "\x7F"), -1);
}

TEST_P(Strings, Characters_WhenWithinTheLength_ThenAreReadAndWritten) {
  EXPECT_EQ(run(StringOpId::CharAtS, "abc", "", {kA}, {2}).number, 'b');
  EXPECT_EQ(run(StringOpId::SetCharAtS, "abc", "", {kA}, {3, 'x'}).text, "abx");
  for (const std::int32_t position : {-1, 0, 4}) {
    EXPECT_EQ(run(StringOpId::CharAtS, "abc", "", {kA}, {position}).trap, TrapCode::IndexRange);
    EXPECT_EQ(run(StringOpId::SetCharAtS, "abc", "", {kA}, {position, 'x'}).trap, TrapCode::IndexRange);
  }
}

TEST_P(Strings, Budget_WhenCharactersAreCopied_ThenIsChargedForThem) {
  const std::uint64_t shorter = run(StringOpId::CopyS, "ab", "", {kTarget, kA}).used;
  const std::uint64_t longer = run(StringOpId::CopyS, "abcdefg", "", {kTarget, kA}).used;
  EXPECT_EQ(longer - shorter, 5u);
}

TEST_P(Strings, Length_WhenBeyondTheCapacity_ThenIsCutToIt) {
  TestProgram program(one_program(kBytes, [&](FunctionBuilder& f) {
    f.addr_this(kTarget);
    f.addr_this(kA);
    f.string_op(op(StringOpId::CopyS));
  }));
  put(program, kTarget, 8, "");
  put(program, kA, 3, "abc");
  program.write<std::uint16_t>(kA + 2, 60'000);
  ASSERT_FALSE(program.run());
  EXPECT_EQ(get(program, kTarget), "abc");
}

TEST_P(Strings, Header_WhenItPromisesMoreThanThereIs_ThenTraps) {
  for (const StringOpId id : {StringOpId::ClearS, StringOpId::LengthS}) {
    TestProgram program(one_program(64, [&](FunctionBuilder& f) {
      f.addr_this(32);
      f.string_op(op(id));
      if (id == StringOpId::LengthS) f.emit(bytecode::Opcode::Drop);
    }));
    put(program, 32, static_cast<std::uint16_t>(wide() ? 14 : 28), "");
    EXPECT_FALSE(program.run());
    put(program, 32, static_cast<std::uint16_t>(wide() ? 15 : 29), "");
    EXPECT_EQ(program.run().code, TrapCode::BadReference);
  }
}

TEST_P(Strings, References_WhenNullOrOverlapping_ThenTrapAndChangeNothing) {
  TestProgram program(one_program(kBytes, [&](FunctionBuilder& f) {
    f.load(MemType::Ref, AddressMode::This, kResult);
    f.addr_this(kA);
    f.string_op(op(StringOpId::CopyS));
  }));
  put(program, kA, 12, "abc");
  program.write(kResult, bytecode::kNullRef);
  EXPECT_EQ(program.run().code, TrapCode::NullReference);
  program.write(kResult, std::uint32_t{kA + 2});
  EXPECT_EQ(program.run().code, TrapCode::BadReference);
  program.write(kResult, std::uint32_t{kBytes - 3});
  EXPECT_EQ(program.run().code, TrapCode::BadReference);
  EXPECT_EQ(get(program, kA), "abc");
}

}  // namespace
}  // namespace stepwright::vm
