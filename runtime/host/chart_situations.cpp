#include "runtime/host/chart_situations.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/image/process_image.h"

namespace stepwright::host {
namespace {

using bytecode::Section;

constexpr std::uint32_t kWordBits = 64;

template <typename Words>
void set(Words& words, std::uint32_t step) {
  words[step / kWordBits] |= std::uint64_t{1} << step % kWordBits;
}

}  // namespace

ChartSituations::ChartSituations(const bytecode::Program& from, const bytecode::Program& to) {
  const bytecode::ContainerView& old = from.container();
  const bytecode::ContainerView& view = to.container();
  std::map<std::string, bytecode::SfcChartRecord> known;
  for (std::uint32_t c = 0; c < old.count<Section::SfcCharts>(); ++c) {
    const auto chart = old.record<Section::SfcCharts>(c);
    known.emplace(naming::upper(reader::text_of(old, chart.name)), chart);
  }
  for (std::uint32_t c = 0; c < view.count<Section::SfcCharts>(); ++c) {
    const auto record = view.record<Section::SfcCharts>(c);
    const std::string name = reader::text_of(view, record.name);
    const auto before = known.find(naming::upper(name));
    if (before == known.end() || record.step_count > kMaxSteps) continue;
    Chart chart{name, {}, reachable(view, record)};
    if (chart.situations.empty()) continue;  // too many
    std::map<std::string, Place> places;
    for (std::uint32_t i = 0; i < before->second.step_count; ++i) {
      const auto step = old.record<Section::SfcSteps>(before->second.first_step + i);
      places.emplace(naming::upper(reader::text_of(old, step.name)), Place{step.address, step.bit});
    }
    for (std::uint32_t i = 0; i < record.step_count; ++i) {
      const auto step = view.record<Section::SfcSteps>(record.first_step + i);
      chart.places.push_back(places[naming::upper(reader::text_of(view, step.name))]);
    }
    charts_.push_back(std::move(chart));
  }
}

// Sorted; empty if there are too many.
std::vector<ChartSituations::Situation> ChartSituations::reachable(const bytecode::ContainerView& view,
                                                                   const bytecode::SfcChartRecord& chart) {
  struct Transition {
    Situation sources{};
    Situation targets{};
  };
  std::vector<Transition> transitions(chart.transition_count);
  for (std::uint32_t t = 0; t < chart.transition_count; ++t) {
    const auto record = view.record<Section::SfcTransitions>(chart.first_transition + t);
    for (std::uint32_t i = 0; i < record.source_count; ++i)
      set(transitions[t].sources, view.record<Section::SfcLinks>(record.first_source + i));
    for (std::uint32_t i = 0; i < record.target_count; ++i)
      set(transitions[t].targets, view.record<Section::SfcLinks>(record.first_target + i));
  }
  Situation initial{};
  for (std::uint32_t i = 0; i < chart.step_count; ++i) {
    const auto step = view.record<Section::SfcSteps>(chart.first_step + i);
    if ((step.flags & bytecode::kStepInitial) != 0) set(initial, i);
  }
  std::set<Situation> seen{initial};
  std::vector<Situation> open{initial};
  while (!open.empty()) {
    const Situation now = open.back();
    open.pop_back();
    for (const Transition& transition : transitions) {
      Situation next = now;
      bool enabled = true;
      for (std::size_t w = 0; w < now.size(); ++w) {
        enabled = enabled && (now[w] & transition.sources[w]) == transition.sources[w];
        next[w] = (now[w] & ~transition.sources[w]) | transition.targets[w];
      }
      if (!enabled || !seen.insert(next).second) continue;
      if (seen.size() > kMaxSituations) return {};
      open.push_back(next);
    }
  }
  return {seen.begin(), seen.end()};
}

std::optional<std::uint32_t> ChartSituations::impossible(std::span<const std::byte> image) const {
  for (std::uint32_t c = 0; c < charts_.size(); ++c) {
    const Chart& chart = charts_[c];
    Situation now{};
    bool any = false;
    for (std::uint32_t i = 0; i < chart.places.size(); ++i) {
      const Place& place = chart.places[i];
      if (place.address == bytecode::kNoIndex) continue;
      const bool active = place.bit == bytecode::kNoBit ? image[place.address] != std::byte{0}
                                                        : image::get_bit(image, place.address, place.bit);
      if (active) set(now, i);
      any = any || active;
    }
    // Before its first scan a chart has no active step yet.
    if (any && !std::binary_search(chart.situations.begin(), chart.situations.end(), now)) return c;
  }
  return std::nullopt;
}

}  // namespace stepwright::host
