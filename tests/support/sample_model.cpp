#include "tests/support/sample_model.h"

#include <utility>

namespace stepwright::support {

using bytecode::AddressMode;
using bytecode::ElementaryType;
using bytecode::FunctionKind;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;
using writer::FunctionBuilder;

namespace {

enum FunctionIndex : std::uint32_t { kMainFunction, kTonFunction, kScaleFunction, kSlowFunction };

// TON: IN at 0, Q at 1, PT at 2, start at 10.
writer::Function ton() {
  FunctionBuilder f("TON", FunctionKind::FunctionBlock, 18);
  const auto running = f.new_label();
  f.line(0, 2);
  f.load(MemType::Bool, AddressMode::This, 0);
  f.jump_if_true(running);
  f.emit(Opcode::Now);
  f.store(MemType::I64, AddressMode::This, 10);
  f.bind(running);
  f.line(0, 3);
  f.load(MemType::Bool, AddressMode::This, 0);
  f.emit(Opcode::Now);
  f.load(MemType::I64, AddressMode::This, 10);
  f.emit(Opcode::SubI64);
  f.load(MemType::I64, AddressMode::This, 2);
  f.emit(Opcode::GeI64);
  f.emit(Opcode::AndBool);
  f.store(MemType::Bool, AddressMode::This, 1);
  f.emit(Opcode::Return);
  return std::move(f).take();
}

writer::Function scale() {
  FunctionBuilder f("SCALE", FunctionKind::Function);
  const auto raw = f.add_param(StackType::I32);
  f.set_result(StackType::F32);
  f.line(0, 8);
  f.local_get(raw);
  f.emit(Opcode::I32ToF32);
  f.const_f32(0.25f);
  f.emit(Opcode::MulF32);
  f.emit(Opcode::Return);
  return std::move(f).take();
}

writer::Function main_program() {
  FunctionBuilder f("MAIN", FunctionKind::Program, SampleLayout::kMainSize);
  const auto index = f.add_local(StackType::I32);
  f.line(1, 10);
  f.load_bit(SampleLayout::kInputs, 0);
  f.store(MemType::Bool, AddressMode::This, SampleLayout::kTimer);
  f.const_i64(30'000'000);
  f.store(MemType::I64, AddressMode::This, SampleLayout::kTimer + 2);
  f.call_instance(AddressMode::This, kTonFunction, SampleLayout::kTimer);
  f.load(MemType::Bool, AddressMode::This, SampleLayout::kTimer + 1);
  f.emit(Opcode::Dup);
  f.store_bit(SampleLayout::kOutputs, 0);
  f.store(MemType::Bool, AddressMode::This, SampleLayout::kStep);
  f.line(1, 11);
  f.load(MemType::I16, AddressMode::Abs, SampleLayout::kInputs + 2);
  f.call(kScaleFunction);
  f.store(MemType::F32, AddressMode::This, SampleLayout::kLevel);
  f.line(1, 12);
  f.load(MemType::I32, AddressMode::This, SampleLayout::kCount);
  f.const_i32(8);
  f.emit(Opcode::ModI32);
  f.local_set(index);
  f.addr_this(SampleLayout::kHistory);
  f.local_get(index);
  f.index(0, 7, 2);
  f.load(MemType::I16, AddressMode::Abs, SampleLayout::kInputs + 2);
  f.store(MemType::I16, AddressMode::Ind);
  f.line(1, 13);
  f.load(MemType::I32, AddressMode::This, SampleLayout::kCount);
  f.const_i32(1);
  f.emit(Opcode::AddI32);
  f.store(MemType::I32, AddressMode::This, SampleLayout::kCount);
  f.emit(Opcode::Return);
  return std::move(f).take();
}

writer::Function slow_program() {
  FunctionBuilder f("SLOW", FunctionKind::Program, SampleLayout::kSlowSize);
  f.line(1, 20);
  f.load(MemType::I32, AddressMode::This, 0);
  f.const_i32(1);
  f.emit(Opcode::AddI32);
  f.store(MemType::I32, AddressMode::This, 0);
  f.load_bit(SampleLayout::kOutputs, 1);
  f.emit(Opcode::NotBool);
  f.store_bit(SampleLayout::kOutputs, 1);
  f.emit(Opcode::Return);
  return std::move(f).take();
}

void add_symbols(writer::ContainerModel& model) {
  using L = SampleLayout;
  const auto boolean = model.add_type(writer::elementary(ElementaryType::Bool));
  const auto word = model.add_type(writer::elementary(ElementaryType::Int));
  const auto dint = model.add_type(writer::elementary(ElementaryType::Dint));
  const auto real = model.add_type(writer::elementary(ElementaryType::Real));
  const auto time = model.add_type(writer::elementary(ElementaryType::Time));
  const auto history = model.add_type({.name = "ARRAY[1..8] OF INT",
                                       .kind = bytecode::TypeKind::Array,
                                       .size = 16,
                                       .element = word,
                                       .count = 8,
                                       .lower = 1,
                                       .members = {}});
  const auto timer = model.add_type({.name = "TON",
                                     .kind = bytecode::TypeKind::Instance,
                                     .size = 18,
                                     .members = {{"IN", boolean, 0}, {"Q", boolean, 1}, {"PT", time, 2}}});
  const auto main = model.add_type({.name = "MAIN",
                                    .kind = bytecode::TypeKind::Instance,
                                    .size = L::kMainSize,
                                    .members = {{"timer", timer, L::kTimer},
                                                {"level", real, L::kLevel},
                                                {"history", history, L::kHistory},
                                                {"count", dint, L::kCount},
                                                {"S1", boolean, L::kStep}}});
  const auto input = bytecode::SymbolSection::Global;
  model.symbols.push_back({"start", boolean, L::kInputs, 0, input, 0, "%IX0.0"});
  model.symbols.push_back({"raw", word, L::kInputs + 2, bytecode::kNoBit, input, 0, "%IW1"});
  model.symbols.push_back({"pump", boolean, L::kOutputs, 0, input, 0, "%QX0.0"});
  model.symbols.push_back({"MAIN", main, L::kMain, bytecode::kNoBit, bytecode::SymbolSection::Local, 0, ""});
  model.symbols.push_back({"SLOW.n", dint, L::kSlow, bytecode::kNoBit, bytecode::SymbolSection::Local,
                           bytecode::kSymbolRetain, ""});
}

}  // namespace

writer::ContainerModel sample_model() {
  using L = SampleLayout;
  writer::ContainerModel model;
  model.sizes = {4, 2, 0, L::kMainSize + L::kSlowSize};
  add_symbols(model);
  model.functions = {main_program(), ton(), scale(), slow_program()};
  model.tasks = {{"slow", 20'000, 5, {{"SLOW", kSlowFunction, L::kSlow}}},
                 {"fast", 10'000, 1, {{"MAIN", kMainFunction, L::kMain}}}};
  model.source_files = {"library.st", "main.st"};
  model.retain = {{L::kSlow, L::kSlowSize}};
  model.initial_data.resize(L::kSlow + 1);
  model.initial_data[L::kSlow] = std::byte{100};
  model.charts = {
      {"MAIN",
       {{"Init", "", L::kMain, bytecode::kNoBit, true}, {"S1", "(load v1 f1)", L::kMain + L::kStep}},
       {{"T1", "start", {0}, {1}, L::kOutputs, 0}, {"T2", "NOT start", {1}, {0}}}}};
  return model;
}

}  // namespace stepwright::support
