#include "runtime/host/change_plan.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <map>
#include <utility>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/result/counted.h"
#include "runtime/host/change_codes.h"
#include "runtime/host/change_problems.h"
#include "runtime/host/chart_memory.h"

namespace stepwright::host {
namespace {

using bytecode::Section;

constexpr std::size_t kNamesInANote = 8;
constexpr const char* kWhere = "download";

std::map<std::string, std::uint32_t> tasks_by_name(const bytecode::ContainerView& view) {
  std::map<std::string, std::uint32_t> tasks;
  for (std::uint32_t i = 0; i < view.count<Section::Tasks>(); ++i)
    tasks.emplace(naming::upper(reader::text_of(view, view.record<Section::Tasks>(i).name)), i);
  return tasks;
}

// For each task of `to` the one of `from` with its name.
std::vector<std::uint32_t> counterparts(const bytecode::ContainerView& from,
                                        const bytecode::ContainerView& to) {
  const auto known = tasks_by_name(from);
  std::vector<std::uint32_t> tasks(to.count<Section::Tasks>(), bytecode::kNoIndex);
  for (const auto& [name, index] : tasks_by_name(to)) {
    if (const auto found = known.find(name); found != known.end()) tasks[index] = found->second;
  }
  return tasks;
}

std::string first_names(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kNamesInANote); ++i)
    text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kNamesInANote) text += ", ...";
  return text;
}

std::optional<ImagePlace> place_of(const AddressMap& map, const image::Force& force) {
  const bool whole = force.bit == image::kWholeBytes;
  return map.find(force.address, force.size, whole ? bytecode::kNoBit : force.bit);
}

// Adds to what `to` has. Returns how many had no place.
std::uint32_t move(const AddressMap& map, const image::ForceTable& from, image::ForceTable& to,
                   std::size_t image_size) {
  std::uint32_t lost = 0;
  for (image::Force force : from.forces()) {
    const auto place = place_of(map, force);
    if (place) {
      force.address = place->address;
      force.bit = place->bit == bytecode::kNoBit ? image::kWholeBytes : place->bit;
    }
    if (!place || !to.set(force, image_size)) ++lost;
  }
  return lost;
}

}  // namespace

ChangePlan::ChangePlan(PreparedProgram& from, PreparedProgram& to, DownloadMode mode)
    : from_(from), to_(to), mode_(mode) {}

result::Result<std::unique_ptr<ChangePlan>> ChangePlan::make(PreparedProgram& from, PreparedProgram& to,
                                                             DownloadMode mode) {
  assert(mode != DownloadMode::Replace);
  std::unique_ptr<ChangePlan> plan(new ChangePlan(from, to, mode));
  if (auto planned = plan->plan(); !planned) return result::forward(planned);
  return plan;
}

result::Result<void> ChangePlan::plan() {
  auto from = record::StateLayout::of(from_.loaded().program());
  if (!from) return result::forward(from);
  auto to = record::StateLayout::of(to_.loaded().program());
  if (!to) return result::forward(to);
  if (auto moved = moved_outputs(*from, *to); !moved.empty()) return tl::unexpected(std::move(moved));
  transfer_ = record::VariableTransfer::between(*from, *to);
  forward_ = AddressMap(*from, *to);
  backward_ = AddressMap(*to, *from);
  charts_ = ChartCarry(from_.loaded().program(), to_.loaded().program(), {*from, *to}, mode_);
  if (mode_ == DownloadMode::Change)
    situations_ = ChartSituations(from_.loaded().program(), to_.loaded().program());
  pair_tasks();
  clear_outputs();
  return {};
}

void ChangePlan::pair_tasks() {
  const bytecode::ContainerView& from = from_.loaded().program().container();
  const bytecode::ContainerView& to = to_.loaded().program().container();
  tasks_ = counterparts(from, to);
  tasks_back_ = counterparts(to, from);
}

// What nobody drives any more must not stay on; what charts drove ends with them.
void ChangePlan::clear_outputs() {
  const bytecode::Program& to = to_.loaded().program();
  const OutputBits driven = written_outputs(to);
  OutputBits ended(to.sizes().output_bytes);
  if (mode_ == DownloadMode::ChangeRestartCharts) {
    const ChartMemory charts = ChartMemory::of(from_.loaded().program());
    ended = written_outputs(from_.loaded().program(), [&](std::uint32_t f) { return charts.owns(f); });
  }
  initial_outputs_.resize(to.sizes().output_bytes);
  for (std::size_t i = 0; i < initial_outputs_.size(); ++i)
    initial_outputs_[i] = static_cast<std::uint8_t>(~driven.mask(i) | ended.mask(i));
}

void ChangePlan::warm() const {
  touched_ = transfer_.touch();
  to_.warm();
}

void ChangePlan::carry(const image::ProcessImage& from, image::ProcessImage& to) const {
  const std::span<const std::byte> initial = to_.loaded().program().container().section(Section::InitialData);
  const auto initial_byte = [&](std::size_t at) { return at < initial.size() ? initial[at] : std::byte{0}; };
  const std::span<const std::byte> old = from.bytes();
  const std::span<std::byte> image = to.bytes();
  // Fresh ones come before the next scan; until then an observer sees the ones that the decision stood on.
  std::memcpy(image.data(), old.data(), std::min(from.layout().inputs, to.layout().inputs));
  transfer_.apply(old, image);
  charts_.apply(old, image);
  const std::span<std::byte> outputs = to.outputs();
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::byte mask{initial_outputs_[i]};
    outputs[i] = (outputs[i] & ~mask) | (initial_byte(to.layout().inputs + i) & mask);
  }
}

std::uint32_t ChangePlan::move_forces(const image::ForceTable& from, image::ForceTable& to) const {
  to.clear_all();
  return move(forward_, from, to, to_.loaded().program().image_size());
}

std::uint32_t ChangePlan::move_forces_back(const image::ForceTable& from, image::ForceTable& to) const {
  const std::size_t image_size = from_.loaded().program().image_size();
  const image::ForceTable at_swap = to;
  to.clear_all();
  for (const image::Force& force : at_swap.forces())
    if (!place_of(forward_, force)) to.set(force, image_size);
  return move(backward_, from, to, image_size);
}

result::Diagnostic ChangePlan::lost_step_problem(std::uint32_t step) const {
  return host::lost_step_problem(charts_.lost_step_name(step));
}

result::Diagnostic ChangePlan::impossible_chart_problem(std::uint32_t chart) const {
  return host::impossible_chart_problem(situations_.chart_name(chart));
}

result::Diagnostics ChangePlan::notes() const {
  const record::TransferReport& report = transfer_.report();
  result::Diagnostics notes;
  const auto note = [&](const char* code, std::string text) {
    notes.push_back({code, result::Severity::Note, {kWhere, 0, 0}, std::move(text), {}});
  };
  const auto list = [&](const char* what, const std::vector<std::string>& names) {
    if (names.empty()) return;
    note(kNotCarried, std::to_string(names.size()) + " " + what + ": " + first_names(names));
  };
  note(kCarried, result::counted(report.carried, "variable keeps its value", "variables keep their values"));
  list("new, with their initial values", report.initialised);
  list("gone with the old program", report.dropped);
  list("of another type, with their initial values", report.retyped);
  list("shorter than before, carried as far as they go", report.shortened);
  list("references, with their initial values", report.references);
  return notes;
}

ChangeReport ChangePlan::report() const {
  const record::TransferReport& report = transfer_.report();
  ChangeReport out;
  out.carried = report.carried;
  out.initialised = static_cast<std::uint32_t>(report.initialised.size());
  out.dropped = static_cast<std::uint32_t>(report.dropped.size());
  out.retyped = static_cast<std::uint32_t>(report.retyped.size() + report.references.size());
  return out;
}

}  // namespace stepwright::host
