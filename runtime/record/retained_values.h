#pragma once

// Retained values of one program, with all the memory that keeping them takes.
//
// Threads: made on any; `buffer` goes from the scan thread to the one that writes the store, `kept` belongs
// to the scan thread, the rest is immutable once the program is handed over.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/record/retain_area.h"
#include "runtime/record/state_layout.h"
#include "runtime/record/triple_buffer.h"
#include "runtime/record/variable_transfer.h"

namespace stepwright::record {

class RetainedValues {
 public:
  // Fails as StateLayout::of does, but not for a program that retains nothing.
  [[nodiscard]] static result::Result<RetainedValues> of(const bytecode::Program& program) {
    RetainedValues values;
    values.area_ = RetainArea::of(program);
    if (values.area_.size() == 0) return values;
    auto layout = StateLayout::of(program);
    if (!layout) return result::forward(layout);
    values.in_image_ = values.area_.in_image(*layout);
    values.in_payload_ = values.area_.in_payload(*layout);
    values.back_ = VariableTransfer::between(values.in_payload_, values.in_image_);
    return values;
  }

  std::uint32_t size() const { return area_.size(); }
  const RetainArea& area() const { return area_; }
  const StateLayout& in_image() const { return in_image_; }
  const StateLayout& in_payload() const { return in_payload_; }
  // From a payload of this program into its image.
  const VariableTransfer& back() const { return back_; }

 private:
  RetainArea area_;
  StateLayout in_image_;
  StateLayout in_payload_;
  VariableTransfer back_;
};

// How the values of one source, a store or another program, come into the image of this one.
struct RetainArrival {
  std::uint64_t source = 0;
  VariableTransfer transfer;
  std::string misfit;   // what does not fit; empty: nothing
  std::string refusal;  // the same, where the policy asks for it
};

// The same with its buffers, which have one place in memory.
struct RetainChannel : std::enable_shared_from_this<RetainChannel> {
  explicit RetainChannel(RetainedValues of)
      : values(std::move(of)), kept(values.size()), buffer(values.size()) {}

  const RetainArrival* arrival_from(std::uint64_t from) const {
    for (const RetainArrival& each : arrivals)
      if (each.source == from) return &each;
    return nullptr;
  }

  const RetainedValues values;
  std::uint64_t source = 0;             // as which others name it
  std::vector<RetainArrival> arrivals;  // from all that can be kept when it starts
  std::vector<std::byte> kept;          // as they were when the program was last stopped
  TripleBuffer buffer;
};

}  // namespace stepwright::record
