// Every opcode at the edges of its operands, on both engines: memory, trap and budget are the same. The
// random programs of differential_test.cpp meet such values by chance only. Where an emulator makes the whole
// too long: STEPWRIGHT_EDGE_RUNS is how often each function runs at most, STEPWRIGHT_EDGE_PART=3/8 takes each
// eighth shape from the third on.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

#include "runtime/bytecode/instruction.h"
#include "tests/unit/runtime/native/edge_control.h"
#include "tests/unit/runtime/native/edge_function.h"
#include "tests/unit/runtime/native/edge_values.h"
#include "tests/unit/runtime/native/engine_pair.h"

namespace stepwright::native {
namespace {

using namespace edge_layout;
using bytecode::Opcode;

using Values = std::vector<std::uint64_t>;

constexpr std::size_t kMostRuns = 1500;     // of the plainest function around an instruction
constexpr std::size_t kMostFewRuns = 60;    // of each of the others
constexpr std::size_t kMostConstants = 80;  // functions with constants

// A function, and which of its operands the runs vary.
struct Case {
  Surrounding around;
  std::vector<Source> sources;
  Values constants;
  bool two_instances = false;
  std::size_t most_runs = kMostFewRuns;
};

// Calls `visit` with one value of each list, in every combination or, if those are too many, in a sample.
template <typename Visit>
void combine(const std::vector<Values>& lists, std::size_t most, std::mt19937& random, Visit visit) {
  std::size_t all = 1;
  for (const Values& each : lists) all = std::min<std::size_t>(all * each.size(), 1u << 30);
  Values chosen(lists.size());
  for (std::size_t i = 0; i < std::min(all, most); ++i) {
    std::size_t rest = i;
    for (std::size_t k = 0; k < lists.size(); ++k) {
      chosen[k] = lists[k][(all <= most ? rest : random()) % lists[k].size()];
      rest /= lists[k].size();
    }
    visit(chosen);
  }
}

std::vector<std::vector<Source>> source_patterns(std::size_t operands) {
  std::vector<std::vector<Source>> out;
  if (operands == 0) return {{}};
  for (const Source each : {Source::Memory, Source::Local, Source::Computed, Source::Flags})
    out.emplace_back(operands, each);
  for (std::size_t odd = 0; operands > 1 && odd < operands; ++odd) {
    for (const Source each : {Source::Computed, Source::Flags}) {
      out.emplace_back(operands, Source::Memory);
      out.back()[odd] = each;
    }
  }
  return out;
}

std::vector<Case> variable_cases(const Shape& shape) {
  std::vector<Case> out;
  for (const std::vector<Source>& sources : source_patterns(shape.pops.size())) {
    for (const bool of_instance : {false, true}) {
      for (const bool second : {false, true}) {
        out.push_back({{.of_instance = of_instance}, sources, {}, second});
        out.push_back({{.of_instance = of_instance, .in_loop = true}, sources, {}, second});
      }
      out.push_back({{.of_instance = of_instance, .above = true}, sources, {}, of_instance});
      if (shape.pushes == "b") out.push_back({{.of_instance = of_instance, .branch = true}, sources, {}});
    }
  }
  out.front().most_runs = kMostRuns;
  return out;
}

// One operand constant and the others not, and all of them.
std::vector<Case> constant_cases(const Shape& shape, std::mt19937& random) {
  std::vector<Case> out;
  const std::size_t count = shape.pops.size();
  const std::vector<Values> values = operand_values(shape);
  const bool branches = shape.pushes == "b";
  for (std::size_t fixed = 0; count > 1 && fixed < count; ++fixed) {
    for (const std::uint64_t value : values[fixed]) {
      std::vector<Source> sources(count, random() % 2 == 0 ? Source::Memory : Source::Computed);
      sources[fixed] = Source::Constant;
      Values constants(count);
      constants[fixed] = value;
      const bool in_loop = random() % 3 == 0;
      out.push_back({{.in_loop = in_loop, .branch = branches && random() % 2 == 0}, sources, constants});
    }
  }
  if (count == 0) return out;
  combine(values, kMostConstants, random, [&](const Values& chosen) {
    out.push_back({{.branch = branches && random() % 2 == 0}, std::vector(count, Source::Constant), chosen});
  });
  return out;
}

std::size_t most_runs() {
  const char* const text = std::getenv("STEPWRIGHT_EDGE_RUNS");
  return text == nullptr ? SIZE_MAX : std::strtoul(text, nullptr, 10);
}

// Of every `of` shapes the `part`th, from 1.
struct Part {
  std::size_t part = 1, of = 1;
  bool has(std::size_t shape) const { return shape % of == part - 1; }
};

Part asked_part() {
  const char* const text = std::getenv("STEPWRIGHT_EDGE_PART");
  if (text == nullptr) return {};
  Part out;
  if (std::sscanf(text, "%zu/%zu", &out.part, &out.of) != 2 || out.part < 1 || out.part > out.of) {
    ADD_FAILURE() << "STEPWRIGHT_EDGE_PART is '" << text << "': a part such as 3/8";
    return {};
  }
  return out;
}

class Edges {
 public:
  Edges(const Shape& shape, const std::vector<Case>& cases)
      : shape_(shape), cases_(cases), most_runs_(most_runs()), memory_(edge_memory()) {
    writer::ContainerModel model = edge_model();
    model.tasks.emplace_back().name = "task";
    for (const Case& each : cases) {
      const auto function = static_cast<std::uint32_t>(model.functions.size());
      model.functions.push_back(edge_function(shape, each.around, each.sources, each.constants));
      add_call(model, function, kInstances);
      if (each.two_instances) add_call(model, function, kSecondInstance);
    }
    pair_ = std::make_unique<EnginePair>(model);
  }

  // The first difference, or nothing.
  std::string run(std::mt19937& random) {
    std::uint32_t call = 0;
    for (const Case& each : cases_) {
      for (const std::uint32_t instance : {kInstances, kSecondInstance}) {
        if (instance == kSecondInstance && !each.two_instances) continue;
        if (const std::string found = run(each, call++, instance, random); !found.empty()) return found;
      }
    }
    return {};
  }

 private:
  void add_call(writer::ContainerModel& model, std::uint32_t function, std::uint32_t instance) {
    model.tasks[0].calls.push_back({"call", function, instance});
  }

  std::string run(const Case& each, std::uint32_t call, std::uint32_t instance, std::mt19937& random) {
    std::vector<Values> lists = operand_values(shape_);
    for (std::size_t i = 0; i < lists.size(); ++i) {
      if (each.sources[i] == Source::Constant) lists[i] = {0};
    }
    std::string found;
    combine(lists, std::min(each.most_runs, most_runs_), random, [&](const Values& chosen) {
      if (!found.empty()) return;
      fill(each, instance, chosen, random);
      pair_->reset(memory_);
      found = pair_->run_call(call, 123'456'789'012);
      if (!found.empty()) found = describe(each, chosen) + found;
    });
    return found;
  }

  void fill(const Case& each, std::uint32_t instance, const Values& chosen, std::mt19937& random) {
    const std::uint32_t at = each.around.of_instance ? instance : kInputs;
    for (std::uint32_t i = 0; i < 8; ++i) {
      std::uint64_t bits = random();
      if (i < chosen.size()) bits = chosen[i];
      // Devices may write anything into the byte of a BOOL.
      if (i < chosen.size() && shape_.pops[i] == 'b' && !each.around.of_instance && bits != 0 &&
          random() % 2 == 0)
        bits = 254;
      std::memcpy(&memory_[at + 8 * i], &bits, sizeof bits);
    }
    const std::uint32_t turns = 2;
    for (const std::uint32_t base : {kInstances, kSecondInstance}) {
      std::memcpy(&memory_[base + kCounter], &turns, sizeof turns);
      for (std::uint32_t i = 0; i < 24; ++i)
        memory_[base + kBools + i] = static_cast<std::byte>(random() & 1);
    }
  }

  std::string describe(const Case& each, const Values& chosen) const {
    std::ostringstream out;
    out << name_of(shape_) << std::hex;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const bool constant = each.sources[i] == Source::Constant;
      out << " " << static_cast<int>(each.sources[i]) << ":0x" << (constant ? each.constants[i] : chosen[i]);
    }
    out << (each.around.of_instance ? " instance" : "") << (each.around.in_loop ? " loop" : "")
        << (each.around.above ? " above" : "") << (each.around.branch ? " branch" : "")
        << (each.two_instances ? " of two" : "") << ": ";
    return out.str();
  }

  const Shape& shape_;
  const std::vector<Case>& cases_;
  const std::size_t most_runs_;
  std::vector<std::byte> memory_;
  std::unique_ptr<EnginePair> pair_;
};

template <typename MakeCases>
void run_all(MakeCases make_cases) {
  if (!NativeEngine::supported()) GTEST_SKIP() << "one engine only";
  const Part part = asked_part();
  std::size_t number = 0;
  for (std::uint32_t i = 0; i < bytecode::kOpcodeCount; ++i) {
    for (const Shape& shape : shapes_of(static_cast<Opcode>(i))) {
      if (!part.has(number++)) continue;
      std::mt19937 random(static_cast<std::uint32_t>(number));  // the same values whatever part it is in
      const std::vector<Case> cases = make_cases(shape, random);
      if (cases.empty()) continue;
      EXPECT_EQ(Edges(shape, cases).run(random), "");
    }
  }
}

TEST(OpcodeEdges, Operands_WhenTheyVary_ThenTheEnginesAgree) {
  run_all([](const Shape& shape, std::mt19937&) { return variable_cases(shape); });
}

TEST(OpcodeEdges, Operands_WhenSomeAreConstant_ThenTheEnginesAgree) {
  run_all([](const Shape& shape, std::mt19937& random) { return constant_cases(shape, random); });
}

TEST(OpcodeEdges, Control_WhenItBranchesAndCalls_ThenTheEnginesAgree) {
  if (!NativeEngine::supported()) GTEST_SKIP() << "one engine only";
  for (const ControlCase& each : control_cases()) {
    EnginePair pair(each.model);
    for (std::uint32_t value = 0; value < each.inputs.size(); ++value) {
      for (const std::uint64_t budget : {1'000'000ull, 200ull, 100ull, 60ull, 40ull, 20ull, 0ull}) {
        pair.reset(edge_memory());
        pair.write(kInputs, each.inputs[value]);
        EXPECT_EQ(pair.run(7, budget), "")
            << each.name << ", input " << each.inputs[value] << ", budget " << budget;
      }
    }
  }
}

// Which opcodes the functions of a model have.
void mark_opcodes(const writer::Function& function, std::vector<bool>& seen) {
  bytecode::Instruction in;
  for (std::uint32_t pc = 0; pc < function.code.size() && decode(function.code, pc, in); pc += in.size)
    seen[static_cast<std::size_t>(in.opcode)] = true;
}

// Who adds an opcode adds its shapes (opcode_shapes.cpp), or its functions if it decides where to go on
// (edge_control.cpp).
TEST(OpcodeEdges, Table_WhenAnOpcodeExists_ThenItHasACase) {
  std::vector<bool> seen(bytecode::kOpcodeCount, false);
  for (const ControlCase& each : control_cases())
    for (const writer::Function& function : each.model.functions) mark_opcodes(function, seen);
  for (std::uint32_t i = 0; i < bytecode::kOpcodeCount; ++i) {
    const bool has_shape = !shapes_of(static_cast<Opcode>(i)).empty();
    EXPECT_TRUE(has_shape || seen[i]) << bytecode::kOpcodes[i].name;
  }
  EXPECT_EQ(shapes_of(Opcode::Intrinsic).size(), bytecode::kIntrinsicCount);
  EXPECT_EQ(shapes_of(Opcode::StringOp).size(), bytecode::kStringOpCount);
}

}  // namespace
}  // namespace stepwright::native
