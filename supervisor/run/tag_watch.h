#pragma once

// Tags of whatever program runs that become TRUE when something is wrong: those of the cell's monitors. Each
// is told once; a program that is the same, or that keeps its values, keeps what was told.
//
// Thread rule: one thread at a time. Example:
//   TagWatch watch({{"monitor_limit.Failed", "monitor 'limit' failed: never high"}});
//   watch.begin(container, false);
//   if (auto cause = watch.news(event.image)) ...

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "supervisor/run/cause.h"

namespace stepwright::run {

struct WatchedTag {
  std::string tag;
  std::string sentence;  // the evidence
};

class TagWatch {
 public:
  TagWatch() = default;
  explicit TagWatch(std::vector<WatchedTag> tags) : tags_(std::move(tags)), told_(tags_.size(), false) {}

  // The program whose images come from now on; tags that it lacks are not watched.
  void begin(std::span<const std::byte> container, bool carried_on);
  // What has become TRUE since the last call, as one cause.
  std::optional<Cause> news(std::span<const std::byte> image);

 private:
  std::vector<WatchedTag> tags_;
  std::vector<bool> told_;
  std::vector<std::optional<reader::Variable>> places_;
};

}  // namespace stepwright::run
