#pragma once

// Values and places as instructions. Internal to this folder.
//
// On the operand stack narrow integers are exact: INT -1 is the I32 -1, UINT 65535 the I32 65535. Where the
// upper bits do not matter (below + - *, before a store to memory) the wrap is left out: `Width::Any`.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ladder/codegen/container_limits.h"
#include "ladder/codegen/literal_pool.h"
#include "ladder/semantics/model/model.h"
#include "ladder/source/source_set.h"
#include "runtime/bytecode/trap.h"
#include "runtime/bytecode/writer/function_builder.h"

namespace stepwright::codegen {

// Source files in the order in which code first comes from them.
class FileTable {
 public:
  // `file_names`: how the container calls each file of `sources`. Both must outlive the table.
  FileTable(const source::SourceSet& sources, const std::vector<std::string>& file_names)
      : sources_(sources), file_names_(file_names) {}

  // In a drawing the name goes on with the element: "plc.xml (POU 'main', network 2, coil 'lamp')".
  std::uint32_t index_of(source::Position where);
  const source::SourceSet& sources() const { return sources_; }
  const std::vector<std::string>& names() const { return names_; }

 private:
  const source::SourceSet& sources_;
  const std::vector<std::string>& file_names_;
  std::vector<std::string> names_;
  std::map<std::string, std::uint32_t> index_;
  std::optional<source::FileId> plain_file_;  // the last one without an element, and its index
  std::uint32_t plain_index_ = 0;
};

// Layout of the program, shared by all its functions.
struct ProgramLayout {
  const semantics::Model* model = nullptr;
  std::array<std::uint32_t, 4> bases{};  // absolute address of %I, %Q, %M, Data
  std::unordered_map<const semantics::Pou*, std::uint32_t> functions;
  LiteralPool* literals = nullptr;
  ContainerLimits* limits = nullptr;

  // Of a place in an area.
  std::uint32_t address(const semantics::Place& place) const {
    return bases[static_cast<std::size_t>(place.base)] + model->offset_in_area(place.offset, place.base);
  }
};

enum class Width : std::uint8_t { Exact, Any };

class ExpressionEmitter {
 public:
  ExpressionEmitter(const ProgramLayout& layout, FileTable& files, writer::FunctionBuilder& builder)
      : layout_(layout), files_(files), b_(builder) {}

  // Marks the source position of the following instructions.
  void line(source::Position where);

  // Before an instruction that calls the POU. A trap of the library names its call, so that this is marked to
  // the column; for others the line does.
  void call_site(source::Position where, const semantics::Pou& callee);

  // The temporaries and locals of the statement before are free again.
  void begin_statement();
  // A local of the machine beside those of the POU, with any value in it: of the statement; or until it is
  // released, across the statements within one.
  writer::LocalId local(bytecode::StackType type);
  writer::LocalId held_local(bytecode::StackType type);
  void release(writer::LocalId local, bytecode::StackType type);
  void value(const semantics::Value& value, Width width = Width::Exact);
  void constant(const semantics::Constant& constant, const semantics::Type& type);
  void load(const semantics::Place& place);
  // place := value; also aggregates.
  void assign(const semantics::Place& place, const semantics::Value& value);
  // The address of a place as a Ref.
  void reference(const semantics::Place& place);
  // A copy of the bytes: what the target holds does not matter.
  void copy_bytes(const semantics::Place& target, const semantics::Value& value);
  // Stores the value that `emit` pushes.
  template <typename Emit>
  void store(const semantics::Place& place, Emit emit);
  void copies_before(const std::vector<semantics::CopyBefore>& copies);
  void copies_after(const std::vector<semantics::CopyAfter>& copies);

  // One binary operation on operands of a type that lie on the stack; no wrap.
  void operation(syntax::Operator op, const semantics::Type& operands);
  // Cuts an I32 to the type, if it is narrower.
  void wrap(const semantics::Type& type);
  // Traps unless the value on the stack lies in the range of the subrange type.
  void check_range(const semantics::Type& type);

  std::uint32_t address(const semantics::Place& place) const { return layout_.address(place); }
  std::uint32_t function_of(const semantics::Pou& pou) const { return layout_.functions.at(&pou); }
  bool in_area(const semantics::Place& place) const { return place.base <= semantics::Base::Data; }
  // The whole of a local slot.
  static bool is_slot(const semantics::Place& place) {
    return place.base == semantics::Base::Slot && place.steps.empty();
  }

 private:
  // place_emitter.cpp
  void base_reference(const semantics::Place& place, std::size_t& step);
  void walk(const semantics::PlaceStep& step);
  void open_index(const semantics::PlaceStep& step);
  void load_bit(const semantics::Place& place);
  void load_part(const semantics::Place& place);
  template <typename Push>
  void store_bit(const semantics::Place& place, Push push);
  template <typename Push>
  void store_part(const semantics::Place& place, Push push);
  void merge_bit(std::uint8_t bit);
  void merge_part(const semantics::Place& place);

  // Before an instruction that may trap: an expression may go over several lines.
  void locate(source::Position where);
  void call(const semantics::Value& value);
  void enabled(const semantics::Value& value);
  void check(const semantics::Value& value);
  void check_udint(const semantics::IntegerRange& range);
  void short_circuit(const semantics::Value& value);
  void unary(const semantics::Value& value, Width width);
  void binary(const semantics::Value& value, Width width);
  void bool_order(const semantics::Value& value);
  void convert(const semantics::Type& from, const semantics::Type& to);
  void transfer_bits(const semantics::Type& from, const semantics::Type& to);
  void narrow_character();
  void to_integer(const semantics::Type& from, const semantics::Type& to);
  void to_real(const semantics::Type& from, const semantics::Type& to);
  void time_conversion(const semantics::Type& from, const semantics::Type& to);
  // standard_emitter.cpp
  void standard(const semantics::Value& value);
  void extremum(const semantics::Value& value);
  void chain(const semantics::Value& value);
  void swap_bytes(const semantics::Type& type);
  void swap_groups(unsigned bits, bool wide);
  void from_bcd(const semantics::Type& from, const semantics::Type& to);
  void to_bcd(const semantics::Type& from, const semantics::Type& to);
  void is_valid_bcd();
  void time_of_day();
  void widen(const semantics::Type& type);
  void trap_unless(bytecode::TrapCode code);

  // text_emitter.cpp
  std::uint32_t temporary(std::uint32_t bytes);
  void literal(const std::u16string& text, const semantics::Type& type);
  void text(const semantics::Value& value);
  void text_behind_target(const semantics::Value& value, std::uint32_t at);
  void assign_text(const semantics::Place& place, const semantics::Value& value);
  void narrow_number(const semantics::Value& value);
  void compare_texts(syntax::Operator op, const semantics::Type& type);
  void extreme_text(const semantics::Value& value, bool maximum);
  void load_character(const semantics::Place& place);
  static bytecode::StringOpId set_character(const semantics::Type& type);

  void shift(const semantics::Value& value);
  void select(const semantics::Value& value);
  void multiplex(const semantics::Value& value);

  struct Temporary {
    std::uint32_t offset = 0;
    std::uint32_t bytes = 0;
    bool in_use = false;
  };

  const ProgramLayout& layout_;
  FileTable& files_;
  source::Position here_;  // what was marked last
  writer::FunctionBuilder& b_;
  std::vector<Temporary> temporaries_;
  std::array<std::vector<writer::LocalId>, bytecode::kStackTypeCount> free_locals_;
  std::vector<std::pair<writer::LocalId, bytecode::StackType>> statement_locals_;
};

template <typename Emit>
void ExpressionEmitter::store(const semantics::Place& place, Emit emit) {
  using bytecode::AddressMode;
  if (place.bit != bytecode::kNoBit) return store_bit(place, [&] { emit(Width::Exact); });
  if (place.whole != nullptr) return store_part(place, [&] { emit(Width::Exact); });
  if (place.character) {
    reference(place);
    value(*place.character);
    emit(Width::Exact);
    return b_.string_op(set_character(*place.type));
  }
  if (is_slot(place)) {
    emit(Width::Exact);
    b_.local_set(writer::LocalId(place.slot));
    return;
  }
  const bytecode::MemType type = semantics::mem_type(*place.type);
  if (place.is_direct() && place.base != semantics::Base::Frame) {
    emit(Width::Any);
    if (in_area(place)) {
      b_.store(type, AddressMode::Abs, address(place));
    } else {
      b_.store(type, AddressMode::This, place.offset);
    }
    return;
  }
  reference(place);
  emit(Width::Any);
  b_.store(type, AddressMode::Ind);
}

// A bit that has no instruction of its own is put into its byte.
template <typename Push>
void ExpressionEmitter::store_bit(const semantics::Place& place, Push push) {
  if (place.is_direct() && in_area(place)) {
    push();
    b_.store_bit(address(place), place.bit);
    return;
  }
  const writer::LocalId at = local(bytecode::StackType::Ref);
  reference(place);
  b_.local_set(at);
  push();
  const writer::LocalId bit = local(bytecode::StackType::Bool);
  b_.local_set(bit);
  b_.local_get(at);
  b_.local_get(at);
  b_.load(bytecode::MemType::U8, bytecode::AddressMode::Ind);
  b_.local_get(bit);
  merge_bit(place.bit);
  b_.store(bytecode::MemType::U8, bytecode::AddressMode::Ind);
}

template <typename Push>
void ExpressionEmitter::store_part(const semantics::Place& place, Push push) {
  push();
  merge_part(place);
  b_.local_set(writer::LocalId(place.slot));
}

}  // namespace stepwright::codegen
