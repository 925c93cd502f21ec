#pragma once

// [tamp]: what two arms are to do.
//
//   [tamp]
//   problem = "cell.tamp.toml"      # arms, furniture, regions, things (supervisor/doc/tamp.md, The file)
//   domain = "stacking_arms.pddl"   # of orders; default: the problem's own, where that is PDDL
//   order = "P1"                    # the first one; default: the first of the list
//   exchange = ["box-top"]          # regions where things change hands; default: any
//   time_s = 60.0                   # of wall time until there is a plan, for a machine that is far too slow
//   seed = 1                        # the same seed has the same plan, or none, unless the time was over
//   retries = 3                     # of one thing that slips, is missed or was moved
//   following_rad = 0.004           # a joint farther from its set point has failed
//   pictures_ms = 250               # between pictures of the camera while the arms work
//   hold_s = 3600                   # so long the arms wait for somebody
//   attended = true                 # somebody can see to what the arms cannot do; false: then the run ends
//   [[tamp.orders]]
//   name = "P1"
//   goal = "(in cup1 red-region)"   # or (and (in can1 tray) (in can2 can1))
//   [[tamp.requests]]               # an operator asks for this at that time
//   at_s = 10.0
//   request = "goal"                # or "hold", "resume"
//   goal = "P2"                     # the name of an order, or a goal

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cell/missions/table/mission_table.h"
#include "runtime/ground/settings/key_words.h"

namespace stepwright::missions {

struct TampOrder {
  std::string name, goal;
  result::Location where;  // of the goal
};

struct TampAsked {
  double at_s = 0.0;
  std::string request;
  std::string goal;  // of "goal"
  result::Location where;
};

struct TampTable final : MissionTable {
  std::filesystem::path problem;
  std::filesystem::path domain;  // empty: the problem's
  std::string order;             // empty: the first
  double time_s = 60.0;
  std::uint64_t seed = 1;
  int retries = 3;
  double following_rad = 0.004;  // besides what the joint moves between two scans
  std::chrono::milliseconds pictures{250};
  std::chrono::seconds hold{3'600};
  bool attended = true;
  std::vector<std::string> exchange;
  std::vector<TampOrder> orders;
  std::vector<TampAsked> requests;
  result::Location where, order_where, exchange_where;  // of their keys

  std::vector<std::string> unattended() const override { return {"tamp.attended=false"}; }
};

std::shared_ptr<const MissionTable> read_tamp_table(const settings::TomlTable& table,
                                                    const TablePlace& place);

// What people are told of its keys.
std::span<const settings::KeyWords> tamp_keys();

}  // namespace stepwright::missions
