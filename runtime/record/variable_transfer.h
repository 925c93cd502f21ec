#pragma once

// Carries the values of variables from the image of one program into that of another, by path and type: at an
// online change, and from a store of retained values into the program that finds it. Made on the host side; a
// list of copies is all that the scan thread sees of it.
//
// A variable with the same path (without regard to case) and a type that takes the old one's values keeps its
// value, strings cut to the new capacity, arrays by index where both have the element. Anything else has the
// initial value of the new program. Constants and inputs are never carried. Outputs and markers are memory
// with public addresses: they are copied by address first, then the variables in them by name. A reference
// holds an address: it is carried only between equal layouts. A step that only the new program has begins
// inactive where its chart is carried with an active one, also an initial step: the chart has its token
// already. A chart that loses its last active step begins anew, at its initial steps.
//
// Threads: made on any; `apply` on the one that owns both images: no heap, no lock, no failure, O(bytes).
//
//   const VariableTransfer transfer = VariableTransfer::between(old_layout, new_layout);
//   for (const std::string& name : transfer.report().retyped) ...
//   image.reset(initial_data);
//   transfer.apply(old_image, new_image);

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/record/state_layout.h"

namespace stepwright::record {

// A step and where its activity lies in the image of its program.
struct StepPlace {
  std::string path;
  std::uint32_t address = 0;
  std::uint8_t bit = bytecode::kNoBit;
  bool initial = false;
};

// By path, in the order of their layout.
struct TransferReport {
  std::uint32_t carried = 0;             // variables; an array of single values is one
  std::vector<std::string> initialised;  // new: they have their initial values
  std::vector<std::string> dropped;      // there are no variables of the name any more
  std::vector<std::string> retyped;      // the new type does not take the old one's values: initial values
  std::vector<std::string> shortened;    // of a string or an array only a part may have been carried
  std::vector<std::string> references;   // not carried, as addresses changed
  std::vector<StepPlace> lost_steps;     // of the old program, that the new one lacks
  std::vector<StepPlace> new_steps;      // of the new program, that the old one lacks
};

class VariableTransfer {
 public:
  VariableTransfer() = default;  // carries nothing
  static VariableTransfer between(const StateLayout& from, const StateLayout& to);

  const TransferReport& report() const { return report_; }

  // Requires blocks as large as the two layouts say.
  void apply(std::span<const std::byte> from, std::span<std::byte> to) const;

  // Reads the list of copies, so that `apply` finds it near the processor. The value means nothing.
  std::uint32_t touch() const;

  // The steps of the old program that the new one lacks and that are active in this old image.
  std::vector<StepPlace> lost_active_steps(std::span<const std::byte> from) const;

 private:
  friend class TransferBuilder;
  struct Run {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t size = 0;
  };
  struct Single {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
  };
  struct Bit {  // kNoBit: a byte, 0 or 1
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint8_t from_bit = bytecode::kNoBit;
    std::uint8_t to_bit = bytecode::kNoBit;
  };
  struct Text {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint16_t capacity = 0;  // of the shorter one
    std::uint8_t character_bytes = 1;
  };

  // Steps of one chart that both programs have, with their places in the old image or in the new one.
  struct Chart {
    std::vector<StepPlace> carried;  // old
    std::vector<StepPlace> lost;     // old
    std::vector<StepPlace> fresh;    // new
    std::vector<StepPlace> initial;  // new
  };

  std::vector<Run> areas_;  // before all others
  std::vector<Run> runs_;
  std::array<std::vector<Single>, 4> singles_;  // of 1, 2, 4 and 8 bytes
  std::vector<Bit> bits_;
  std::vector<Text> texts_;
  std::vector<Chart> charts_;
  TransferReport report_;
};

}  // namespace stepwright::record
