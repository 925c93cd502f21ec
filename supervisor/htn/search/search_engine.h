#pragma once

// The search's inside: a path of frames, each a compound task with the ways to decompose it.
//
// Thread rule: as Search.

#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "supervisor/htn/search/action_table.h"
#include "supervisor/htn/search/agenda.h"
#include "supervisor/htn/search/binding_walk.h"
#include "supervisor/htn/search/network_height.h"
#include "supervisor/htn/search/node_table.h"
#include "supervisor/htn/search/search.h"

namespace stepwright::htn {

// A compound task on the path that is being decomposed.
struct Frame {
  int network = Agenda::kEmpty;  // begins with the task
  int task = 0;                  // ground
  Fingerprint node;
  std::size_t mark = 0;     // of the state
  std::size_t actions = 0;  // applied before
  std::size_t method = 0;   // that is tried next, among those of the task
  bool walking = false;     // the method before it has more choices
  BindingWalk walk;
  int chosen_method = -1;
  int chosen = Agenda::kEmpty;  // the network after it
  bool tried = false;           // some choice could be made
  bool solved = false;          // a plan was found below
  bool given_up = false;        // something below was refused without proof
  bool by_prefix = false;       // something below was rejected for what comes before it
  std::uint32_t lowest = 0;     // depth of the highest open node that something below came back to
  std::vector<Fingerprint> conditional;
};

// An action of the present prefix.
struct AppliedAction {
  int ground = 0;
  Fingerprint prefix;  // of the actions up to this one
};

class Search::Implementation {
 public:
  Implementation(const PlanningTask& task, SearchOptions options, SemanticAttachment* attachment);
  ~Implementation() { take_back(0); }

  SearchOutcome next();
  void reject(std::size_t keep, bool proven);
  void extend(std::optional<std::chrono::steady_clock::time_point> until);
  void retry_unproven();
  const SearchStatistics& statistics() const { return statistics_; }

 private:
  enum class Step : std::uint8_t { Failed, Opened, Found, Jumped };
  // What the search says where it got farthest.
  struct Farthest {
    std::size_t actions = 0;
    int ground = -1;
    std::string obstacle;
  };

  // search.cpp: the walk
  bool begin_stage();
  bool run();
  bool choose(Frame& frame);
  static void try_again(Frame& frame);
  Step advance(int network);
  Step act(int ground);
  Step finish();
  Step open(int network);
  bool use_method(Frame& frame, const Method& method);
  void take_back(std::size_t actions);
  void note_obstacle(int ground, std::string obstacle);
  SearchOutcome ended();
  std::string progress() const;
  Fingerprint node_of(int network) const;
  bool is_action(int ground) const { return tuples_.head(ground) < static_cast<int>(task_.actions.size()); }
  Evaluation evaluation() { return {task_, state_, interrupt_}; }

  // search_nodes.cpp: what becomes of nodes
  void close();
  void settle(Frame& frame, NodeStatus status, std::uint32_t depth);
  bool known(Frame& from, const Fingerprint& node);
  bool is_new_plan();

  // search_external.cpp: the attachment
  Step ask(const std::vector<ExternalLiteral>& literals, const std::vector<int>& binding, bool effects,
           std::size_t prefix, const Fingerprint* refused);
  Step refuse(std::size_t keep, bool proven, std::size_t prefix, const Fingerprint* refused);
  Step act_outside(const GroundAction& action, const Fingerprint& prefix);
  bool is_nogood(const Fingerprint& prefix);
  void jump(std::size_t keep, bool proven);

  // plan_builder.cpp
  Plan build_plan() const;

  const PlanningTask& task_;
  SearchOptions options_;
  SemanticAttachment* attachment_;
  State state_;
  Interrupt interrupt_;
  ActionTable actions_;
  TupleTable tuples_;  // ground actions and tasks; the head of a task is its number behind the actions'
  Agenda agenda_;
  NodeTable nodes_;
  std::vector<MethodTests> tests_;
  std::vector<Frame> frames_;  // those beyond `depth_` keep their memory
  std::size_t depth_ = 0;
  std::vector<AppliedAction> applied_;
  std::unordered_map<Fingerprint, bool, FingerprintHash> nogoods_;  // prefixes; true: proven
  std::unordered_set<Fingerprint, FingerprintHash> found_;          // decompositions that were returned
  NetworkHeight height_;
  int bound_ = 0;          // of the tasks of a network, in this stage
  int excess_ = 0;         // of the bound above the problem's tasks
  bool cut_ = false;       // in this stage a network met the bound
  bool running_ = false;   // a stage is under way
  bool given_up_ = false;  // the root was not refuted by proof
  bool full_ = false;      // too many nodes
  SearchStatistics statistics_;
  Farthest farthest_;
  std::vector<int> row_;
  std::vector<int> scratch_;
};

}  // namespace stepwright::htn
