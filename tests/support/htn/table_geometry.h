#pragma once

// Stand-in for the geometry of tests/cells/htn: which arm reaches which place, and how many things a place
// takes. A state for every action, as the real one has.

#include <map>
#include <set>
#include <string>
#include <vector>

#include "supervisor/htn/search/semantic_attachment.h"
#include "supervisor/htn/task/planning_task.h"

namespace stepwright::htn::test {

inline const std::vector<std::string> kGeometricPredicates = {
    "can-move-pick", "is-picked", "can-move-place", "is-placed", "can-move-away", "is-away"};

struct TableLimits {
  std::map<std::string, std::set<std::string>> reach;  // of each arm
  std::map<std::string, int> room;                     // of places that take few things
};

class TableGeometry : public SemanticAttachment {
 public:
  TableGeometry(const PlanningTask& task, TableLimits limits);

  void push(const ExternalCall& action) override;
  void pop() override { states_.pop_back(); }
  std::optional<Refusal> require(const ExternalCall& atom, bool wanted) override;
  std::optional<Refusal> change(const ExternalCall& atom, bool value) override;
  std::optional<Fingerprint> fingerprint() const override;

  // Of the thing in the present state; "left" if the left arm holds it.
  std::string place_of(const std::string& thing) const { return states_.back().at(thing); }
  std::size_t depth() const { return states_.size() - 1; }

 private:
  using Places = std::map<std::string, std::string>;

  std::string refusal_of(const std::string& predicate, const std::vector<std::string>& names) const;
  std::vector<std::string> names_of(const ExternalCall& call) const;

  const PlanningTask& task_;
  TableLimits limits_;
  std::vector<Places> states_;
};

}  // namespace stepwright::htn::test
