#pragma once

// Layout of a program's state, by name: every variable that has a value between two scans, expanded to single
// values, strings and runs of equal values, with its path, its type and its place. Carrying state from one
// program to another, and a store of retained values that outlives its program, need no more than two of
// these.
//
// Threads: immutable; any. Invariants: paths are unique without regard to case (a second variable of a path
// gets "#2" behind it); members that the compiler hides are listed, VAR_IN_OUT and VAR_TEMP, which have no
// value between scans, are not; whatever a variable names lies within the bytes that the layout describes.
//
//   auto layout = StateLayout::of(program);
//   const StateVariable* speed = layout->find("main.drive.speed");
//   std::vector<std::byte> bytes = layout->encoded();            // StateLayout::decode(bytes) is equal

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/bytecode/program.h"
#include "runtime/ground/result/result.h"

namespace stepwright::record {

enum StateFlag : std::uint16_t {
  kStateRetain = 1,        // survives the process
  kStateLocated = 2,       // has an address like %QX0.0
  kStateConstant = 4,      // its value is the program's
  kStateInput = 8,         // lies in the inputs: the I/O driver gives it its value
  kStateStep = 16,         // the activity of a step
  kStateInitialStep = 32,  // of an initial step
  kStateHidden = 64,       // the compiler's: no name of the program
};

// The type of a single value. Of an enumeration the text lists its values, "IDLE=0,RUN=1,"; of a reference it
// is the name of the target's type.
struct StateType {
  bytecode::TypeKind kind = bytecode::TypeKind::Elementary;  // never Array, Struct or Instance
  bytecode::ElementaryType elementary = bytecode::ElementaryType::Bool;
  std::uint32_t size = 1;      // bytes
  std::uint32_t capacity = 0;  // String: characters
  std::int64_t lower = 0;      // Subrange: its bounds
  std::int64_t upper = 0;
  std::string text;

  friend bool operator==(const StateType&, const StateType&) = default;
};

// True if every value of `from` is a value of `to` with the same bytes: equal types, a wider subrange, an
// enumeration that kept its names. Strings of any capacity of one kind; shortening is the copy's business.
bool takes(const StateType& to, const StateType& from);

struct StateVariable {
  std::string path;           // "MAIN.drive.speed", "table[3].name"
  std::uint32_t type = 0;     // into StateLayout::types
  std::uint32_t address = 0;  // of the first value
  std::uint32_t count = 1;    // values that follow each other; more than 1 only if `is_array`
  std::int32_t lower = 0;     // index of the first of them
  bool is_array = false;
  std::uint8_t bit = bytecode::kNoBit;  // of a located BOOL
  std::uint16_t flags = 0;              // StateFlag

  friend bool operator==(const StateVariable&, const StateVariable&) = default;
};

// The areas that the image has in front of the data, in bytes.
struct StateAreas {
  std::uint32_t inputs = 0;
  std::uint32_t outputs = 0;
  std::uint32_t markers = 0;

  friend bool operator==(const StateAreas&, const StateAreas&) = default;
};

class StateLayout {
 public:
  StateLayout() = default;  // of no program: nothing is kept

  // Fails with R0021 if the program has more than kMaxVariables values.
  [[nodiscard]] static result::Result<StateLayout> of(const bytecode::Program& program);

  // Of these variables in a block of `size` bytes, for parts of another layout. Requires what the invariants
  // say of them.
  StateLayout(std::vector<StateType> types, std::vector<StateVariable> variables, std::uint32_t size);

  const std::vector<StateVariable>& variables() const { return variables_; }
  const StateType& type_of(const StateVariable& variable) const { return types_[variable.type]; }
  const std::vector<StateType>& types() const { return types_; }
  const StateAreas& areas() const { return areas_; }
  std::uint32_t size() const { return size_; }  // of the bytes that it describes

  // By path, upper and lower case alike; null if there is none.
  const StateVariable* find(std::string_view path) const;

  // The same for layouts with equal variables at equal places, else almost surely another.
  std::uint64_t digest() const;

  // As bytes, and back. `decode` takes any bytes: R0022 if they are no layout.
  std::vector<std::byte> encoded() const;
  [[nodiscard]] static result::Result<StateLayout> decode(std::span<const std::byte> bytes);

  // Of one program; more would be no program of this runtime, whose images end at 1 MiB.
  static constexpr std::uint32_t kMaxVariables = 1u << 20;

  friend bool operator==(const StateLayout& a, const StateLayout& b) {
    return a.types_ == b.types_ && a.variables_ == b.variables_ && a.areas_ == b.areas_ && a.size_ == b.size_;
  }

 private:
  bool well_formed() const;
  void index();

  std::vector<StateType> types_;
  std::vector<StateVariable> variables_;
  StateAreas areas_;
  std::uint32_t size_ = 0;
  std::unordered_map<std::string, std::uint32_t> by_path_;  // upper case
};

}  // namespace stepwright::record
