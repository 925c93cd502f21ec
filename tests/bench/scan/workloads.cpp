#include "tests/bench/scan/workloads.h"

#include <random>
#include <utility>

#include "tests/support/test_program.h"

namespace stepwright::bench {

using bytecode::AddressMode;
using bytecode::FunctionKind;
using bytecode::MemType;
using bytecode::Opcode;
using writer::FunctionBuilder;

namespace {

constexpr std::uint32_t kInputBytes = Ladder::kInputs / 8;

void load_operand(FunctionBuilder& f, std::uint32_t operand) {
  if (operand < Ladder::kInputs) {
    f.load_bit(operand / 8, static_cast<std::uint8_t>(operand % 8));
  } else {
    f.load(MemType::Bool, AddressMode::Abs, kInputBytes + operand - Ladder::kInputs);
  }
}

unsigned read_operand(const std::uint8_t* image, std::uint32_t operand) {
  return operand < Ladder::kInputs ? (image[operand / 8] >> (operand % 8)) & 1u
                                   : image[kInputBytes + operand - Ladder::kInputs];
}

}  // namespace

Ladder::Ladder(std::uint32_t count, std::uint32_t seed) : rungs(count) {
  std::mt19937 random(seed);
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto operand = [&] { return static_cast<std::uint32_t>(random() % (kInputs + k)); };
    rungs[k] = {operand(), operand(), operand(), operand()};
  }
}

writer::ContainerModel Ladder::bytecode() const {
  const auto coils = static_cast<std::uint32_t>(rungs.size());
  writer::ContainerModel model = support::one_program(0, [&](FunctionBuilder& f) {
    for (std::uint32_t k = 0; k < coils; ++k) {
      load_operand(f, rungs[k].a);
      load_operand(f, rungs[k].b);
      f.emit(Opcode::NotBool);
      f.emit(Opcode::AndBool);
      load_operand(f, rungs[k].c);
      f.emit(Opcode::OrBool);
      load_operand(f, rungs[k].d);
      f.emit(Opcode::AndBool);
      f.store(MemType::Bool, AddressMode::Abs, kInputBytes + k);
    }
  });
  model.sizes = {kInputBytes, 0, 0, coils};
  return model;
}

void Ladder::reference(std::uint8_t* image) const {
  for (std::size_t k = 0; k < rungs.size(); ++k) {
    const Rung& rung = rungs[k];
    const unsigned power =
        ((read_operand(image, rung.a) & (read_operand(image, rung.b) ^ 1u)) | read_operand(image, rung.c)) &
        read_operand(image, rung.d);
    image[kInputBytes + k] = static_cast<std::uint8_t>(power);
  }
}

writer::ContainerModel Arithmetic::bytecode() {
  return support::one_program(12, [](FunctionBuilder& f) {
    const auto head = f.new_label();
    const auto end = f.new_label();
    f.const_i32(1);
    f.store(MemType::I32, AddressMode::This, 0);
    f.bind(head);
    f.load(MemType::I32, AddressMode::This, 0);
    f.const_i32(kIterations);
    f.emit(Opcode::LeI32);
    f.jump_if_false(end);
    f.load(MemType::F32, AddressMode::This, 8);
    f.const_f32(0.9999f);
    f.emit(Opcode::MulF32);
    f.load(MemType::I32, AddressMode::This, 0);
    f.emit(Opcode::I32ToF32);
    f.emit(Opcode::AddF32);
    f.store(MemType::F32, AddressMode::This, 8);
    f.load(MemType::I32, AddressMode::This, 4);
    f.const_i32(31);
    f.emit(Opcode::MulI32);
    f.load(MemType::I32, AddressMode::This, 0);
    f.emit(Opcode::AddI32);
    f.const_i32(65521);
    f.emit(Opcode::ModI32);
    f.store(MemType::I32, AddressMode::This, 4);
    f.load(MemType::I32, AddressMode::This, 0);
    f.const_i32(1);
    f.emit(Opcode::AddI32);
    f.store(MemType::I32, AddressMode::This, 0);
    f.jump(head);
    f.bind(end);
  });
}

void Arithmetic::reference() {
  for (i = 1; i <= kIterations; ++i) {
    x = x * 0.9999f + static_cast<float>(i);
    n = (n * 31 + i) % 65521;
  }
}

writer::ContainerModel Timers::bytecode() {
  FunctionBuilder timer("TON", FunctionKind::FunctionBlock, kSize);
  const auto running = timer.new_label();
  timer.load(MemType::Bool, AddressMode::This, 0);
  timer.jump_if_true(running);
  timer.emit(Opcode::Now);
  timer.store(MemType::I64, AddressMode::This, 10);
  timer.bind(running);
  timer.load(MemType::Bool, AddressMode::This, 0);
  timer.emit(Opcode::Now);
  timer.load(MemType::I64, AddressMode::This, 10);
  timer.emit(Opcode::SubI64);
  timer.load(MemType::I64, AddressMode::This, 2);
  timer.emit(Opcode::GeI64);
  timer.emit(Opcode::AndBool);
  timer.store(MemType::Bool, AddressMode::This, 1);
  timer.emit(Opcode::Return);
  std::vector<writer::Function> more;
  more.push_back(std::move(timer).take());
  return support::one_program(
      sizeof(Image),
      [](FunctionBuilder& f) {
        for (std::uint32_t k = 0; k < kCount; ++k) {
          const std::uint32_t instance = kFirst + k * kSize;
          f.load(MemType::Bool, AddressMode::Abs, 0);
          f.store(MemType::Bool, AddressMode::Abs, instance);
          f.const_i64(k * std::int64_t{1'000'000});
          f.store(MemType::I64, AddressMode::Abs, instance + 2);
          f.call_instance(AddressMode::Abs, 1, instance);
        }
      },
      std::move(more));
}

void Timers::reference(Image& image, std::int64_t now_ns) {
  for (std::uint32_t k = 0; k < kCount; ++k) {
    Timer& timer = image.timers[k];
    timer.in = image.input;
    timer.pt_ns = k * std::int64_t{1'000'000};
    if (timer.in == 0) timer.start_ns = now_ns;
    timer.q =
        static_cast<std::uint8_t>(timer.in & static_cast<unsigned>(now_ns - timer.start_ns >= timer.pt_ns));
  }
}

}  // namespace stepwright::bench
