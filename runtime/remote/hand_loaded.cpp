#include "runtime/remote/hand_loaded.h"

#include <algorithm>
#include <utility>

namespace stepwright::remote {
namespace {

// The registers behind the first one, as supervisor/translate/handshake.h orders them.
enum Word : std::size_t { kEnable, kGo, kWaiting, kStarted, kOutcome };
constexpr std::uint16_t kDone = 1;
constexpr std::uint16_t kFailed = 2;

}  // namespace

HandLoaded::HandLoaded(RegisterLine& line, std::uint16_t first, std::vector<HandAction> actions)
    : line_(line), first_(first), actions_(std::move(actions)), started_(actions_.size()) {}

std::size_t HandLoaded::started() const {
  return static_cast<std::size_t>(std::ranges::count(started_, true));
}

std::string HandLoaded::name(std::size_t number) const {
  return "action " + std::to_string(number) + " " + actions_[number - 1].text;
}

bool HandLoaded::may_start(std::size_t number) const {
  const auto& before = actions_[number - 1].before;
  return !started_[number - 1] &&
         std::ranges::all_of(before, [this](std::size_t each) { return started_[each - 1]; });
}

void HandLoaded::mark_with_all_before(std::size_t number) {
  if (started_[number - 1]) return;
  started_[number - 1] = true;
  for (const std::size_t each : actions_[number - 1].before) mark_with_all_before(each);
}

// A plan that is under way already: what it has come to says what was done.
void HandLoaded::take_up(const Words& words) {
  met_ = true;
  newest_ = words[kStarted] <= actions_.size() ? words[kStarted] : 0;
  if (newest_ != 0) mark_with_all_before(newest_);
  const std::size_t waiting = words[kWaiting];
  if (waiting == 0 || waiting > actions_.size()) return;
  for (const std::size_t each : actions_[waiting - 1].before) mark_with_all_before(each);
}

void HandLoaded::contradict(std::vector<std::string>& news, std::string why) {
  state_ = HandState::Contradiction;
  granted_ = 0;
  news.push_back(std::move(why));
}

void HandLoaded::follow(const Words& words, std::vector<std::string>& news) {
  const std::size_t started = words[kStarted];
  const std::size_t waiting = words[kWaiting];
  if (started > actions_.size() || waiting > actions_.size()) {
    return contradict(news, "the controller speaks of action " + std::to_string(std::max(started, waiting)) +
                                ", and the plan has " + std::to_string(actions_.size()) +
                                ": another program is loaded");
  }
  if (started != newest_) {
    if (started == 0) return contradict(news, "the controller began from the start again");
    if (started != granted_) return contradict(news, name(started) + " started and was not granted");
    newest_ = started;
    started_[started - 1] = true;
    granted_ = 0;
    news.push_back(name(started) + " started");
  }
  if (words[kOutcome] == kFailed) {
    state_ = HandState::Failed;
    news.push_back(newest_ == 0 ? "the plan failed before its first action"
                                : "the plan failed; " + name(newest_) + " was the last one that started");
    return;
  }
  if (words[kOutcome] == kDone) {
    if (this->started() != actions_.size())
      return contradict(news, "the controller is at its end, and not every action was started");
    state_ = HandState::Done;
    news.push_back("the plan is done");
    return;
  }
  if (waiting == 0 || started_[waiting - 1] || granted_ == waiting) return;
  if (!may_start(waiting))
    return contradict(news, name(waiting) + " waits, and an action that must come before it has not begun");
  granted_ = waiting;
  news.push_back(name(waiting) + " is granted");
}

result::Result<void> HandLoaded::grant(std::uint16_t enable, std::uint16_t go) {
  const LineAnswer answer = line_.write(first_, std::array{enable, go});
  if (answer.ok()) return {};
  if (answer.fault == LineFault::Closed) static_cast<void>(line_.reopen());
  return result::fail("R0141", {line_.name(), 0, 0}, "a grant could not be written",
                      "may this master write the first two registers of the handshake?");
}

result::Result<std::vector<std::string>> HandLoaded::turn() {
  Words words{};
  const LineAnswer answer = line_.read(first_, words);
  if (!answer.ok()) {
    if (answer.fault == LineFault::Closed) static_cast<void>(line_.reopen());
    return result::fail("R0141", {line_.name(), 0, 0}, "the controller does not answer",
                        "it waits at its next gate with the plan's outputs off");
  }
  std::vector<std::string> news;
  if (!met_) take_up(words);
  follow(words, news);
  const auto go = static_cast<std::uint16_t>(granted_);
  const std::uint16_t enable = state_ == HandState::UnderWay ? 1 : 0;
  if (words[kEnable] != enable || words[kGo] != go) {
    if (auto granted = grant(enable, go); !granted) return result::forward(granted);
  }
  return news;
}

result::Result<void> HandLoaded::withdraw() {
  return grant(0, 0);
}

}  // namespace stepwright::remote
