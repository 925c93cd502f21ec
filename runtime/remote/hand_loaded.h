#pragma once

// Commands a plan on a controller whose program was loaded by hand, through the five registers of
// runtime/doc/modbus_by_hand.md: grants each action when the ones before it have ended, compares what starts
// with what was granted, and takes the grants back when that differs.
//
//   HandLoaded plan(line, 1024, actions);
//   while (plan.state() == HandState::UnderWay) {
//     if (auto news = plan.turn(); news) ... else ... the line ...
//   }
//
// Threads: one. Invariant: nothing is granted that the plan does not allow now, whatever the controller says.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/remote/register_line.h"

namespace stepwright::remote {

// Numbers count from 1 and follow each other.
struct HandAction {
  std::string text;                 // "(load v1 f1 level8)"
  std::vector<std::size_t> before;  // numbers of actions that must have started before
};

enum class HandState : std::uint8_t {
  UnderWay,
  Done,           // every action was started and the chart is at its end
  Failed,         // the chart says so
  Contradiction,  // the controller did what was not granted
};

class HandLoaded {
 public:
  // `first`: the register of HS_ENABLE. The line must outlive this object.
  HandLoaded(RegisterLine& line, std::uint16_t first, std::vector<HandAction> actions);

  // Looks once and grants what may be granted. Returns what is new, a sentence each. Fails with R0141 where
  // the controller does not answer: nothing is lost, it waits at its gates.
  [[nodiscard]] result::Result<std::vector<std::string>> turn();
  // No gate opens any more.
  [[nodiscard]] result::Result<void> withdraw();

  HandState state() const { return state_; }
  std::size_t started() const;

 private:
  using Words = std::array<std::uint16_t, 5>;
  [[nodiscard]] result::Result<void> grant(std::uint16_t enable, std::uint16_t go);
  void follow(const Words& words, std::vector<std::string>& news);
  void take_up(const Words& words);
  void mark_with_all_before(std::size_t number);
  bool may_start(std::size_t number) const;
  std::string name(std::size_t number) const;
  void contradict(std::vector<std::string>& news, std::string why);

  RegisterLine& line_;
  std::uint16_t first_;
  std::vector<HandAction> actions_;
  std::vector<bool> started_;
  HandState state_ = HandState::UnderWay;
  bool met_ = false;
  std::size_t newest_ = 0;   // the action that started last
  std::size_t granted_ = 0;  // 0: none
};

}  // namespace stepwright::remote
