#include "runtime/host/chart_carry.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/host/chart_memory.h"
#include "runtime/image/process_image.h"

namespace stepwright::host {
namespace {

using bytecode::Section;

constexpr std::size_t kTimeBytes = 8;

bool get(std::span<const std::byte> image, std::uint32_t address, std::uint8_t bit) {
  return bit == bytecode::kNoBit ? image[address] != std::byte{0} : image::get_bit(image, address, bit);
}

void put(std::span<std::byte> image, std::uint32_t address, std::uint8_t bit, bool value) {
  if (bit == bytecode::kNoBit) {
    image[address] = std::byte{value};
  } else {
    image::set_bit(image, address, bit, value);
  }
}

struct NamedStep {
  std::string name;
  bytecode::SfcStepRecord record;
};

std::vector<NamedStep> steps_of(const bytecode::ContainerView& view) {
  std::vector<NamedStep> steps;
  for (std::uint32_t c = 0; c < view.count<Section::SfcCharts>(); ++c) {
    const auto chart = view.record<Section::SfcCharts>(c);
    const std::string path = reader::text_of(view, chart.name);
    for (std::uint32_t i = 0; i < chart.step_count; ++i) {
      const auto step = view.record<Section::SfcSteps>(chart.first_step + i);
      steps.push_back({path + "." + reader::text_of(view, step.name), step});
    }
  }
  return steps;
}

}  // namespace

ChartCarry::ChartCarry(const bytecode::Program& from, const bytecode::Program& to, const Layouts& layouts,
                       DownloadMode mode)
    : initial_(to.container().section(Section::InitialData)) {
  if (mode == DownloadMode::ChangeRestartCharts) {
    const ChartMemory charts = ChartMemory::of(to);
    for (const ChartMemory::Range& range : charts.ranges()) restarted_.push_back({range.address, range.size});
    return;
  }
  pair(from.container(), to.container());
  start_times(to.container(), layouts);
}

// By chart and step, whatever the compiler called their bits.
void ChartCarry::pair(const bytecode::ContainerView& from, const bytecode::ContainerView& to) {
  std::map<std::string, Place> known;
  for (const NamedStep& step : steps_of(to))
    known.emplace(naming::upper(step.name), Place{step.record.address, step.record.bit});
  for (const NamedStep& step : steps_of(from)) {
    const Place place{step.record.address, step.record.bit};
    if (const auto found = known.find(naming::upper(step.name)); found != known.end()) {
      pairs_.push_back({place, found->second});
    } else {
      lost_.push_back({place, step.name});
    }
  }
}

// A step whose time nobody asked for has no time of entry. If the new program asks for it, the time counts
// from the change; from the start of the chart, it would be over at once.
void ChartCarry::start_times(const bytecode::ContainerView& to, const Layouts& layouts) {
  std::map<std::uint64_t, std::string> paths;  // of the step bits
  const auto key = [](std::uint32_t address, std::uint8_t bit) { return std::uint64_t{address} << 8 | bit; };
  for (const record::StateVariable& variable : layouts.to.variables())
    if ((variable.flags & record::kStateStep) != 0)
      paths.emplace(key(variable.address, variable.bit), variable.path);
  for (const NamedStep& step : steps_of(to)) {
    const auto path = paths.find(key(step.record.address, step.record.bit));
    if (path == paths.end() || !path->second.ends_with("_X")) continue;
    const std::string base = path->second.substr(0, path->second.size() - 2);
    const std::string clock = base.substr(0, base.rfind('.') + 1) + "SFC_NOW";
    const record::StateVariable* since = layouts.to.find(base + "_SINCE");
    const record::StateVariable* now = layouts.to.find(clock);
    if (since == nullptr || now == nullptr || layouts.from.find(base + "_SINCE") != nullptr) continue;
    if (layouts.from.find(clock) == nullptr) continue;  // a new clock begins at zero, as the entry does
    if (layouts.to.type_of(*since).size != kTimeBytes || layouts.to.type_of(*now).size != kTimeBytes)
      continue;
    entries_.push_back({now->address, since->address});
  }
}

std::optional<std::uint32_t> ChartCarry::lost_step(std::span<const std::byte> image) const {
  for (std::uint32_t i = 0; i < lost_.size(); ++i)
    if (get(image, lost_[i].place.address, lost_[i].place.bit)) return i;
  return std::nullopt;
}

void ChartCarry::apply(std::span<const std::byte> from, std::span<std::byte> to) const {
  for (const Pair& step : pairs_)
    put(to, step.to.address, step.to.bit, get(from, step.from.address, step.from.bit));
  for (const Entry& entry : entries_) std::memcpy(to.data() + entry.since, to.data() + entry.now, kTimeBytes);
  for (const Range& range : restarted_) {
    const std::size_t known = std::min<std::size_t>(std::max<std::size_t>(initial_.size(), range.address),
                                                    range.address + range.size);
    if (known > range.address)
      std::memcpy(to.data() + range.address, initial_.data() + range.address, known - range.address);
    std::memset(to.data() + known, 0, range.address + range.size - known);
  }
}

}  // namespace stepwright::host
