#include "hmi_web/historian/open_tags.h"

#include <algorithm>
#include <utility>

#include "hmi_web/historian/block.h"

namespace stepwright::historian {
namespace {

constexpr std::size_t kMostWaitingParents = 100'000;

// Nearly always at the end.
void insert_in_order(std::vector<Sample>& samples, const Sample& sample) {
  if (samples.empty() || samples.back().time_ns <= sample.time_ns) {
    samples.push_back(sample);
    return;
  }
  samples.insert(std::ranges::upper_bound(samples, sample.time_ns, {}, &Sample::time_ns), sample);
}

std::vector<Sample> with_held(std::vector<Sample> samples, const Suppression& suppression) {
  if (suppression.held()) insert_in_order(samples, *suppression.held());
  return samples;
}

}  // namespace

void OpenTags::restore(StoredTag stored) {
  const TagId id = stored.row.tag;
  if (tags_.size() <= id.value) tags_.resize(id.value + 1);
  Tag& tag = tags_[id.value];
  tag.exists = true;
  tag.name = stored.row.name;
  tag.first_number = stored.first_number;
  tag.number = stored.next_number;
  tag.partial = std::move(stored.partial);
  by_name_[tag.name] = id;
  for (const Sample& sample : stored.open) {
    tag.open.push_back(sample);
    if (tag.open.size() == kBlockSamples) seal(id, tag);
  }
  tag.changed = !tag.open.empty();
  if (tag.number == stored.next_number || tag.open.empty()) return;
  // The file has them under the number of the block that is full now.
  tag.fresh = tag.open;
  tag.touched = true;
  touched_.push_back(id);
}

std::optional<TagId> OpenTags::add(const std::string& name, const SuppressionSettings& settings) {
  const auto found = by_name_.find(name);
  if (found == by_name_.end() && tags_.size() >= kMostTags) return std::nullopt;
  const TagId id = found != by_name_.end() ? found->second : TagId(static_cast<std::uint32_t>(tags_.size()));
  if (found == by_name_.end()) {
    Tag& made = tags_.emplace_back();
    made.name = name;
    made.is_new = made.exists = true;
    by_name_[name] = id;
  }
  tags_[id.value].next_settings = settings;
  return id;
}

void OpenTags::change_settings(TagId id, Tag& tag) {
  if (const std::optional<Sample> held = tag.suppression.held()) keep(id, tag, *held);
  tag.suppression = Suppression(*std::exchange(tag.next_settings, std::nullopt));
  if (!tag.open.empty()) tag.suppression.resume(tag.open.back());
}

std::optional<TagId> OpenTags::find(const std::string& name) const {
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return std::nullopt;
  return found->second;
}

std::vector<TagRow> OpenTags::names() const {
  std::vector<TagRow> rows;
  for (const auto& [name, id] : by_name_) rows.push_back({id, name});
  return rows;
}

std::string OpenTags::name(TagId id) const {
  return id.value < tags_.size() ? tags_[id.value].name : "";
}

void OpenTags::append(const TagSample& sample) {
  const TagId id = sample.tag;
  if (id.value >= tags_.size() || !tags_[id.value].exists) {
    ++unknown_;
    return;
  }
  Tag& tag = tags_[id.value];
  if (tag.next_settings) change_settings(id, tag);
  tag.suppression.offer(sample.sample, [&](const Sample& kept) { keep(id, tag, kept); });
  if (tag.suppression.held() && !tag.touched) {
    tag.touched = tag.changed = true;
    touched_.push_back(id);
  }
}

void OpenTags::release_held() {
  for (std::uint32_t i = 0; i < tags_.size(); ++i) {
    Tag& tag = tags_[i];
    const std::optional<Sample> held = tag.suppression.held();
    if (!held) continue;
    keep(TagId(i), tag, *held);
    tag.suppression.resume(*held);
  }
}

void OpenTags::keep(TagId id, Tag& tag, const Sample& sample) {
  ++kept_;
  insert_in_order(tag.open, sample);
  insert_in_order(tag.fresh, sample);
  if (!tag.touched) touched_.push_back(id);
  tag.touched = tag.changed = true;
  if (tag.open.size() >= kBlockSamples) seal(id, tag);
}

void OpenTags::seal(TagId id, Tag& tag) {
  BlockRow row{id, tag.number, summary_of(tag.open), encode_block(tag.open)};
  tag.open.clear();
  tag.fresh.clear();
  Summary carried = row.summary;
  waiting_bytes_ += row.block.size();
  blocks_.push_back(std::move(row));
  std::uint32_t child = tag.number++;
  for (std::uint32_t level = 1; level < kLevels; ++level) {
    if (tag.partial.size() < level) tag.partial.emplace_back();
    Summary& partial = tag.partial[level - 1];
    partial.add(carried);
    if ((child + 1) % kFanOut != 0) break;
    child /= kFanOut;
    carried = std::exchange(partial, {});
    // One that tells of deleted blocks is not written: readers descend to those that are left.
    const bool whole = static_cast<std::uint64_t>(child) << (level * kFanOutBits) >= tag.first_number;
    if (whole) parents_.push_back({id, level, child, carried});
  }
  drop_what_waits_too_long();
}

void OpenTags::drop_what_waits_too_long() {
  std::size_t dropped = 0;
  for (; waiting_bytes_ > most_waiting_bytes_ && dropped < blocks_.size(); ++dropped) {
    const BlockRow& row = blocks_[dropped];
    waiting_bytes_ -= row.block.size();
    lost_ += row.summary.count;
    // Nothing above may tell of it.
    tags_[row.tag.value].first_number = std::max(tags_[row.tag.value].first_number, row.number + 1);
    std::erase_if(parents_, [&](const ParentRow& parent) {
      return parent.tag == row.tag && parent.number == row.number >> (parent.level * kFanOutBits);
    });
  }
  blocks_.erase(blocks_.begin(), blocks_.begin() + static_cast<std::ptrdiff_t>(dropped));
  // Readers do without them.
  if (parents_.size() > kMostWaitingParents) parents_.clear();
}

WriteSet OpenTags::collect(bool checkpoint) {
  WriteSet set;
  set.is_checkpoint = checkpoint;
  for (std::uint32_t i = 0; i < tags_.size(); ++i) {
    const Tag& tag = tags_[i];
    if (tag.is_new) set.tags.push_back({TagId(i), tag.name});
    if (!checkpoint || !tag.changed) continue;
    const std::vector<Sample> samples = with_held(tag.open, tag.suppression);
    if (!samples.empty()) set.open.push_back({TagId(i), tag.number, encode_block(samples)});
  }
  if (checkpoint) return set;
  for (const TagId id : touched_) {
    const Tag& tag = tags_[id.value];
    const std::vector<Sample> samples = with_held(tag.fresh, tag.suppression);
    if (!samples.empty()) set.tail.push_back({id, tag.number, encode_block(samples)});
  }
  return set;
}

void OpenTags::committed(const WriteSet& set) {
  for (const TagId id : touched_) {
    tags_[id.value].fresh.clear();
    tags_[id.value].touched = false;
  }
  touched_.clear();
  for (const TagRow& row : set.tags) tags_[row.tag.value].is_new = false;
  if (set.is_checkpoint) {
    for (Tag& tag : tags_) tag.changed = false;
  }
  blocks_.clear();
  parents_.clear();
  waiting_bytes_ = 0;
}

void OpenTags::begin_new_file() {
  for (Tag& tag : tags_) {
    tag.is_new = tag.exists;
    tag.changed = true;
    tag.partial.clear();
    // Waiting blocks are written to the new file; a node above them would tell of others, too.
    tag.first_number = tag.number;
  }
  parents_.clear();
}

void OpenTags::deleted(const std::vector<BlockNumber>& numbers) {
  for (const BlockNumber& block : numbers) {
    if (block.tag.value >= tags_.size()) continue;  // of a damaged file
    Tag& tag = tags_[block.tag.value];
    tag.first_number = std::max(tag.first_number, block.number + 1);
  }
}

std::optional<OpenPart> OpenTags::open_part(TagId id) const {
  if (id.value >= tags_.size() || !tags_[id.value].exists) return std::nullopt;
  const Tag& tag = tags_[id.value];
  OpenPart part;
  part.stored_end = tag.number;
  for (const BlockRow& row : blocks_) {
    if (row.tag != id) continue;
    part.stored_end = std::min(part.stored_end, row.number);
    part.blocks.push_back(row.block);
  }
  part.samples = with_held(tag.open, tag.suppression);
  return part;
}

}  // namespace stepwright::historian
