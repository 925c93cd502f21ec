#pragma once

// Check whether the steps that are active when a program changes can be active together in the new chart: two
// tokens of simultaneous branches must not land in a chart where the branches are alternatives.
//
// The situations of a chart are those that its transitions can lead to from its initial steps (the
// reachability graph of IEC 61131-3, 6.7.5: each transition takes its sources and gives its targets). A chart
// with more than kMaxSteps steps or kMaxSituations situations is not judged.
//
// Threads: made by the service thread; `impossible` belongs to the scan thread: no heap, no lock.
//
//   const ChartSituations situations(from, to);
//   if (auto chart = situations.impossible(old_image)) ...    // refused

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/bytecode/program.h"

namespace stepwright::host {

class ChartSituations {
 public:
  static constexpr std::uint32_t kMaxSteps = 256;
  static constexpr std::size_t kMaxSituations = 4'096;

  ChartSituations() = default;  // no chart
  ChartSituations(const bytecode::Program& from, const bytecode::Program& to);

  // A chart of the new program in which the active steps of this image of the old one are no situation; none
  // if all is well. Steps without a counterpart and charts without an active step do not count here.
  std::optional<std::uint32_t> impossible(std::span<const std::byte> image) const;
  const std::string& chart_name(std::uint32_t chart) const { return charts_[chart].name; }

 private:
  // Which steps of the new chart are active, as words, so that they can be sorted.
  using Situation = std::array<std::uint64_t, kMaxSteps / 64>;
  struct Place {
    std::uint32_t address = bytecode::kNoIndex;  // kNoIndex: the old program has no such step
    std::uint8_t bit = bytecode::kNoBit;
  };
  struct Chart {
    std::string name;
    std::vector<Place> places;  // in the old image, per step of the new chart
    std::vector<Situation> situations;
  };

  static std::vector<Situation> reachable(const bytecode::ContainerView& view,
                                          const bytecode::SfcChartRecord& chart);

  std::vector<Chart> charts_;
};

}  // namespace stepwright::host
