#pragma once

// The data types of a compilation (IEC 61131-3, 6.4). Types are made once by a TypeTable and compared by
// address; they live as long as their table.
//
// Values lie packed in the image, without padding; a BOOL takes one byte, TIME is 64 bits of nanoseconds, an
// enumeration is an INT.

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "ladder/source/name_table.h"
#include "runtime/bytecode/value_type.h"

namespace stepwright::semantics {

using bytecode::ElementaryType;

struct Pou;
struct Type;

enum class TypeKind : std::uint8_t {
  Elementary,
  AnyInteger,  // of an integer literal until its context gives it a type
  AnyReal,     // of a real literal
  Array,
  Struct,
  Enumeration,
  Instance,  // of a function block or a program
};

struct Dimension {
  std::int32_t lower = 0;
  std::int32_t upper = 0;

  std::uint32_t count() const { return static_cast<std::uint32_t>(std::int64_t{upper} - lower + 1); }
};

struct Field {
  source::NameId name;
  std::string spelling;
  const Type* type = nullptr;
  std::uint32_t offset = 0;
};

struct Enumerator {
  source::NameId name;
  std::string spelling;
  std::int16_t value = 0;
};

struct Type {
  TypeKind kind = TypeKind::Elementary;
  std::string name;
  ElementaryType elementary = ElementaryType::Bool;  // Elementary; Int for an Enumeration
  std::uint32_t size = 1;                            // bytes in the image
  const Type* element = nullptr;                     // Array
  std::vector<Dimension> dimensions;                 // Array
  std::vector<Field> fields;                         // Struct
  std::vector<Enumerator> enumerators;               // Enumeration
  const Pou* pou = nullptr;                          // Instance
  std::vector<std::byte> initial;  // `size` bytes: what a variable starts with; empty = zero

  bool is(ElementaryType type) const { return kind == TypeKind::Elementary && elementary == type; }
  // One value in a slot: not an array, structure or instance.
  bool is_scalar() const;
  bool is_integer() const;   // SINT..ULINT or an integer literal
  bool is_unsigned() const;  // USINT..ULINT, BYTE..LWORD
  bool is_real() const;      // REAL, LREAL or a real literal
  bool is_number() const { return is_integer() || is_real(); }
  bool is_bool() const { return is(ElementaryType::Bool); }
  bool is_bits() const;  // BYTE..LWORD
  bool is_time() const { return is(ElementaryType::Time); }
  bool is_literal() const { return kind == TypeKind::AnyInteger || kind == TypeKind::AnyReal; }
  unsigned bit_count() const { return is_bool() ? 1 : size * 8; }
};

class TypeTable {
 public:
  TypeTable();

  const Type* elementary(ElementaryType type) const { return elementary_[static_cast<std::size_t>(type)]; }
  const Type* boolean() const { return elementary(ElementaryType::Bool); }
  const Type* any_integer() const { return any_integer_; }
  const Type* any_real() const { return any_real_; }
  // The type with these elements; equal arrays are one type.
  const Type* array(const Type* element, std::vector<Dimension> dimensions);
  // A type of its own, to be filled in before it is used.
  Type* create(TypeKind kind, std::string name);

 private:
  std::vector<std::unique_ptr<Type>> types_;
  std::vector<const Type*> elementary_;
  std::unordered_map<std::string, const Type*> arrays_;
  const Type* any_integer_ = nullptr;
  const Type* any_real_ = nullptr;
};

// The type that an elementary type's name means (LTIME is TIME); false if it names none. Upper case.
bool elementary_from(const std::string& folded, ElementaryType& out);

// Every value of `from` is a value of `to`, so that no one needs to write the conversion (figure 12).
bool widens(const Type& from, const Type& to);

// Integer range of an integer or bit string type.
struct IntegerRange {
  __int128 low = 0;
  __int128 high = 0;
};
IntegerRange range_of(ElementaryType type);

}  // namespace stepwright::semantics
