// The quick form of the code: that each superinstruction is found where its parts stand, and means them.
// (TestProgram runs both forms and throws where they differ: memory, trap, its place, or budget.)

#include "runtime/vm/superinstruction.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "runtime/bytecode/instruction.h"
#include "tests/support/test_program.h"

namespace stepwright::vm {
namespace {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;
using support::one_program;
using support::TestProgram;
using writer::FunctionBuilder;

// The instance: variables, then an array of ten elements of four bytes, then what is left on the stack.
constexpr std::uint32_t kVariables = 8;
constexpr std::uint32_t kArray = 4 * kVariables;
constexpr std::uint32_t kElements = 10;
constexpr std::uint32_t kResults = kArray + 4 * kElements;
constexpr std::uint32_t kInstance = kResults + 40;

StackType type_of(char letter) {
  return letter == 'b'   ? StackType::Bool
         : letter == 'f' ? StackType::F32
         : letter == 'r' ? StackType::Ref
                         : StackType::I32;
}

MemType memory_of(StackType type) {
  return type == StackType::Bool  ? MemType::Bool
         : type == StackType::F32 ? MemType::F32
         : type == StackType::Ref ? MemType::Ref
                                  : MemType::I32;
}

// What the parts take from the stack that none of them has put there (deepest first), and what they leave.
struct Effect {
  std::string takes;
  std::string leaves;
};

Effect effect_of(const Superinstruction& super) {
  Effect out;
  for (std::uint32_t part = 0; part < super.count; ++part) {
    const bytecode::OpcodeInfo& info = bytecode::info(super.parts[part]);
    const std::string pops = info.pops;
    for (std::size_t i = pops.size(); i > 0; --i) {
      if (out.leaves.empty()) {
        out.takes.insert(out.takes.begin(), pops[i - 1]);
      } else {
        EXPECT_EQ(out.leaves.back(), pops[i - 1]) << super.name;
        out.leaves.pop_back();
      }
    }
    out.leaves += info.pushes;
  }
  return out;
}

// A program around one superinstruction with random operands.
class Sample {
 public:
  Sample(const Superinstruction& super, std::uint32_t seed) : super_(super), random_(seed) {}

  writer::ContainerModel model() {
    return one_program(kInstance, [&](FunctionBuilder& f) {
      const Effect effect = effect_of(super_);
      for (const char letter : effect.takes) push(f, letter);
      std::optional<writer::Label> end;
      for (std::uint32_t i = 0; i < super_.count; ++i) part(f, super_.parts[i], end);
      if (end) {
        f.const_bool(true);
        f.store(MemType::Bool, AddressMode::Abs, kInstance - 1);
        f.bind(*end);
      }
      std::uint32_t at = kResults;
      for (std::size_t i = effect.leaves.size(); i > 0; --i, at += 4) pop(f, effect.leaves[i - 1], at);
    });
  }

  std::uint32_t word() {
    const std::uint32_t kind = random(4);
    if (kind == 0) return static_cast<std::uint32_t>(random_());
    if (kind == 1) return std::bit_cast<std::uint32_t>(static_cast<float>(random(64)) - 20.0f);
    return random(14) - 2;
  }

 private:
  std::uint32_t random(std::uint32_t below) { return static_cast<std::uint32_t>(random_() % below); }

  // Through a local, with which no superinstruction starts.
  void push(FunctionBuilder& f, char letter) {
    const writer::LocalId local = f.add_local(type_of(letter));
    if (letter == 'r') {
      f.addr_this(random(kInstance));
      if (random(4) == 0) f.offset(random(kInstance));
    } else if (letter == 'b') {
      f.const_bool(random(2) == 0);
    } else if (letter == 'f') {
      f.const_f32(std::bit_cast<float>(word()));
    } else {
      f.const_i32(static_cast<std::int32_t>(word()));
    }
    f.local_set(local);
    f.local_get(local);
  }

  void pop(FunctionBuilder& f, char letter, std::uint32_t at) {
    const writer::LocalId local = f.add_local(type_of(letter));
    f.local_set(local);
    f.local_get(local);
    f.store(memory_of(type_of(letter)), AddressMode::Abs, at);
  }

  void part(FunctionBuilder& f, Opcode opcode, std::optional<writer::Label>& end) {
    const std::uint32_t variable = random(kVariables) * 4;
    switch (opcode) {
      case Opcode::AddrThis:
        return f.addr_this(kArray);
      case Opcode::Index: {
        const auto lower = static_cast<std::int32_t>(random(5)) - 2;
        return f.index(lower, lower + static_cast<std::int32_t>(kElements) - 1, 4);
      }
      case Opcode::ConstI32:
        return f.const_i32(static_cast<std::int32_t>(word()));
      case Opcode::ConstF32:
        return f.const_f32(std::bit_cast<float>(word()));
      case Opcode::LoadNotBoolThis:
        f.load(MemType::Bool, AddressMode::This, variable);
        return f.emit(Opcode::NotBool);
      case Opcode::JumpIfFalse:
        end = f.new_label();
        return f.jump_if_false(*end);
      default:
        break;
    }
    for (const MemType type : {MemType::Bool, MemType::I16, MemType::I32, MemType::F32}) {
      if (opcode == load_opcode(type, AddressMode::This)) return f.load(type, AddressMode::This, variable);
      if (opcode == store_opcode(type, AddressMode::This)) return f.store(type, AddressMode::This, variable);
    }
    f.emit(opcode);
  }

  const Superinstruction& super_;
  std::mt19937 random_;
};

bool stands_at(const Superinstruction& super, std::span<const std::byte> code, std::uint32_t pc) {
  for (std::uint32_t part = 0; part < super.count; ++part) {
    const std::uint32_t at = pc + super.offset(part);
    if (at >= code.size() || code[at] != static_cast<std::byte>(super.parts[part])) return false;
  }
  return true;
}

// The quick number where the parts stand.
std::optional<Quick> number_of(const Superinstruction& super, const bytecode::Program& program) {
  const auto code = program.container().section(bytecode::Section::Code);
  std::vector<std::byte> quick(code.size());
  quicken(program, quick);
  bytecode::Instruction in;
  for (std::uint32_t pc = 0; pc < code.size() && bytecode::decode(code, pc, in); pc += in.size) {
    if (stands_at(super, code, pc)) return static_cast<Quick>(quick[pc]);
  }
  return std::nullopt;
}

TEST(Superinstruction, Each_WhenRunOnRandomValues_ThenMeansItsParts) {
  for (const Superinstruction& super : kSuperinstructions) {
    std::uint32_t trapped = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
      Sample sample(super, seed);
      TestProgram program(sample.model());
      ASSERT_EQ(number_of(super, program.loaded().program()), super.number)
          << super.name << ", seed " << seed;
      for (std::uint32_t at = 0; at < kResults; at += 4) program.write(at, sample.word());
      ASSERT_NO_THROW(trapped += program.run() ? 1 : 0) << super.name << ", seed " << seed;
    }
    EXPECT_LT(trapped, 100u) << super.name << " never ran to its end";
  }
}

TEST(Superinstruction, AnArrayThatTheInstanceDoesNotHold_WhenQuickened_ThenItsElementsAreReachedByTheParts) {
  const auto quick_with = [](std::int32_t upper, std::uint32_t stride) {
    TestProgram program(one_program(kInstance, [&](FunctionBuilder& f) {
      f.addr_this(kArray);
      f.load(MemType::I32, AddressMode::This, 0);
      f.index(0, upper, stride);
      f.load(MemType::F32, AddressMode::Ind);
      f.store(MemType::F32, AddressMode::Abs, 4);
    }));
    program.write<std::int32_t>(0, 3);
    EXPECT_FALSE(program.run());
    std::vector<std::byte> code(
        program.loaded().program().container().section(bytecode::Section::Code).size());
    quicken(program.loaded().program(), code);
    return static_cast<Quick>(code[0]);
  };
  constexpr std::int32_t kHeld = (kInstance - kArray) / 4;
  EXPECT_EQ(quick_with(kHeld - 1, 4), Quick::ElementF32);
  EXPECT_EQ(quick_with(kHeld, 4), Quick::ElementRef);
  EXPECT_EQ(quick_with(4, 8), Quick::ElementRef);
}

// FOR i := 1 TO 5: with every budget up to one that is enough.
TEST(Superinstruction, ALoop_WhenTheBudgetEnds_ThenTrapsWhereItsPartsDo) {
  for (const MemType type : {MemType::I32, MemType::I16}) {
    const auto model = one_program(16, [&](FunctionBuilder& f) {
      const writer::Label start = f.new_label();
      f.const_i32(1);
      f.store(type, AddressMode::This, 0);
      f.bind(start);
      f.load(MemType::I32, AddressMode::This, 4);
      f.const_i32(3);
      f.emit(Opcode::AddI32);
      f.store(MemType::I32, AddressMode::This, 4);
      f.load(type, AddressMode::This, 0);
      f.const_i32(4);
      f.emit(Opcode::GtI32);
      f.load(type, AddressMode::This, 0);
      f.const_i32(1);
      f.emit(Opcode::AddI32);
      f.store(type, AddressMode::This, 0);
      f.jump_if_false(start);
    });
    bool finished = false;
    for (std::uint64_t budget = 0; budget < 400; budget += 3) {
      TestProgram program(model);
      std::uint64_t left = budget;
      bytecode::Trap trap;
      ASSERT_NO_THROW(trap = program.run(0, left)) << "budget " << budget;
      if (trap) {
        EXPECT_EQ(trap.code, bytecode::TrapCode::Watchdog);
      } else {
        finished = true;
        EXPECT_EQ(program.read<std::int32_t>(4), 15);
      }
    }
    EXPECT_TRUE(finished);
  }
}

// A jump may lead to any part: there it finds the part itself.
TEST(Superinstruction, APart_WhenAJumpLeadsToIt_ThenTheRestFollows) {
  TestProgram program(one_program(16, [](FunctionBuilder& f) {
    const writer::Label other = f.new_label();
    const writer::Label second = f.new_label();
    f.load(MemType::Bool, AddressMode::Abs, 12);
    f.jump_if_true(other);
    f.load(MemType::I32, AddressMode::This, 0);
    f.bind(second);
    f.load(MemType::I32, AddressMode::This, 4);
    f.emit(Opcode::AddI32);
    f.store(MemType::I32, AddressMode::This, 8);
    f.emit(Opcode::Return);
    f.bind(other);
    f.const_i32(100);
    f.jump(second);
  }));
  const Superinstruction& sum = superinstruction(Quick::VarVarAddI32ToVar);
  EXPECT_EQ(number_of(sum, program.loaded().program()), sum.number);
  program.write<std::int32_t>(0, 7);
  program.write<std::int32_t>(4, 1000);
  EXPECT_FALSE(program.run());
  EXPECT_EQ(program.read<std::int32_t>(8), 1007);
  program.write<std::uint8_t>(12, 1);
  EXPECT_FALSE(program.run());
  EXPECT_EQ(program.read<std::int32_t>(8), 1100);
}

}  // namespace
}  // namespace stepwright::vm
