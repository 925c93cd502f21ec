#include "supervisor/htn/syntax/ordering.h"

#include <algorithm>
#include <map>
#include <queue>

#include "supervisor/lisp/name_hints.h"

namespace stepwright::htn {
namespace {

std::string name_of(const ParsedSubtask& subtask) {
  return subtask.label.empty() ? subtask.call.name : subtask.label;
}

class Ordering {
 public:
  Ordering(ParsedNetwork& network, lisp::Reporter& reporter)
      : network_(network), reporter_(reporter), after_(network.subtasks.size()), waits_(after_.size(), 0) {}

  bool run() {
    if (!read_labels() || !read_orders()) return false;
    return network_.ordered ? in_listed_order() : sort();
  }

 private:
  bool read_labels() {
    bool good = true;
    for (std::size_t i = 0; i < network_.subtasks.size(); ++i) {
      const ParsedSubtask& subtask = network_.subtasks[i];
      if (subtask.label.empty() || labels_.emplace(subtask.label, static_cast<int>(i)).second) continue;
      reporter_.error("P0603", subtask.label_at, "the label '" + subtask.label + "' stands twice");
      good = false;
    }
    return good;
  }

  int find(const ParsedTerm& label) {
    const auto found = labels_.find(label.name);
    if (found != labels_.end()) return found->second;
    reporter_.error("P0604", label.at, "no subtask has the label '" + label.name + "'",
                    reporter_.full() ? "" : lisp::did_you_mean(label.name, lisp::names_of(labels_)));
    return -1;
  }

  bool read_orders() {
    bool good = true;
    for (const ParsedOrder& order : network_.orders) {
      const int before = find(order.before), after = find(order.after);
      if (before < 0 || after < 0) {
        good = false;
        continue;
      }
      after_[static_cast<std::size_t>(before)].push_back(static_cast<std::size_t>(after));
      ++waits_[static_cast<std::size_t>(after)];
    }
    return good;
  }

  // Orders beside ":ordered-subtasks" may repeat what these say.
  bool in_listed_order() {
    for (const ParsedOrder& order : network_.orders) {
      if (labels_.at(order.before.name) < labels_.at(order.after.name)) continue;
      reporter_.error("P0603", order.before.at,
                      "'" + order.before.name + "' stands behind '" + order.after.name + "' in the list",
                      "':ordered-subtasks' are done in the order of their list");
      return false;
    }
    return true;
  }

  // A topological order is the only one if each subtask is ordered before the one that follows it.
  bool sort() {
    std::vector<std::size_t> sorted;
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> free;
    for (std::size_t i = 0; i < waits_.size(); ++i)
      if (waits_[i] == 0) free.push(i);
    while (!free.empty()) {
      sorted.push_back(free.top());
      free.pop();
      for (const std::size_t next : after_[sorted.back()])
        if (--waits_[next] == 0) free.push(next);
    }
    if (sorted.size() < waits_.size()) {
      reporter_.error("P0603", network_.orders.front().before.at, "the ordering goes round in a circle");
      return false;
    }
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      const std::vector<std::size_t>& later = after_[sorted[i - 1]];
      if (std::ranges::find(later, sorted[i]) == later.end()) return open(sorted[i - 1], sorted[i]);
    }
    std::vector<ParsedSubtask> ordered;
    for (const std::size_t i : sorted) ordered.push_back(std::move(network_.subtasks[i]));
    network_.subtasks = std::move(ordered);
    return true;
  }

  bool open(std::size_t first, std::size_t second) {
    reporter_.error("P0602", network_.at,
                    "'" + name_of(network_.subtasks[first]) + "' and '" + name_of(network_.subtasks[second]) +
                        "' may be done in either order",
                    "networks are totally ordered here: use ':ordered-subtasks', or order these two");
    return false;
  }

  ParsedNetwork& network_;
  lisp::Reporter& reporter_;
  std::map<std::string, int> labels_;
  std::vector<std::vector<std::size_t>> after_;
  std::vector<std::size_t> waits_;
};

}  // namespace

bool put_in_order(ParsedNetwork& network, lisp::Reporter& reporter) {
  return Ordering(network, reporter).run();
}

}  // namespace stepwright::htn
