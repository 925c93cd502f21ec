#pragma once

// Selects the arrays of a program that viewers are told of. Arrays of function blocks are shown, up to
// kMostArrayValues values of all arrays; other arrays with more than kMostOfATable values are tables that the
// program looks things up in, and would be most of what a viewer is sent.
//
//   const ArraySelection selection(info.tags(), info.instances());
//   selection.shows("Main.pumps[3].speed");
//
// Immutable once made; any thread. Invariant: what it was made of outlives it.

#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "hmi_web/protocol/program.h"
#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::server {

inline constexpr std::size_t kMostOfATable = 256;
inline constexpr std::size_t kMostArrayValues = 8'192;  // of a program, the smallest arrays first

class ArraySelection {
 public:
  ArraySelection(const std::vector<reader::Tag>& tags, const std::vector<reader::InstanceInfo>& instances);

  // True for a tag that is in no array, too.
  bool shows(std::string_view tag) const;
  // What is left out, in the order of the program.
  std::vector<protocol::LeftOutArray> left_out() const;

 private:
  struct Array {
    std::string_view name;
    std::size_t values = 0;
    bool of_blocks = false;
    bool shown = false;
  };
  struct Place {
    std::string_view array;  // empty: in none
    bool of_blocks = false;
  };

  Place place_of(std::string_view tag) const;
  std::size_t end_of_block(std::string_view tag, std::size_t from) const;
  void choose();

  std::unordered_set<std::string_view> blocks_;  // paths of instances
  std::vector<Array> arrays_;
  std::unordered_map<std::string_view, std::size_t> by_name_;  // indices into arrays_
};

}  // namespace stepwright::server
