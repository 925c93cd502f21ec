#pragma once

// The charts of a program through an online change: which steps of the old one are steps of the new one, what
// would be lost, and how step times go on.
//
// Threads: made by the service thread; `lost_step` and `apply` belong to the scan thread: no heap, no lock.
//
//   const ChartCarry charts(from, to, {from_layout, to_layout}, mode);
//   if (charts.lost_step(image)) ...           // refused
//   charts.apply(old_image, new_image);        // behind the transfer of the variables

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/bytecode/program.h"
#include "runtime/host/messages.h"
#include "runtime/record/state_layout.h"

namespace stepwright::host {

class ChartCarry {
 public:
  struct Layouts {
    const record::StateLayout& from;
    const record::StateLayout& to;
  };

  ChartCarry() = default;  // no chart
  ChartCarry(const bytecode::Program& from, const bytecode::Program& to, const Layouts& layouts,
             DownloadMode mode);

  // A step that is active in this image of the old program and has no counterpart; none: it is safe.
  std::optional<std::uint32_t> lost_step(std::span<const std::byte> image) const;
  const std::string& lost_step_name(std::uint32_t step) const { return lost_[step].name; }
  void apply(std::span<const std::byte> from, std::span<std::byte> to) const;

 private:
  struct Place {
    std::uint32_t address = 0;
    std::uint8_t bit = bytecode::kNoBit;
  };
  struct Pair {
    Place from;
    Place to;
  };
  struct Lost {
    Place place;
    std::string name;  // "main.filler.Drain"
  };
  // A TIME that takes the value of another one of the new image.
  struct Entry {
    std::uint32_t now = 0;
    std::uint32_t since = 0;
  };
  struct Range {
    std::uint32_t address = 0;
    std::uint32_t size = 0;
  };

  void pair(const bytecode::ContainerView& from, const bytecode::ContainerView& to);
  void start_times(const bytecode::ContainerView& to, const Layouts& layouts);

  std::vector<Pair> pairs_;
  std::vector<Lost> lost_;
  std::vector<Entry> entries_;
  std::vector<Range> restarted_;  // of the new image: to their initial values
  std::span<const std::byte> initial_;
};

}  // namespace stepwright::host
