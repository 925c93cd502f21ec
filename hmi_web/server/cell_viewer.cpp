#include "hmi_web/server/cell_viewer.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "hmi_web/server/image_value.h"
#include "runtime/host/state_name.h"

namespace stepwright::server {
namespace {

std::string hexadecimal(std::uint64_t value) {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(value));
  return digits.data();
}

bool is_true(const std::optional<reader::Variable>& bit, std::span<const std::byte> image) {
  return bit && read(*bit, image).value_or(0) != 0;
}

template <typename Bits>
std::vector<std::uint32_t> indices_of_true(const Bits& bits, std::span<const std::byte> image) {
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (is_true(bits[i], image)) indices.push_back(static_cast<std::uint32_t>(i));
  }
  return indices;
}

std::vector<protocol::UnreadDevice> tags_of(const std::vector<UnreadInputs>& unread,
                                            const ProgramLayout& layout) {
  std::vector<protocol::UnreadDevice> devices;
  for (const UnreadInputs& one : unread) {
    protocol::UnreadDevice device{one.device, one.why, {}};
    for (std::uint32_t tag = 0; tag < layout.tags.size(); ++tag)
      if (overlap_any(one.inputs, layout.tags[tag])) device.tags.push_back(tag);
    devices.push_back(std::move(device));
  }
  return devices;
}

// What the page shows all the time; the rest stands in its report of the scan.
void add_status(const host::RuntimeStatus& status, protocol::CellState& state) {
  state.runtime_state = host::name_of(status.state);
  state.runtime_detail = status.detail;
  state.waiting = status.waiting_for_supervisor;
  state.trace_hash = hexadecimal(status.trace_hash);
  state.figures = {status.overruns, status.scan_p50_us, status.scan_p99_us, status.scan_max_us,
                   status.realtime_factor};
}

}  // namespace

CellViewer::CellViewer(std::vector<PointSources> points)
    : points_(std::move(points)), reader_(points_, nullptr) {}

void CellViewer::take_layout(const std::shared_ptr<const ProgramLayout>& layout) {
  if (layout == layout_) return;
  layout_ = layout;
  reader_ = PointReader(points_, layout_.get());
  point_tags_ =
      layout_ ? std::make_shared<const protocol::PointTags>(tags_of_points(points_, *layout_)) : nullptr;
  reals_.clear();
  for (std::uint32_t i = 0; layout_ && i < layout_->tags.size(); ++i)
    if (layout_->tags[i].type == bytecode::ElementaryType::Real) reals_.push_back(i);
  unread_.clear();
  unread_tags_.clear();
  unread_points_.clear();
}

void CellViewer::take_unread(const std::vector<UnreadInputs>& unread) {
  if (!layout_ || unread == unread_) return;
  unread_ = unread;
  unread_tags_ = tags_of(unread, *layout_);
  unread_points_ = points_from(points_, unread, *layout_);
}

CellView CellViewer::view(const Observation& observation) {
  take_layout(observation.layout);
  take_unread(observation.unread);
  CellView view;
  view.layout = layout_;
  view.points = point_tags_;
  view.plan = observation.plan;
  view.pictures = observation.pictures;
  protocol::CellState& state = view.state;
  state.runtime_alive = observation.runtime_alive;
  state.runtime_unlinked = observation.runtime_unlinked;
  state.supervisor_alive = observation.supervisor_alive;
  state.points.resize(points_.size());
  if (observation.status) add_status(*observation.status, state);
  if (layout_) {
    state.program_digest = layout_->program.digest;
    state.tags.resize(layout_->tags.size());
    state.reals = reals_;
  }
  if (!observation.snapshot) return view;

  const ImageSnapshot& snapshot = *observation.snapshot;
  state.scan = snapshot.scan;
  state.time_s = snapshot.time_s;
  state.points = reader_.read(snapshot, observation.tare);
  if (!layout_) return view;
  state.unread = unread_tags_;
  for (const std::size_t point : unread_points_) state.points[point].reset();
  state.active_steps = indices_of_true(layout_->steps, snapshot.image);
  state.true_transitions = indices_of_true(layout_->transitions, snapshot.image);
  for (std::size_t i = 0; i < layout_->tags.size(); ++i) {
    state.tags[i] = read(layout_->tags[i], snapshot.image);
    if (auto text = read_text(layout_->tags[i], snapshot.image))
      state.texts.emplace(static_cast<std::uint32_t>(i), *std::move(text));
  }
  return view;
}

}  // namespace stepwright::server
