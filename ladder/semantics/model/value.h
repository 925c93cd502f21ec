#pragma once

// Expressions after analysis: every name resolved to a place, every type known, every conversion explicit,
// constants folded. What codegen reads; it reports nothing any more.

#include <memory>
#include <vector>

#include "ladder/semantics/types/constant.h"
#include "ladder/semantics/types/type.h"
#include "runtime/bytecode/container_format.h"
#include "runtime/bytecode/opcode.h"

namespace stepwright::semantics {

struct Value;
using ValuePtr = std::unique_ptr<Value>;

// Where a variable's memory begins. Addresses of areas are absolute once the areas have their sizes.
enum class Base : std::uint8_t {
  Input,  // `offset` in the input area; so for the next three
  Output,
  Marker,
  Data,
  This,     // `offset` in the running instance
  Frame,    // `offset` in the frame of the running function
  Slot,     // local slot `slot` of the running function: a scalar without an address
  ThisRef,  // the reference stored at `offset` in the running instance (VAR_IN_OUT)
  SlotRef,  // the reference held by local slot `slot`
};

// One index of a variable-length array.
struct OpenIndex {
  ValuePtr index;
  ValuePtr lower;
  ValuePtr upper;
};

// One step from a place to a part of it, or along the reference that it holds.
struct PlaceStep {
  bool follow = false;          // the place holds a reference: go where it leads
  std::vector<OpenIndex> open;  // all indexes of a variable-length array; `stride` is that of an element
  ValuePtr index;               // null: only `offset` is added
  std::int32_t lower = 0;       // bounds of the index, checked at run time
  std::int32_t upper = 0;
  std::uint32_t stride = 0;
  std::uint32_t offset = 0;  // added behind the index
};

struct Variable;

// A variable or a part of one.
struct Place {
  Base base = Base::This;
  std::uint32_t offset = 0;
  std::uint32_t slot = 0;
  // A BOOL that is a bit of the byte that the rest of the place leads to.
  std::uint8_t bit = bytecode::kNoBit;
  const Type* type = nullptr;
  // Slot: the place is the bits from `shift` on of a slot that holds a `whole`; null: the whole slot.
  const Type* whole = nullptr;
  std::uint8_t shift = 0;
  const Variable* open = nullptr;  // of a variable-length array: the parameter, which knows the bounds
  std::vector<PlaceStep> steps;
  // A CHAR or WCHAR: the rest of the place leads to the string, this is the position in it, DINT from 1.
  ValuePtr character;

  Place();
  ~Place();
  Place(Place&&) noexcept;
  Place& operator=(Place&&) noexcept;

  // Has neither an index nor a reference on its way: the address is known when the program is loaded.
  bool is_direct() const { return steps.empty() && base != Base::ThisRef && base != Base::SlotRef; }
  // Can be given away as a reference.
  bool is_addressable() const {
    return (base != Base::Slot || !steps.empty()) && bit == bytecode::kNoBit && character == nullptr;
  }
};

enum class ValueKind : std::uint8_t {
  Constant,
  Load,       // `place`
  Reference,  // the address of `place`
  Unary,      // Negate, Not
  Binary,     // chain of `op` over operands of type operands[0]->type
  Convert,    // operands[0] to `type`, exactly if it widens, else as the standard's X_TO_Y
  Check,      // operands[0], which must lie in the subrange `type`
  Truncate,   // operands[0], a real, to the integer `type`, towards zero
  Standard,   // `function` of operands of one type
  Shift,      // `function` of operands[0], operands[1] (DINT)
  Select,     // operands[0] ? operands[2] : operands[1], all evaluated
  Multiplex,  // operands[0] (DINT) chooses among the rest, all evaluated
  Chain,      // operands[0] `op` operands[1] AND operands[1] `op` operands[2] ..., each evaluated once
  Fail,       // stops the program: bad argument
  Stop,       // stops the program, because it says so
  Call,       // user function `pou`; operands in the order of its slots; a result in memory is at `place`
  Enabled,    // operands[0] ? operands[1] : the first value of the type; `after` passes ENO on, in `place`
  Now,        // time since the start, TIME
  Text,       // `text_op` on strings; a string as result is one of the capacity of `type`
};

enum class StandardFunction : std::uint8_t {
  Abs,
  Sqrt,
  Ln,
  Log,
  Exp,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Atan2,
  Power,
  Min,
  Max,
  Shl,
  Shr,
  Rol,
  Ror,
  SwapBytes,
  FromBcd,  // bit string -> integer
  ToBcd,
  IsValid,     // of a real: a finite number
  IsValidBcd,  // every digit is one
  DayOf,       // of a date and time: its beginning
  TimeOfDay,   // of nanoseconds: those since midnight
};

struct Value {
  ValueKind kind = ValueKind::Constant;
  const Type* type = nullptr;
  source::Position where;
  syntax::Operator op = syntax::Operator::Add;
  StandardFunction function = StandardFunction::Abs;
  // Of the width of the strings. Concat takes two or more; SetCharAt makes a text of the one character that
  // is its operand; To... gives a value of `type`, which may be narrower than what the machine reads.
  bytecode::StringOpId text_op = bytecode::StringOpId::CopyS;
  // Truncate: of TRUNC, whose integer type is that of the place where it stands; DINT if that says nothing.
  // Of a power of an integer, LREAL: where a REAL stands it is one.
  bool adapts = false;
  // Convert: operands[0] is a part of the same function: the quotient of DIV_TIME, the integer of
  // REAL_TO_WORD.
  bool converts_part = false;
  Constant constant;
  Place place;
  const Pou* pou = nullptr;
  std::vector<ValuePtr> operands;
  // Call, Enabled: what the caller copies around it.
  std::vector<struct CopyBefore> before;
  std::vector<struct CopyAfter> after;

  Value();
  ~Value();
  Value(Value&&) noexcept;
  Value& operator=(Value&&) noexcept;
};

// Before a call: `target := value`.
struct CopyBefore {
  Place target;
  ValuePtr value;
};

// After a call: `target := value`, where value reads what the call left.
struct CopyAfter {
  Place target;
  ValuePtr value;
};

inline Place::Place() = default;
inline Place::~Place() = default;
inline Place::Place(Place&&) noexcept = default;
inline Place& Place::operator=(Place&&) noexcept = default;
inline Value::Value() = default;
inline Value::~Value() = default;
inline Value::Value(Value&&) noexcept = default;
inline Value& Value::operator=(Value&&) noexcept = default;

}  // namespace stepwright::semantics
