// The checked form of native code says so where an effect is wrong: without that, tests in which no check
// fails would show nothing.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <new>
#include <optional>
#include <vector>

#include "runtime/native/internal/program_code.h"
#include "tests/unit/runtime/native/engine_pair.h"

namespace stepwright::native {
namespace {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::Opcode;
using writer::FunctionBuilder;

constexpr std::uint32_t kCounter = 0;
constexpr std::uint32_t kVariable = 4;
constexpr std::uint32_t kRef = 8;
constexpr std::uint32_t kElsewhere = 16;
constexpr std::uint32_t kBytes = 32;

// A loop of three turns in which the variable is reached by its name and by a reference.
reader::LoadedProgram loop_with_reference(bool store) {
  return support::TestProgram::load(support::one_program(kBytes, [=](FunctionBuilder& f) {
    const auto start = f.new_label();
    f.addr_this(kVariable);
    f.store(MemType::Ref, AddressMode::This, kRef);
    f.bind(start);
    f.load(MemType::Ref, AddressMode::This, kRef);
    if (store) {
      f.const_i32(7);
      f.store(MemType::I32, AddressMode::Ind);
    } else {
      f.load(MemType::I32, AddressMode::Ind);
      f.store(MemType::I32, AddressMode::This, kElsewhere + 8);
    }
    for (const std::uint32_t at : {kVariable, kCounter}) {
      f.load(MemType::I32, AddressMode::This, at);
      f.const_i32(1);
      f.emit(Opcode::AddI32);
      f.store(MemType::I32, AddressMode::This, at);
    }
    f.load(MemType::I32, AddressMode::This, kCounter);
    f.const_i32(3);
    f.emit(Opcode::LtI32);
    f.jump_if_true(start);
  }));
}

// Runs the checked code that is made of these facts; where a check failed, if one did.
std::optional<CodePlace> broken(const bytecode::Program& program, const ProgramFacts& facts) {
  ProgramCode code;
  EXPECT_EQ(make_code(facts, true, code), asmjit::kErrorOk);
  std::vector<std::uint64_t> block(facts.context_bytes() / sizeof(std::uint64_t) + 1);
  std::vector<std::uint64_t> returns(kMostCalls);
  std::vector<std::byte> memory(program.memory_size());
  Context& context = *new (block.data()) Context{};
  context.budget = 1'000'000;
  context.memory = memory.data();
  context.memory_size = memory.size();
  context.self = memory.data();
  context.returns = returns.data();
  EXPECT_EQ(code.enter(&context, code.functions[0]), 0u);
  if (context.broken_check == 0) return std::nullopt;
  return code.checks[context.broken_check - 1];
}

// The effect of the access by reference is changed before code is made of it.
void expect_found(bool store, const std::function<void(MemoryEffect&)>& change) {
  if (!kHasCheckedForm) GTEST_SKIP() << "no checked form";
  const auto loaded = loop_with_reference(store);
  ProgramFacts facts(loaded.program());
  EXPECT_FALSE(broken(loaded.program(), facts));
  auto& effects = const_cast<std::vector<MemoryEffect>&>(facts.effects(0));
  const auto by_reference = std::find_if(effects.begin(), effects.end(), [](const MemoryEffect& each) {
    return each.extent.space == Space::Unknown;
  });
  ASSERT_NE(by_reference, effects.end());
  change(*by_reference);
  const auto found = broken(loaded.program(), facts);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->pc, facts.code(0).items[by_reference->item].pc);
}

void claim_elsewhere(MemoryEffect& effect) {
  effect.extent = {Space::Image, kElsewhere, kElsewhere + 8};
}

void claim_fixed(MemoryEffect& effect) {
  effect.extent = {Space::Image, kElsewhere, kElsewhere + 4};
  effect.inside = effect.fixed = true;
}

TEST(EffectCheck, Store_WhenItLeavesItsExtent_ThenTheCheckFails) {
  expect_found(true, claim_elsewhere);
  expect_found(true, claim_fixed);
}

TEST(EffectCheck, Load_WhenItLeavesItsExtent_ThenTheCheckFails) {
  expect_found(false, claim_elsewhere);
  expect_found(false, claim_fixed);
}

}  // namespace
}  // namespace stepwright::native
