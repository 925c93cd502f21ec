#include "runtime/modbus/client/poll/connection_worker.h"

#include <algorithm>
#include <utility>

namespace stepwright::modbus::client {
namespace {

using master::Fault;
using master::Outcome;
using std::chrono::milliseconds;

constexpr milliseconds kFirstPause{20};

bool is_gone(const Outcome& outcome) {
  return outcome.fault == Fault::NotConnected || outcome.fault == Fault::ConnectionLost;
}

// A gateway's word for a unit that does not answer it (Modbus Application Protocol V1.1b3, section 7).
bool is_silence(const Outcome& outcome) {
  constexpr std::uint8_t kPathUnavailable = 10;
  constexpr std::uint8_t kTargetSilent = 11;
  return outcome.fault == Fault::Timeout || outcome.fault == Fault::BadAnswer ||
         (outcome.fault == Fault::Exception &&
          (outcome.exception == kPathUnavailable || outcome.exception == kTargetSilent));
}

Quality quality_of(const Outcome& outcome) {
  if (outcome.fault == Fault::Exception && !is_silence(outcome)) return Quality::DeviceFailure;
  return is_gone(outcome) ? Quality::NotConnected : Quality::CommFailure;
}

// Worth another try with fewer tags: one address of the request may be wrong.
bool is_refused_address(const Outcome& outcome) {
  return outcome.fault == Fault::Exception && (outcome.exception == 2 || outcome.exception == 3);
}

}  // namespace

ConnectionWorker::ConnectionWorker(std::vector<Device> devices, master::Master master,
                                   const ClientSettings& settings)
    : cache_(std::move(devices), Clock::now()),
      master_(std::move(master)),
      settings_(settings),
      schedule_(cache_.devices(), Clock::now(),
                std::holds_alternative<master::SerialEndpoint>(cache_.devices().front().endpoint)),
      words_(master::kMaxReadRegisters),
      bits_(master::kMaxReadBits) {
  for (const Device& device : cache_.devices()) {
    between_ = std::max(between_, device.pause);
    const std::uint32_t most = device.requests_per_connection;
    if (most > 0) most_requests_ = most_requests_ == 0 ? most : std::min(most_requests_, most);
  }
  thread_ = std::thread([this] { run(); });
}

ConnectionWorker::~ConnectionWorker() {
  {
    const std::scoped_lock lock(mutex_);
    stop_ = true;
  }
  news_.notify_all();
  thread_.join();
}

void ConnectionWorker::set_outputs(std::span<const std::byte> area) {
  {
    const std::scoped_lock lock(mutex_);
    if (std::ranges::equal(outputs_, area)) return;
    outputs_.assign(area.begin(), area.end());
    new_outputs_ = true;
    written_ = false;
  }
  news_.notify_all();
}

void ConnectionWorker::take_outputs() {
  std::unique_lock lock(mutex_);
  if (!new_outputs_) return;
  new_outputs_ = false;
  const std::vector<std::byte> area = outputs_;
  lock.unlock();
  for (Unit& unit : schedule_.units()) unit.writes().set_outputs(area);
  cache_.outputs_are(area);
}

void ConnectionWorker::wait_until(Clock::time_point at) {
  std::unique_lock lock(mutex_);
  // A wait without end would overflow some clocks.
  const auto latest = Clock::now() + std::chrono::seconds(1);
  news_.wait_until(lock, std::min(at, latest), [this] { return stop_ || new_outputs_; });
}

void ConnectionWorker::run() {
  while (true) {
    {
      const std::scoped_lock lock(mutex_);
      if (stop_) return;
    }
    take_outputs();
    if (used_up()) {
      goes_on_ = true;
      master_.close();
      connect_at_ = Clock::now() + between_;
    }
    if (!master_.connected() && !connect()) continue;
    const PollSchedule::Job job = schedule_.next(Clock::now());
    switch (job.turn) {
      case PollSchedule::Turn::Wait:
        wait_until(job.at);
        break;
      case PollSchedule::Turn::Read:
        read_group(job.unit, *schedule_.units()[job.unit].next_group());
        break;
      case PollSchedule::Turn::Write:
        write_next(job.unit);
        break;
      case PollSchedule::Turn::Probe:
        probe(job.unit);
        break;
    }
    // What was lost with its connection has the first request of the next one.
    if (master_.connected()) schedule_.ended(job.turn);
    const bool all = std::ranges::all_of(schedule_.units(),
                                         [](Unit& unit) { return unit.asleep() || unit.writes().clean(); });
    const std::scoped_lock lock(mutex_);
    written_ = all && !new_outputs_ && (master_.connected() || goes_on_);
  }
}

bool ConnectionWorker::used_up() const {
  return most_requests_ > 0 && requests_ >= most_requests_ && master_.connected();
}

bool ConnectionWorker::repeats(const Outcome& outcome) const {
  return is_gone(outcome) && answered_;
}

bool ConnectionWorker::connect() {
  auto now = Clock::now();
  if (now < connect_at_) {
    wait_until(connect_at_);
    return false;
  }
  const Outcome outcome = master_.connect();
  now = Clock::now();
  requests_ = 0;
  answered_ = false;
  const bool goes_on = std::exchange(goes_on_, false);
  connect_at_ = now + std::max(pause_, between_);
  pause_ = std::clamp(2 * pause_, kFirstPause, std::max(kFirstPause, settings_.reconnect_at_most));
  schedule_.connecting();
  std::vector<Unit>& units = schedule_.units();
  if (!outcome.good()) {
    for (std::size_t i = 0; i < units.size(); ++i)
      cache_.offline(i, Quality::NotConnected, outcome.text(), now);
    return false;
  }
  if (goes_on) return true;
  schedule_.begin_anew(now);
  for (std::size_t i = 0; i < units.size(); ++i) {
    // There is nothing to ask it, and what is to be written may come later.
    if (units[i].next_group() == nullptr && !units[i].asleep()) cache_.online(i, now);
  }
  return true;
}

Outcome ConnectionWorker::read(Unit& unit, const ReadRequest& request) {
  master_.set_timeout(unit.device().timeout);
  if (const Outcome known = master_.select_unit(unit.device().unit); !known.good()) return known;
  const std::span<std::uint16_t> words(words_.data(), request.count);
  if (!is_bits(request.table)) {
    const auto table = request.table == Table::HoldingRegisters ? master::RegisterTable::Holding
                                                                : master::RegisterTable::Input;
    return master_.read_registers(table, request.first, words);
  }
  const auto table =
      request.table == Table::Coils ? master::BitTable::Coils : master::BitTable::DiscreteInputs;
  return master_.read_bits(table, request.first, {bits_.data(), request.count});
}

void ConnectionWorker::read_group(std::size_t index, GroupPoll& group) {
  Unit& unit = schedule_.units()[index];
  if (group.next == 0) group.before = std::exchange(group.began, Clock::now());
  for (std::size_t& i = group.next; i < group.requests.size();) {
    if (used_up()) return;  // the rest on the next connection
    const ReadRequest& request = group.requests[i];
    const auto sent = Clock::now();
    const Outcome outcome = read(unit, request);
    if (outcome.good()) {
      if (is_bits(request.table)) words_.assign(bits_.begin(), bits_.end());
      cache_.read(index, request, {words_.data(), request.count}, Clock::now());
    } else if (auto halves = halves_of(request, cache_.inputs(index));
               is_refused_address(outcome) && !halves.empty()) {
      judge(index, outcome, sent, false);
      group.requests[i] = std::move(halves[0]);
      group.requests.insert(group.requests.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                            std::move(halves[1]));
      continue;
    } else if (!repeats(outcome)) {
      cache_.not_read(index, request.tags, quality_of(outcome), outcome.text());
    }
    if (!judge(index, outcome, sent, false)) return;  // due as before, unless it sleeps now
    ++i;
  }
  group.next = 0;
  const std::uint64_t missed = group.advance(Clock::now());
  const auto at = static_cast<std::size_t>(&group - unit.groups().data());
  cache_.count(index, [&](DeviceCounters&, std::vector<GroupStatus>& groups) {
    ++groups[at].turns;
    groups[at].overruns += missed;
    if (group.before != Clock::time_point{})
      groups[at].period.record(std::chrono::nanoseconds(group.began - group.before).count());
  });
}

Outcome ConnectionWorker::send(Unit& unit, const WriteRequest& request) {
  master_.set_timeout(unit.device().timeout);
  if (const Outcome known = master_.select_unit(unit.device().unit); !known.good()) return known;
  const bool single = request.words.size() == 1 && unit.device().single_writes;
  if (request.mask != 0) {
    return master_.mask_register(request.first, static_cast<std::uint16_t>(~request.mask),
                                 request.words[0] & request.mask);
  }
  if (is_bits(request.table)) {
    if (single) return master_.write_coil(request.first, request.words[0] != 0);
    const std::vector<std::uint8_t> bits(request.words.begin(), request.words.end());
    return master_.write_coils(request.first, bits);
  }
  if (single) return master_.write_register(request.first, request.words[0]);
  return master_.write_registers(request.first, request.words);
}

void ConnectionWorker::write_next(std::size_t index) {
  Unit& unit = schedule_.units()[index];
  const auto request = unit.writes().next(Clock::now());
  if (!request) return;
  const auto sent = Clock::now();
  const Outcome outcome = send(unit, *request);
  const auto now = Clock::now();
  const std::vector<std::uint32_t> tags = unit.writes().tags_of(*request);
  // A request without an answer is repeated at once; one that is refused, later.
  const bool refused = !outcome.good() && !is_silence(outcome);
  if (outcome.good() || refused) unit.writes().done(*request, outcome.good(), now);
  if (outcome.good()) {
    std::vector<std::uint8_t> exceeded;
    for (const std::uint32_t tag : tags) exceeded.push_back(unit.writes().exceeded(tag));
    cache_.written(index, tags, exceeded, now);
  } else if (!repeats(outcome)) {
    cache_.not_written(index, tags, quality_of(outcome), outcome.text(), now);
  }
  judge(index, outcome, sent, true);
}

void ConnectionWorker::probe(std::size_t index) {
  Unit& unit = schedule_.units()[index];
  GroupPoll* const group = unit.next_group();
  if (group != nullptr) {
    const ReadRequest& request = group->requests.front();
    const auto sent = Clock::now();
    const Outcome outcome = read(unit, request);
    if (judge(index, outcome, sent, false)) group->due = Clock::now();
    return;
  }
  unit.writes().forget();
  if (unit.writes().due()) {
    write_next(index);
  } else {
    unit.answered();  // nothing is to be said to it
  }
}

bool ConnectionWorker::judge(std::size_t index, const Outcome& outcome, Clock::time_point sent, bool write) {
  const auto now = Clock::now();
  ++requests_;
  cache_.count(index, [&](DeviceCounters& counters, std::vector<GroupStatus>&) {
    ++counters.requests;
    counters.writes += write ? 1 : 0;
    counters.timeouts += outcome.fault == Fault::Timeout ? 1 : 0;
    counters.exceptions += outcome.fault == Fault::Exception ? 1 : 0;
    counters.bad_answers += outcome.fault == Fault::BadAnswer ? 1 : 0;
    if (outcome.good()) counters.answer.record(std::chrono::nanoseconds(now - sent).count());
  });
  if (is_silence(outcome)) {
    on_silence(index, outcome.text(), sent, now);
    return false;
  }
  if (is_gone(outcome)) {
    on_lost(outcome.text(), now);
    return false;
  }
  schedule_.answered(index, now);
  cache_.online(index, now);
  answered_ = true;
  pause_ = kFirstPause;
  return true;
}

void ConnectionWorker::on_silence(std::size_t index, const std::string& error, Clock::time_point sent,
                                  Clock::time_point now) {
  const PollSchedule::Silence silence = schedule_.silent(index, sent, now);
  if (silence.dead) cache_.offline(index, Quality::CommFailure, error, now);
  if (!silence.of_connection && !(silence.dead && master_.moved())) return;
  master_.close();
  cache_.count(index,
               [](DeviceCounters& counters, std::vector<GroupStatus>&) { ++counters.connection_losses; });
}

void ConnectionWorker::on_lost(const std::string& error, Clock::time_point now) {
  master_.close();
  for (std::size_t i = 0; i < cache_.devices().size(); ++i) {
    if (!answered_) cache_.offline(i, Quality::NotConnected, error, now);
    cache_.count(i,
                 [](DeviceCounters& counters, std::vector<GroupStatus>&) { ++counters.connection_losses; });
  }
}

}  // namespace stepwright::modbus::client
