#include "supervisor/htn/search/network_height.h"

#include <algorithm>
#include <vector>

namespace stepwright::htn {
namespace {

// Longest ways over which tasks lead to their subtasks, a step being as long as what waits behind the
// subtask, by rounds of Bellman and Ford: they do not end where a circle is longer than nothing.
constexpr std::size_t kMostRounds = 1000;

class Heights {
 public:
  explicit Heights(const PlanningTask& task) : task_(task), height_(task.tasks.size(), 1) {}

  NetworkHeight run() {
    const std::size_t rounds = std::min(kMostRounds, height_.size() + 1);
    bool changed = true;
    for (std::size_t i = 0; i < rounds && changed; ++i) changed = round();
    const auto root = static_cast<std::size_t>(task_.methods[task_.root].task);
    if (!changed) return {false, height_[root]};
    return {true, static_cast<int>(task_.methods[task_.root].subtasks.size())};
  }

 private:
  bool round() {
    bool changed = false;
    for (const Method& method : task_.methods) {
      int& height = height_[static_cast<std::size_t>(method.task)];
      const auto count = static_cast<int>(method.subtasks.size());
      for (int i = 0; i < count; ++i) {
        const Subtask& subtask = method.subtasks[static_cast<std::size_t>(i)];
        const int own = subtask.primitive ? 1 : height_[static_cast<std::size_t>(subtask.symbol)];
        const int all = own + count - 1 - i;
        changed = changed || all > height;
        height = std::max(height, all);
      }
    }
    return changed;
  }

  const PlanningTask& task_;
  std::vector<int> height_;
};

}  // namespace

NetworkHeight network_height(const PlanningTask& task) {
  return Heights(task).run();
}

}  // namespace stepwright::htn
