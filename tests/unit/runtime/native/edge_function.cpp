#include "tests/unit/runtime/native/edge_function.h"

#include <cstring>
#include <string_view>

namespace stepwright::native {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::Operands;
using bytecode::StackType;

namespace {

using namespace edge_layout;

constexpr std::string_view kLetters = "bilfdr";  // in the order of StackType

std::uint8_t number(char letter) {
  return static_cast<std::uint8_t>(kLetters.find(letter));
}

MemType memory_of(char letter) {
  constexpr MemType kTypes[] = {MemType::Bool, MemType::I32, MemType::I64,
                                MemType::F32,  MemType::F64, MemType::Ref};
  return kTypes[number(letter)];
}

class EdgeFunction {
 public:
  EdgeFunction(const Shape& shape, const Surrounding& around, const std::vector<Source>& sources,
               const std::vector<std::uint64_t>& values)
      : shape_(shape), around_(around), sources_(sources), values_(values) {
    out_.name = "edge";
    out_.kind = bytecode::FunctionKind::Program;
    out_.instance_size = kInstanceBytes;
    out_.frame_size = kFrameBytes;
    out_.constants = shape.constants;
    for (const char each : shape.locals + shape.pops + shape.pushes)
      out_.locals.push_back(static_cast<StackType>(number(each)));
  }

  writer::Function run() && {
    copy_to_locals();
    const std::size_t start = out_.code.size();
    if (around_.above) load('l', around_.of_instance ? AddressMode::This : AddressMode::Abs, result_place(0));
    for (std::size_t i = 0; i < shape_.pops.size(); ++i) push(i);
    op(shape_.opcode);
    operands();
    if (shape_.opcode == Opcode::Trap) return std::move(out_);  // nothing comes behind it
    results();
    if (around_.above) store('l', AddressMode::Abs, kOutputs + 56);
    if (around_.in_loop) again(start);
    op(Opcode::Return);
    return std::move(out_);
  }

 private:
  void byte(std::uint32_t value) { out_.code.push_back(static_cast<std::byte>(value)); }
  void word(std::uint32_t value) {
    for (int i = 0; i < 4; ++i) byte(value >> (8 * i) & 0xFF);
  }
  void op(Opcode opcode) { byte(static_cast<std::uint8_t>(opcode)); }
  void op(Opcode opcode, std::uint32_t operand) {
    op(opcode);
    word(operand);
  }
  void load(char letter, AddressMode mode, std::uint32_t at) { op(load_opcode(memory_of(letter), mode), at); }
  void store(char letter, AddressMode mode, std::uint32_t at) {
    op(store_opcode(memory_of(letter), mode), at);
  }

  std::uint32_t result_place(std::size_t result) const {
    return static_cast<std::uint32_t>((around_.of_instance ? 64 : kOutputs) + 8 * result);
  }
  std::uint32_t local_of_operand(std::size_t operand) const {
    return static_cast<std::uint32_t>(shape_.locals.size() + operand);
  }

  void push_place(std::size_t operand) {
    const auto at = static_cast<std::uint32_t>(8 * operand);
    if (around_.of_instance) return load(shape_.pops[operand], AddressMode::This, at);
    load(shape_.pops[operand], AddressMode::Abs, kInputs + at);
  }

  void copy_to_locals() {
    // What LocalGet reads is something else than zero.
    if (shape_.opcode == Opcode::LocalGet) {
      load(shape_.locals[0], AddressMode::Abs, kInputs + 40);
      op(Opcode::LocalSet, 0);
    }
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (sources_[i] != Source::Local) continue;
      push_place(i);
      op(Opcode::LocalSet, local_of_operand(i));
    }
  }

  void push(std::size_t operand) {
    const char letter = shape_.pops[operand];
    switch (sources_[operand]) {
      case Source::Memory:
        return push_place(operand);
      case Source::Local:
        return op(Opcode::LocalGet, local_of_operand(operand));
      case Source::Constant:
        return constant(letter, values_[operand]);
      case Source::Flags:
        if (letter != 'b') return computed(operand);
        push_place(operand);
        op(Opcode::BoolToI32);
        constant('i', 0);
        return op(Opcode::NeI32);
      case Source::Computed:
        return computed(operand);
    }
  }

  // With something added that changes nothing.
  void computed(std::size_t operand) {
    constexpr Opcode kAdd[] = {Opcode::XorBool, Opcode::AddI32, Opcode::AddI64,
                               Opcode::AddF32,  Opcode::AddF64, Opcode::IndexDyn};
    const char letter = shape_.pops[operand];
    push_place(operand);
    if (letter == 'r') {
      for (int i = 0; i < 3; ++i) load('i', AddressMode::Abs, kZeros);
      return op(Opcode::IndexDyn, 1);
    }
    load(letter, AddressMode::Abs, letter == 'd' ? kZeros + 8 : kZeros);
    op(kAdd[number(letter)]);
  }

  void constant(char letter, std::uint64_t bits) {
    const auto low = static_cast<std::uint32_t>(bits);
    switch (letter) {
      case 'b':
        op(Opcode::ConstBool);
        return byte(low);
      case 'i':
        return op(Opcode::ConstI32, low);
      case 'f':
        return op(Opcode::ConstF32, low);
      case 'r':
        if (low >= kImageBytes) return op(Opcode::ConstNull);
        return op(Opcode::AddrAbs, low);
      default:
        out_.constants.push_back(bits);
        op(letter == 'l' ? Opcode::ConstI64 : Opcode::ConstF64,
           static_cast<std::uint32_t>(out_.constants.size() - 1));
    }
  }

  void operands() {
    const auto at = [&](std::size_t i) { return shape_.operands[i]; };
    switch (bytecode::info(shape_.opcode).operands) {
      case Operands::None:
        return;
      case Operands::U8:
        return byte(at(0));
      case Operands::ByteBit:
        word(at(0));
        return byte(at(1));
      default:
        for (const std::uint32_t each : shape_.operands) word(each);
    }
  }

  void results() {
    if (shape_.opcode == Opcode::LocalSet) {
      op(Opcode::LocalGet, 0);
      store(shape_.locals[0], AddressMode::Abs, kOutputs);
    }
    for (std::size_t i = shape_.pushes.size(); i > 0; --i) {
      const char letter = shape_.pushes[i - 1];
      if (letter == 'b' && around_.branch) {
        branch(i - 1);
      } else if (!sources_.empty() && sources_[0] == Source::Local) {
        // By way of a local.
        const auto local = static_cast<std::uint32_t>(shape_.locals.size() + shape_.pops.size() + i - 1);
        op(Opcode::LocalSet, local);
        op(Opcode::LocalGet, local);
        store_result(letter, i - 1);
      } else {
        store_result(letter, i - 1);
      }
    }
  }

  void store_result(char letter, std::size_t result) {
    store(letter, around_.of_instance ? AddressMode::This : AddressMode::Abs, result_place(result));
  }

  // The result decides whether a number is stored; both ways meet behind it.
  void branch(std::size_t result) {
    constexpr std::uint32_t kSkipped = 10;  // a constant and its store
    op(Opcode::JumpIfFalse, kSkipped);
    constant('i', 77);
    store_result('i', result);
  }

  void again(std::size_t start) {
    load('i', AddressMode::This, kCounter);
    constant('i', 1);
    op(Opcode::SubI32);
    op(Opcode::Dup);
    store('i', AddressMode::This, kCounter);
    op(Opcode::I32ToBool);
    op(Opcode::JumpIfTrue,
       static_cast<std::uint32_t>(start) - static_cast<std::uint32_t>(out_.code.size()) - 5);
  }

  const Shape& shape_;
  const Surrounding& around_;
  const std::vector<Source>& sources_;
  const std::vector<std::uint64_t>& values_;
  writer::Function out_;
};

}  // namespace

writer::Function edge_function(const Shape& shape, const Surrounding& around,
                               const std::vector<Source>& sources, const std::vector<std::uint64_t>& values) {
  return EdgeFunction(shape, around, sources, values).run();
}

writer::ContainerModel edge_model() {
  writer::ContainerModel model;
  model.sizes = {.input_bytes = kOutputs,
                 .output_bytes = kInstances - kOutputs,
                 .marker_bytes = 0,
                 .data_bytes = kImageBytes - kInstances};
  return model;
}

}  // namespace stepwright::native
