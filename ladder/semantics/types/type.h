#pragma once

// The data types of a compilation (IEC 61131-3, 6.4). Types are made once by a TypeTable and compared by
// address; they live as long as their table.
//
// Values lie packed in the image, without padding; a BOOL takes one byte, durations and dates are 64 bits of
// nanoseconds, an enumeration or a subrange is as large as its base, a reference takes 4 bytes, a string is a
// header and its characters.

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ladder/source/name_table.h"
#include "runtime/bytecode/container_format.h"
#include "runtime/bytecode/value_type.h"

namespace stepwright::semantics {

using bytecode::ElementaryType;

struct Pou;
struct Type;

enum class TypeKind : std::uint8_t {
  Elementary,
  AnyInteger,     // of an integer literal until its context gives it a type
  AnyReal,        // of a real literal
  AnyEnumerator,  // of a name that several enumerations have; the constant is the NameId
  Null,           // of the literal NULL
  Nothing,        // of a call of a function without a result
  Array,
  Struct,
  Enumeration,
  Subrange,   // an integer that stays within bounds
  Reference,  // REF_TO
  String,     // STRING[n], WSTRING[n]
  Instance,   // of a function block or a program
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
  std::uint8_t bit = bytecode::kNoBit;  // a BOOL that is a bit of its byte
};

struct Enumerator {
  source::NameId name;
  std::string spelling;
  std::int64_t value = 0;
};

// Integer range of an integer or bit string type.
struct IntegerRange {
  __int128 low = 0;
  __int128 high = 0;
};

struct Type {
  TypeKind kind = TypeKind::Elementary;
  std::string name;
  // Elementary; of an Enumeration and a Subrange that of `base`; String or Wstring of a String.
  ElementaryType elementary = ElementaryType::Bool;
  std::uint32_t size = 1;               // bytes in the image
  const Type* base = nullptr;           // Enumeration, Subrange: what it is stored as
  const Type* element = nullptr;        // Array; Reference: what it leads to
  std::vector<Dimension> dimensions;    // Array
  bool open = false;                    // Array: ARRAY[*], only the number of dimensions counts
  IntegerRange range;                   // Subrange
  std::uint32_t capacity = 0;           // String: characters
  std::vector<Field> fields;            // Struct
  std::vector<Enumerator> enumerators;  // Enumeration
  const Pou* pou = nullptr;             // Instance
  std::uint32_t nesting = 0;            // levels of arrays, structures and instances in it
  std::vector<std::byte> initial;       // `size` bytes: what a variable starts with; empty = zero

  // Null if there is none of that name.
  const Field* find_field(source::NameId id) const { return find_in(fields, id); }
  const Enumerator* find_enumerator(source::NameId id) const { return find_in(enumerators, id); }
  // False, with nothing done, if there is a member of that name.
  bool add(Field field) { return add_to(fields, std::move(field)); }
  bool add(Enumerator enumerator) { return add_to(enumerators, std::move(enumerator)); }

  bool is(ElementaryType type) const { return kind == TypeKind::Elementary && elementary == type; }
  // One value in a slot: not an array, structure, string or instance.
  bool is_scalar() const;
  bool is_integer() const;   // SINT..ULINT, a subrange of them, or an integer literal
  bool is_unsigned() const;  // USINT..ULINT, BYTE..LWORD
  bool is_real() const;      // REAL, LREAL or a real literal
  bool is_number() const { return is_integer() || is_real(); }
  bool is_bool() const { return is(ElementaryType::Bool); }
  bool is_bits() const;  // BYTE..LWORD
  bool is_time() const { return is(ElementaryType::Time); }
  bool is_date() const;  // DATE, TOD, DT
  bool is_reference() const { return kind == TypeKind::Reference; }
  bool is_string() const { return kind == TypeKind::String; }
  // Takes its type from where it stands.
  bool is_literal() const { return kind == TypeKind::AnyInteger || kind == TypeKind::AnyReal; }
  unsigned bit_count() const { return is_bool() ? 1 : size * 8; }

 private:
  template <typename Part>
  const Part* find_in(const std::vector<Part>& parts, source::NameId id) const {
    const auto found = part_index_.find(id.value);
    return found == part_index_.end() ? nullptr : &parts[found->second];
  }
  template <typename Part>
  bool add_to(std::vector<Part>& parts, Part part) {
    if (!part_index_.try_emplace(part.name.value, static_cast<std::uint32_t>(parts.size())).second)
      return false;
    parts.push_back(std::move(part));
    return true;
  }

  std::unordered_map<std::uint32_t, std::uint32_t> part_index_;  // NameId -> index of field or enumerator
};

class TypeTable {
 public:
  TypeTable();

  // Of a scalar: STRING and WSTRING have a capacity, see string().
  const Type* elementary(ElementaryType type) const { return elementary_[static_cast<std::size_t>(type)]; }
  const Type* boolean() const { return elementary(ElementaryType::Bool); }
  const Type* any_integer() const { return any_integer_; }
  const Type* any_real() const { return any_real_; }
  const Type* null() const { return null_; }
  const Type* nothing() const { return nothing_; }
  const Type* any_enumerator() const { return any_enumerator_; }
  // The types of these shapes; equal shapes are one type.
  const Type* array(const Type* element, std::vector<Dimension> dimensions);
  const Type* open_array(const Type* element, std::size_t dimensions);
  // Requires an integer type and a range within it that holds a value.
  const Type* subrange(const Type* base, IntegerRange range);
  // The target may be incomplete.
  const Type* reference(const Type* target);
  // Requires String or Wstring and at most bytecode::kMaxStringCapacity characters.
  const Type* string(ElementaryType which, std::uint32_t capacity);
  // A type of its own, to be filled in before it is used.
  Type* create(TypeKind kind, std::string name);

 private:
  std::vector<std::unique_ptr<Type>> types_;
  std::vector<const Type*> elementary_;
  std::unordered_map<std::string, const Type*> shapes_;  // arrays, subranges and strings, by name
  std::unordered_map<const Type*, const Type*> references_;
  const Type* any_integer_ = nullptr;
  const Type* any_real_ = nullptr;
  const Type* any_enumerator_ = nullptr;
  const Type* null_ = nullptr;
  const Type* nothing_ = nullptr;
};

// Characters of a STRING or WSTRING that is declared without a length.
inline constexpr std::uint32_t kDefaultStringCapacity = 80;

// How a value of the type, or the address of one that has no slot, is loaded and stored.
bytecode::MemType mem_type(const Type& type);
// The slot that holds a scalar of this type.
bytecode::StackType slot_type(const Type& type);

// The type that an elementary type's name means (LTIME is TIME, DATE_AND_TIME and LDT are DT); false if it
// names none. Upper case. STRING and WSTRING without a length are not among them.
bool elementary_from(const std::string& folded, ElementaryType& out);

// Every value of `from` is a value of `to`, so that no one needs to write the conversion (figure 12).
bool widens(const Type& from, const Type& to);

IntegerRange range_of(ElementaryType type);

}  // namespace stepwright::semantics
