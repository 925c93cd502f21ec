// Who has the next turn on a connection: what dead units cost the others, and how they come back. Nothing is
// waited for: a line whose time is counted takes the place of the real one, so the figures are exact.

#include "runtime/modbus/client/poll/poll_schedule.h"

#include <algorithm>
#include <iterator>

#include "tests/unit/runtime/modbus/client/poll/remote_io.h"

namespace stepwright::modbus::client {
namespace {

using Turn = PollSchedule::Turn;

constexpr auto kPeriod = 50ms;
constexpr auto kTimeout = 100ms;
constexpr auto kRetryAfter = 200ms;
constexpr auto kRetryAtMost = 1'600ms;
constexpr auto kAnswer = 4ms;  // a request with its answer

std::vector<Device> devices_of(std::size_t count) {
  std::vector<Device> devices;
  for (std::size_t i = 0; i < count; ++i) {
    devices.push_back(device_at(0, {group_of({word_tag(10, static_cast<std::uint32_t>(i))}, {}, kPeriod)},
                                static_cast<std::uint8_t>(i + 1)));
    devices.back().timeout = kTimeout;
    devices.back().retry_after = kRetryAfter;
    devices.back().retry_at_most = kRetryAtMost;
  }
  return devices;
}

// A request as it went over the line.
struct Asked {
  std::size_t unit;
  Clock::time_point at;
  bool answered;
  bool dead;  // after it
};

// A line with units that answer at once or not at all. All are read every 50 ms.
class CountedLine {
 public:
  CountedLine(std::size_t units, bool serial)
      : devices_(devices_of(units)), schedule_(devices_, now_, serial), silent_(units, false) {}

  void silence(std::size_t unit, bool silent) { silent_[unit] = silent; }
  Clock::time_point now() const { return now_; }
  const std::vector<Asked>& asked() const { return asked_; }
  int lost_connections() const { return lost_connections_; }

  bool asleep(std::size_t unit) { return schedule_.units()[unit].asleep(); }
  std::size_t count_asleep() {
    return static_cast<std::size_t>(std::ranges::count_if(schedule_.units(), &Unit::asleep));
  }

  void run_for(milliseconds time) {
    for (const auto end = now_ + time; now_ < end;) turn();
  }
  // False if it takes longer than a minute.
  bool run_until(const std::function<bool()>& condition) {
    for (const auto end = now_ + 60s; !condition(); turn()) {
      if (now_ > end) return false;
    }
    return true;
  }

  // When the unit was asked, from `from` on.
  std::vector<Clock::time_point> instants_of(std::size_t unit, Clock::time_point from = {}) const {
    std::vector<Clock::time_point> instants;
    for (const Asked& each : asked_) {
      if (each.unit == unit && each.at >= from) instants.push_back(each.at);
    }
    return instants;
  }

 private:
  void turn() {
    const PollSchedule::Job job = schedule_.next(now_);
    if (job.turn == Turn::Wait) {
      ASSERT_GT(job.at, now_) << "a wait that is over already";
      now_ = job.at;
      return;
    }
    ASSERT_NE(job.turn, Turn::Write);
    const auto sent = now_;
    now_ += silent_[job.unit] ? kTimeout : kAnswer;
    GroupPoll& group = *schedule_.units()[job.unit].next_group();
    if (silent_[job.unit]) {
      lost_connections_ += schedule_.silent(job.unit, sent, now_).of_connection ? 1 : 0;
    } else {
      schedule_.answered(job.unit, now_);
      if (job.turn == Turn::Read) {
        group.advance(now_);
      } else {
        group.due = now_;
      }
    }
    schedule_.ended(job.turn);
    asked_.push_back({job.unit, sent, !silent_[job.unit], schedule_.units()[job.unit].asleep()});
  }

  Clock::time_point now_{1h};
  std::vector<Device> devices_;
  PollSchedule schedule_;
  std::vector<bool> silent_;
  std::vector<Asked> asked_;
  int lost_connections_ = 0;
};

Clock::duration longest_pause(const std::vector<Clock::time_point>& instants) {
  Clock::duration longest{0};
  for (std::size_t i = 1; i < instants.size(); ++i)
    longest = std::max(longest, instants[i] - instants[i - 1]);
  return longest;
}

TEST(PollSchedule, WhenOneOfALineIsDead_ThenItsTriesBecomeRareAndTheOthersKeepTheirPeriods) {
  CountedLine line(4, true);
  line.silence(2, true);
  ASSERT_TRUE(line.run_until([&] { return line.instants_of(2).size() == 8; }));
  const auto tries = line.instants_of(2);
  // Asked twice it is dead; then it is left alone for longer each time.
  constexpr milliseconds kPauses[] = {kRetryAfter, 2 * kRetryAfter, 4 * kRetryAfter, kRetryAtMost,
                                      kRetryAtMost};
  for (std::size_t i = 0; i < std::size(kPauses); ++i) {
    const auto pause = tries[i + 2] - (tries[i + 1] + kTimeout);
    // After each the others have three times as long as it took.
    const Clock::duration expected = std::max<Clock::duration>(kPauses[i], 3 * kTimeout);
    EXPECT_GE(pause, expected) << i;
    EXPECT_LE(pause, expected + 4 * kAnswer) << i;
  }
  for (const std::size_t other : {0u, 1u, 3u}) {
    EXPECT_LE(longest_pause(line.instants_of(other)), kPeriod + kTimeout + 4 * kAnswer);
    EXPECT_GE(line.instants_of(other, tries[6]).size(), 32u) << "turns between two tries";
    EXPECT_FALSE(line.asleep(other));
  }
}

TEST(PollSchedule, WhenAllOfALineWereSilentAndOneAnswers_ThenTheOthersAreTriedAtOnce) {
  CountedLine line(6, true);
  line.run_for(1s);
  for (std::size_t unit = 0; unit < 6; ++unit) line.silence(unit, true);
  line.run_for(10s);
  ASSERT_EQ(line.count_asleep(), 6u);
  const auto begin = line.now();
  for (std::size_t unit = 0; unit < 6; ++unit) line.silence(unit, false);
  ASSERT_TRUE(line.run_until([&] { return line.count_asleep() < 6; }));
  EXPECT_LE(line.now() - begin, kRetryAfter + kAnswer) << "nobody is spared while nobody answers";
  const auto first = line.now();
  ASSERT_TRUE(line.run_until([&] { return line.count_asleep() == 0; }));
  // A late answer to what was asked last may still be on its way for one timeout.
  EXPECT_LE(line.now() - first, kTimeout + 5 * kAnswer);
}

TEST(PollSchedule, WhenSeveralOfALineDieTogether_ThenTheOthersHaveTurnsBetweenTheirTimeouts) {
  CountedLine line(8, true);
  line.run_for(1s);
  const auto begin = line.now();
  for (std::size_t unit = 2; unit < 8; ++unit) line.silence(unit, true);
  ASSERT_TRUE(line.run_until([&] { return line.count_asleep() == 6; }));
  EXPECT_FALSE(line.asleep(0) || line.asleep(1));
  // Each of the 6 is silent twice. At first nobody knows; but before each second try the others had a turn.
  std::vector<bool> heard(2, false);
  int deaths = 0;
  for (const Asked& each : line.asked()) {
    if (each.at < begin) continue;
    if (each.answered) heard[each.unit] = true;
    if (!each.dead) continue;
    ++deaths;
    EXPECT_TRUE(heard[0] && heard[1]) << "death " << deaths;
    heard.assign(2, false);
  }
  EXPECT_EQ(deaths, 6);
  EXPECT_LE(longest_pause(line.instants_of(0, begin)), kPeriod + 6 * kTimeout + 8 * kAnswer);
}

TEST(PollSchedule, WhenTwoBehindAGatewayAreDead_ThenTheyTakeAQuarterOfItsTimeAtMost) {
  CountedLine line(4, false);
  line.run_for(1s);
  for (const std::size_t dead : {2u, 3u}) {
    line.silence(dead, true);
    ASSERT_TRUE(line.run_until([&] { return line.asleep(dead); }));
  }
  const auto begin = line.now();
  line.run_for(30s);
  std::vector<Clock::time_point> tries = line.instants_of(2, begin);
  std::ranges::copy(line.instants_of(3, begin), std::back_inserter(tries));
  std::ranges::sort(tries);
  ASSERT_GE(tries.size(), 20u);
  for (std::size_t i = 1; i < tries.size(); ++i) EXPECT_GE(tries[i] - tries[i - 1], 4 * kTimeout);
  for (const std::size_t other : {0u, 1u})
    EXPECT_LE(longest_pause(line.instants_of(other, begin)), kPeriod + kTimeout + 4 * kAnswer);
  EXPECT_EQ(line.lost_connections(), 0) << "a dead unit is no reason to connect again";
  line.silence(2, false);
  const auto back = line.now();
  ASSERT_TRUE(line.run_until([&] { return !line.asleep(2); }));
  EXPECT_LE(line.now() - back, kRetryAtMost + 4 * kTimeout + kAnswer);
}

TEST(PollSchedule, WhenTwoAreSilentInARow_ThenItIsTheConnectionUnlessTheLineIsSerial) {
  for (const bool serial : {false, true}) {
    CountedLine line(3, serial);
    line.silence(0, true);
    line.silence(1, true);
    ASSERT_TRUE(line.run_until([&] { return line.asked().size() == 2; }));
    EXPECT_EQ(line.lost_connections(), serial ? 0 : 1);
  }
}

}  // namespace
}  // namespace stepwright::modbus::client
