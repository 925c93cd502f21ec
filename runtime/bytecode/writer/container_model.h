#pragma once

// Input of the container writer, which a compiler fills: the content of a container with names, vectors and
// indexes instead of offsets. Host side only; plain data, no thread rule. Invariant: a type refers only to
// types before it, but for the target of a reference.
//
//   ContainerModel model;
//   model.sizes = {.input_bytes = 2, .output_bytes = 1, .marker_bytes = 0, .data_bytes = 16};
//   const auto real = model.add_type(elementary(ElementaryType::Real));
//   model.symbols.push_back({.name = "MAIN.level", .type = real, .address = 3});
//   FunctionBuilder main("MAIN", FunctionKind::Program, 16);
//   main.load(MemType::F32, AddressMode::This, 0); ...; main.emit(Opcode::Return);
//   model.functions.push_back(std::move(main).take());
//   model.tasks.push_back({.name = "fast", .interval_us = 10'000, .calls = {{"MAIN", 0, 3}}});
//   result::Result<std::vector<std::byte>> bytes = write_container(model);

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/bytecode/container_format.h"
#include "runtime/bytecode/value_type.h"
#include "runtime/bytecode/writer/function_builder.h"

namespace stepwright::writer {

// Absolute addresses count from the start of the image: inputs, then outputs, markers, data, without gaps.
struct AreaSizes {
  std::uint32_t input_bytes = 0;
  std::uint32_t output_bytes = 0;
  std::uint32_t marker_bytes = 0;
  std::uint32_t data_bytes = 0;
};

struct Member {
  std::string name;
  std::uint32_t type = 0;
  std::uint32_t offset = 0;  // an enumerator's value
  std::uint32_t flags = 0;   // bytecode::MemberFlag
};

// One data type; references to other types are indexes into ContainerModel::types and must point backwards.
struct Type {
  std::string name;
  bytecode::TypeKind kind = bytecode::TypeKind::Elementary;
  bytecode::ElementaryType elementary = bytecode::ElementaryType::Bool;
  std::uint32_t size = 1;
  std::uint32_t element = 0;  // Array: its element's type. Reference: the target's type, which may come later
  std::uint32_t count = 0;    // Array: number of elements. String: capacity
  std::int64_t lower = 0;     // Array: index of the first element. Subrange: lower bound
  std::int64_t upper = 0;     // Subrange: upper bound
  std::vector<Member>
      members;  // Struct, Instance; Enumeration: its enumerators (the member's type is ignored)
};

// A scalar type under its own name.
Type elementary(bytecode::ElementaryType type);

// STRING[capacity] or WSTRING[capacity]; requires 0..65535 characters.
Type string_type(bytecode::ElementaryType type, std::uint32_t capacity);

// A variable by its path. List instances' leaves or the instance itself with a type of kind Instance: lookups
// walk through arrays, structs and instances, so that one symbol per instance is enough.
struct Symbol {
  std::string name;
  std::uint32_t type = 0;
  std::uint32_t address = 0;
  std::uint8_t bit = bytecode::kNoBit;
  bytecode::SymbolSection section = bytecode::SymbolSection::Local;
  std::uint16_t flags = 0;     // bytecode::SymbolFlag
  std::string direct_address;  // "%IX0.0" if located: becomes an entry of the I/O map
};

struct ProgramCall {
  std::string name;
  std::uint32_t function = 0;  // index into ContainerModel::functions
  std::uint32_t instance = 0;  // absolute address
};

struct Task {
  std::string name;
  std::uint32_t interval_us = 10'000;
  std::uint32_t priority = 0;
  std::vector<ProgramCall> calls;
  std::uint32_t trigger = bytecode::kNoIndex;  // symbol: its rising edge runs the task; interval 0: only then
};

struct SfcStep {
  std::string name;
  std::string comment;
  std::uint32_t address = 0;
  std::uint8_t bit = bytecode::kNoBit;
  bool initial = false;
};

struct SfcTransition {
  std::string name;
  std::string condition;
  std::vector<std::uint32_t> sources;  // indexes into SfcChart::steps
  std::vector<std::uint32_t> targets;
  std::uint32_t address = bytecode::kNoIndex;  // of the transition bit, if there is one
  std::uint8_t bit = bytecode::kNoBit;
};

struct SfcChart {
  std::string name;
  std::vector<SfcStep> steps;
  std::vector<SfcTransition> transitions;
};

struct ContainerModel {
  AreaSizes sizes;
  std::vector<Type> types;
  std::vector<Symbol> symbols;
  std::vector<Task> tasks;
  std::vector<Function> functions;      // a function's index here is what calls name
  std::vector<std::byte> initial_data;  // of the image from address 0; shorter = the rest is zero
  std::vector<bytecode::RetainRecord> retain;
  std::vector<SfcChart> charts;
  std::vector<std::string> source_files;  // named by Function::lines

  // Appends and returns its index; a type with the name of an earlier one is that one.
  std::uint32_t add_type(Type type);
};

}  // namespace stepwright::writer
