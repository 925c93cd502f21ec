// A variable of a loop that is reached by its name and by another way in the same turn: whatever the way,
// both engines leave the same memory. Native code keeps such variables in registers where nothing else
// reaches them.

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/unit/runtime/native/engine_pair.h"

namespace stepwright::native {
namespace {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;
using writer::FunctionBuilder;

// Of the instance.
constexpr std::uint32_t kCounter = 0;
constexpr std::uint32_t kTurns = 4;
constexpr std::uint32_t kCondition = 8;
constexpr std::uint32_t kZero = 12;  // an index
constexpr std::uint32_t kVariable = 16;
constexpr std::uint32_t kRef = 24;
constexpr std::uint32_t kByName = 32;
constexpr std::uint32_t kByWay = 40;
constexpr std::uint32_t kOther = 48;
constexpr std::uint32_t kBeside = 56;
constexpr std::uint32_t kBytes = 64;

constexpr MemType kTypes[] = {MemType::Bool, MemType::I8,  MemType::U8,  MemType::I16, MemType::U16,
                              MemType::I32,  MemType::I64, MemType::F32, MemType::F64};

struct Way {
  std::string name;
  std::function<void(FunctionBuilder&, std::uint32_t bytes)> push;         // leaves the variable's address
  std::function<void(FunctionBuilder&)> before = [](FunctionBuilder&) {};  // in front of the loop
};

void load(FunctionBuilder& f, MemType type, std::uint32_t at) {
  f.load(type, AddressMode::This, at);
}

void store(FunctionBuilder& f, MemType type, std::uint32_t at) {
  f.store(type, AddressMode::This, at);
}

void store_ref(FunctionBuilder& f) {
  f.addr_this(kVariable);
  store(f, MemType::Ref, kRef);
}

// The address stays on the stack over a branch; behind it two ways meet.
void push_over_branch(FunctionBuilder& f) {
  const auto behind = f.new_label();
  f.addr_this(kVariable);
  load(f, MemType::Bool, kCondition);
  f.jump_if_false(behind);
  f.const_i32(7);
  store(f, MemType::I32, kBeside);
  f.bind(behind);
}

void push_either(FunctionBuilder& f) {
  const auto behind = f.new_label();
  f.addr_this(kVariable);
  load(f, MemType::Bool, kCondition);
  f.jump_if_false(behind);
  f.emit(Opcode::Drop);
  f.addr_this(kOther);
  f.bind(behind);
}

std::vector<Way> ways() {
  const auto element = [](FunctionBuilder& f, std::int32_t lower, std::int32_t upper, std::uint32_t stride) {
    load(f, MemType::I32, kZero);
    f.const_i32(lower);
    f.emit(Opcode::AddI32);
    f.index(lower, upper, stride);
  };
  return {
      {"address of the instance", [](FunctionBuilder& f, std::uint32_t) { f.addr_this(kVariable); }},
      {"address of the image", [](FunctionBuilder& f, std::uint32_t) { f.addr_abs(kVariable); }},
      {"distance",
       [](FunctionBuilder& f, std::uint32_t) {
         f.addr_this(kCondition);
         f.offset(kVariable - kCondition);
       }},
      {"the only element",
       [](FunctionBuilder& f, std::uint32_t bytes) {
         f.addr_this(kVariable);
         load(f, MemType::I32, kZero);
         f.index(0, 0, bytes);
       }},
      {"the only element of the only element",
       [=](FunctionBuilder& f, std::uint32_t bytes) {
         f.addr_this(kVariable);
         element(f, -3, -3, bytes);
         element(f, 5, 5, bytes);
       }},
      {"one of several elements",
       [=](FunctionBuilder& f, std::uint32_t) {
         f.addr_this(kVariable);
         element(f, 1, 4, 8);
       }},
      {"a known element",
       [](FunctionBuilder& f, std::uint32_t) {
         f.addr_this(kVariable - 8);
         f.const_i32(1);
         f.index(0, 4, 8);
       }},
      {"bounds of the moment",
       [](FunctionBuilder& f, std::uint32_t bytes) {
         f.addr_this(kVariable);
         for (int i = 0; i < 3; ++i) load(f, MemType::I32, kZero);
         f.index_dyn(bytes);
       }},
      {"over a branch", [](FunctionBuilder& f, std::uint32_t) { push_over_branch(f); }},
      {"either of two", [](FunctionBuilder& f, std::uint32_t) { push_either(f); }},
      {"selected",
       [](FunctionBuilder& f, std::uint32_t) {
         f.addr_this(kVariable);
         f.addr_this(kOther);
         load(f, MemType::Bool, kCondition);
         f.emit(Opcode::Select);
       }},
      {"twice on the stack",
       [](FunctionBuilder& f, std::uint32_t) {
         f.addr_this(kVariable);
         f.emit(Opcode::Dup);
         store(f, MemType::Ref, kRef);
       }},
      {"a reference", [](FunctionBuilder& f, std::uint32_t) { load(f, MemType::Ref, kRef); }, store_ref},
      {"a reference of the loop",
       [](FunctionBuilder& f, std::uint32_t) {
         store_ref(f);
         load(f, MemType::Ref, kRef);
       }},
  };
}

// How the way is gone: straight, or with the address waiting on the stack while a branch is decided.
enum class Store { Straight, InBranch, Copy };

void advance(FunctionBuilder& f, MemType type) {
  switch (stack_type(type)) {
    case StackType::Bool:
      return f.emit(Opcode::NotBool);
    case StackType::I32:
      f.const_i32(1);
      return f.emit(Opcode::AddI32);
    case StackType::I64:
      f.const_i64(1);
      return f.emit(Opcode::AddI64);
    case StackType::F32:
      f.const_f32(1);
      return f.emit(Opcode::AddF32);
    default:
      f.const_f64(1);
      return f.emit(Opcode::AddF64);
  }
}

void store_by(FunctionBuilder& f, const Way& way, MemType type, Store kind) {
  const std::uint32_t bytes = size_of(type);
  way.push(f, bytes);
  if (kind == Store::Copy) {
    f.addr_this(kOther);
    return f.mem_copy(bytes);
  }
  const auto otherwise = f.new_label(), end = f.new_label();
  if (kind == Store::InBranch) {
    load(f, MemType::Bool, kCondition);
    f.jump_if_false(otherwise);
  }
  load(f, type, kOther);
  advance(f, type);
  f.store(type, AddressMode::Ind);
  if (kind == Store::Straight) return;
  f.jump(end);
  f.bind(otherwise);
  f.emit(Opcode::Drop);
  f.bind(end);
}

// WHILE counter < turns: what `body` does.
void repeat(FunctionBuilder& f, const std::function<void()>& body) {
  const auto start = f.new_label(), end = f.new_label();
  f.bind(start);
  load(f, MemType::I32, kCounter);
  load(f, MemType::I32, kTurns);
  f.emit(Opcode::LtI32);
  f.jump_if_false(end);
  body();
  load(f, MemType::I32, kCounter);
  f.const_i32(1);
  f.emit(Opcode::AddI32);
  store(f, MemType::I32, kCounter);
  f.jump(start);
  f.bind(end);
}

void next_by_name(FunctionBuilder& f, MemType type) {
  load(f, type, kVariable);
  advance(f, type);
  store(f, type, kVariable);
}

// On one instance the places of the image are its own; on two they are the first one's.
writer::ContainerModel model(bool two_instances, const std::function<void(FunctionBuilder&)>& emit) {
  writer::ContainerModel out = support::one_program(kBytes, emit);
  if (!two_instances) return out;
  out.sizes.data_bytes = 2 * kBytes;
  out.tasks[0].calls.push_back({"AGAIN", 0, kBytes});
  return out;
}

void expect_agreement(const writer::ContainerModel& model, const std::string& name) {
  EnginePair pair(model);
  const auto calls = static_cast<std::uint32_t>(model.tasks[0].calls.size());
  for (std::int32_t turns = 0; turns < 4; ++turns) {
    for (const bool condition : {false, true}) {
      for (std::uint32_t call = 0; call < calls; ++call) {
        pair.write<std::int32_t>(call * kBytes + kCounter, 0);
        pair.write(call * kBytes + kTurns, turns);
        pair.write(call * kBytes + kCondition, condition);
        EXPECT_EQ(pair.run_call(call), "") << name << ", " << turns << " turns, call " << call;
        EXPECT_FALSE(pair.trap()) << name;
      }
    }
  }
}

TEST(Aliasing, Variables_WhenALoopReachesThemByAnotherWay_ThenTheEnginesAgree) {
  if (!NativeEngine::supported()) GTEST_SKIP() << "one engine only";
  for (const Way& way : ways()) {
    for (const MemType type : kTypes) {
      for (const Store kind : {Store::Straight, Store::InBranch, Store::Copy}) {
        for (const bool two : {false, true}) {
          expect_agreement(model(two,
                                 [&](FunctionBuilder& f) {
                                   way.before(f);
                                   repeat(f, [&] {
                                     next_by_name(f, type);
                                     store_by(f, way, type, kind);
                                     load(f, type, kVariable);
                                     store(f, type, kByName);
                                     next_by_name(f, type);
                                     way.push(f, size_of(type));
                                     f.load(type, AddressMode::Ind);
                                     store(f, type, kByWay);
                                   });
                                 }),
                           way.name + " " + std::to_string(static_cast<int>(type)) + " " +
                               std::to_string(static_cast<int>(kind)) + (two ? " of two" : ""));
        }
      }
    }
  }
}

// The array is the variable: no other name leads there.
TEST(Aliasing, Arrays_WhenTheyHaveOneElement_ThenALoopKeepsWhatItWrites) {
  if (!NativeEngine::supported()) GTEST_SKIP() << "one engine only";
  for (const MemType type : kTypes) {
    EnginePair pair(model(false, [&](FunctionBuilder& f) {
      repeat(f, [&] {
        const auto element = [&] {
          f.addr_this(kVariable);
          load(f, MemType::I32, kZero);
          f.index(0, 0, size_of(type));
        };
        element();
        element();
        f.load(type, AddressMode::Ind);
        advance(f, type);
        f.store(type, AddressMode::Ind);
      });
    }));
    pair.write<std::int32_t>(kTurns, 3);
    EXPECT_EQ(pair.run(), "");
    std::uint64_t bits = 0;
    for (std::uint32_t i = 0; i < size_of(type); ++i)
      bits |= std::uint64_t{pair.read<std::uint8_t>(kVariable + i)} << 8 * i;
    EXPECT_NE(bits, 0u) << static_cast<int>(type);
  }
}

TEST(Aliasing, Variables_WhenALoopWritesPartsOfThem_ThenTheEnginesAgree) {
  if (!NativeEngine::supported()) GTEST_SKIP() << "one engine only";
  using Part = std::function<void(FunctionBuilder&)>;
  const std::vector<Part> parts = {
      [](FunctionBuilder& f) {
        f.const_i32(0x5A);
        f.store(MemType::U8, AddressMode::Abs, kVariable + 1);
      },
      [](FunctionBuilder& f) {
        load(f, MemType::Bool, kCondition);
        f.store_bit(kVariable, 3);
      },
      [](FunctionBuilder& f) {
        f.load_bit(kVariable, 1);
        store(f, MemType::Bool, kBeside);
      },
      [](FunctionBuilder& f) {
        f.addr_abs(kVariable + 1);
        f.addr_this(kOther);
        f.mem_copy(3);
      },
      [](FunctionBuilder& f) {
        load(f, MemType::F32, kVariable);
        store(f, MemType::F32, kBeside);
      },
      [](FunctionBuilder& f) {
        load(f, MemType::I64, kVariable - 4);
        store(f, MemType::I64, kBeside);
      },
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (const bool two : {false, true}) {
      const auto body = [&](FunctionBuilder& f) {
        repeat(f, [&] {
          next_by_name(f, MemType::I32);
          parts[i](f);
          next_by_name(f, MemType::I32);
        });
      };
      expect_agreement(model(two, body), "part " + std::to_string(i));
    }
  }
}

// The address lies on the stack for all of the loop.
TEST(Aliasing, Addresses_WhenTheyStayOnTheStackFromTurnToTurn_ThenTheEnginesAgree) {
  if (!NativeEngine::supported()) GTEST_SKIP() << "one engine only";
  for (const MemType type : kTypes) {
    for (const bool two : {false, true}) {
      const auto body = [&](FunctionBuilder& f) {
        f.addr_this(kVariable);
        repeat(f, [&] {
          next_by_name(f, type);
          f.emit(Opcode::Dup);
          f.emit(Opcode::Dup);
          f.load(type, AddressMode::Ind);
          advance(f, type);
          f.store(type, AddressMode::Ind);
          next_by_name(f, type);
        });
        f.emit(Opcode::Drop);
      };
      expect_agreement(model(two, body), std::to_string(static_cast<int>(type)));
    }
  }
}

// Both addresses wait at the same place of the stack, one behind the other, with no label between.
TEST(Aliasing, Addresses_WhenOneWaitsWhereAnotherDid_ThenEachLeadsToItsPlace) {
  if (!NativeEngine::supported()) GTEST_SKIP() << "one engine only";
  for (const bool in_loop : {false, true}) {
    EnginePair pair(model(false, [&](FunctionBuilder& f) {
      const auto body = [&] {
        const auto otherwise = f.new_label(), end = f.new_label();
        for (const std::uint32_t ref : {kRef, kRef + 4}) {
          load(f, MemType::Ref, ref);
          load(f, MemType::Bool, kCondition);
          f.jump_if_false(otherwise);
          f.const_i32(static_cast<std::int32_t>(ref));
          f.store(MemType::I32, AddressMode::Ind);
        }
        f.jump(end);
        f.bind(otherwise);
        f.emit(Opcode::Drop);
        f.bind(end);
      };
      in_loop ? repeat(f, body) : body();
    }));
    pair.write<std::int32_t>(kTurns, 2);
    pair.write<std::uint32_t>(kRef, kVariable);
    pair.write<std::uint32_t>(kRef + 4, kOther);
    pair.write(kCondition, true);
    EXPECT_EQ(pair.run(), "");
    EXPECT_EQ(pair.read<std::uint32_t>(kVariable), kRef);
    EXPECT_EQ(pair.read<std::uint32_t>(kOther), kRef + 4);
  }
}

// From the first instance to the second: a fixed distance, but none of the own variables.
TEST(Aliasing, Addresses_WhenTheyLeadOutOfTheInstance_ThenALoopKeepsWhatItWrites) {
  if (!NativeEngine::supported()) GTEST_SKIP() << "one engine only";
  EnginePair pair(model(true, [](FunctionBuilder& f) {
    repeat(f, [&] {
      for (int i = 0; i < 2; ++i) {
        f.addr_this(kVariable);
        f.offset(kBytes);
      }
      f.load(MemType::I32, AddressMode::Ind);
      f.const_i32(1);
      f.emit(Opcode::AddI32);
      f.store(MemType::I32, AddressMode::Ind);
    });
  }));
  pair.write<std::int32_t>(kTurns, 3);
  EXPECT_EQ(pair.run_call(0), "");
  EXPECT_FALSE(pair.trap());
  EXPECT_EQ(pair.read<std::int32_t>(kBytes + kVariable), 3);
}

// Nothing of the loop's variables is read ahead where it does not exist.
TEST(Aliasing, Addresses_WhenTheyLeadOutOfTheMemory_ThenTheLoopTrapsWhereItFollowsThem) {
  if (!NativeEngine::supported()) GTEST_SKIP() << "one engine only";
  constexpr std::uint32_t kMemory = 1u << 20;
  constexpr int kSteps = 1500;  // so far that nothing lies there
  EnginePair pair(support::one_program(kMemory, [](FunctionBuilder& f) {
    repeat(f, [&] {
      next_by_name(f, MemType::I32);
      for (int i = 0; i < 2; ++i) {
        f.addr_this(kVariable);
        for (int step = 0; step < kSteps; ++step) f.offset(kMemory);
      }
      f.load(MemType::I32, AddressMode::Ind);
      f.store(MemType::I32, AddressMode::Ind);
    });
  }));
  pair.write<std::int32_t>(kTurns, 3);
  EXPECT_EQ(pair.run(), "");
  EXPECT_EQ(pair.trap().code, bytecode::TrapCode::BadReference);
  EXPECT_EQ(pair.read<std::int32_t>(kVariable), 1);
}

}  // namespace
}  // namespace stepwright::native
