#include <algorithm>
#include <array>

#include "hmi_web/historian/block.h"
#include "hmi_web/historian/walk.h"

namespace stepwright::historian {
namespace {

class Walk {
 public:
  Walk(HistoryView& view, TagId tag, Visitor& visitor) : view_(view), tag_(tag), visitor_(visitor) {}

  // Blocks from `first` to below `end`, numbered at `level`, as far as nodes of that level have them; those
  // below for the rest.
  result::Result<void> range(std::uint32_t level, std::uint32_t first, std::uint32_t end) {
    std::vector<HistoryView::Node>& nodes = nodes_[level];
    if (auto read = view_.nodes(tag_, level, first, end, nodes); !read) return read;
    std::uint32_t next = first;
    // By index: deeper levels have lists of their own, and this one stays as it is.
    for (std::size_t i = 0; i < nodes.size() && !ended_; ++i) {
      const HistoryView::Node node = nodes[i];
      if (auto done = children(level, next, node.number); !done) return done;
      next = node.number + 1;
      if (auto done = one(level, node); !done) return done;
    }
    return children(level, next, end);
  }

  result::Result<void> parts(const OpenPart& part) {
    for (const auto& block : part.blocks) {
      samples_.clear();
      if (!decode_block(block, samples_)) visitor_.damaged({});
      visit(samples_);
    }
    visit(part.samples);
    return {};
  }

 private:
  result::Result<void> one(std::uint32_t level, const HistoryView::Node& node) {
    if (node.summary) {
      const Look look = visitor_.judge(*node.summary);
      if (look == Look::Summary) visitor_.take(*node.summary);
      ended_ = look == Look::End;
      if (look != Look::Closer) return {};
    }
    if (level > 0) return children(level, node.number, node.number + 1);
    samples_.clear();
    auto sound = view_.samples(node.block, samples_);
    if (!sound) return result::forward(sound);
    if (!*sound) visitor_.damaged(node.summary.value_or(Summary()));
    visit(samples_);
    return {};
  }

  result::Result<void> children(std::uint32_t level, std::uint32_t first, std::uint32_t end) {
    if (level == 0 || first >= end || ended_) return {};
    return range(level - 1, first << kFanOutBits, end << kFanOutBits);
  }

  void visit(std::span<const Sample> samples) {
    if (samples.empty() || ended_) return;
    const Summary summary = {samples.size(), 0, samples.front(), samples.back(), {}, {}};
    const bool end = visitor_.judge(summary) == Look::End;
    ended_ = end;
    for (const Sample& sample : samples) {
      if (ended_) return;
      visitor_.take(sample);
    }
  }

  HistoryView& view_;
  TagId tag_;
  Visitor& visitor_;
  std::array<std::vector<HistoryView::Node>, kLevels> nodes_;
  std::vector<Sample> samples_;
  bool ended_ = false;
};

}  // namespace

result::Result<void> walk(HistoryView& view, TagId tag, const OpenPart& part, Visitor& visitor) {
  Walk walk(view, tag, visitor);
  std::uint32_t level = 0;
  while (level + 1 < kLevels && part.stored_end >> (level * kFanOutBits) > 0) ++level;
  if (part.stored_end > 0) {
    // A top that covers all; what no node of a level covers is found below it.
    const std::uint32_t unit = level * kFanOutBits;
    const std::uint32_t whole = part.stored_end >> unit;
    for (std::uint32_t first = 0, end = whole;; --level) {
      if (auto done = walk.range(level, first, end); !done) return done;
      if (level == 0) break;
      first = end << kFanOutBits;
      end = part.stored_end >> ((level - 1) * kFanOutBits);
    }
  }
  return walk.parts(part);
}

}  // namespace stepwright::historian
