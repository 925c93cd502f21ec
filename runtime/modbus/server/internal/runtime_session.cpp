#include "runtime/modbus/server/internal/runtime_session.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/host/busy.h"
#include "runtime/modbus/map/build_map.h"

namespace stepwright::modbus::server::internal {
namespace {

using pdu::Exception;
using std::chrono::milliseconds;

constexpr milliseconds kRetryPeriod{200};
constexpr milliseconds kTurn{50};
constexpr milliseconds kPatience{2'000};
// Writes that the runtime has and has not answered: fewer than it takes.
constexpr std::size_t kMostUnderWay = 64;
constexpr int kIntervals = 3;

std::int64_t to_ns(Clock::time_point at) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(at.time_since_epoch()).count();
}

std::uint64_t random_number() {
  std::random_device source;
  const std::uint64_t high = source();
  return (high << 32 | source()) | 1u;
}

// What a client is told of a refusal.
Exception exception_of(const service::Reply& reply) {
  if (reply.accepted()) return Exception::None;
  const bool busy =
      std::any_of(reply.problems.begin(), reply.problems.end(),
                  [](const result::Diagnostic& problem) { return problem.code == host::kBusy; });
  return busy ? Exception::DeviceBusy : Exception::DeviceFailure;
}

}  // namespace

RuntimeSession::RuntimeSession(const RuntimeDataOptions& options, const News& news, Exchange& exchange)
    : options_(options), news_(news), exchange_(exchange), client_(random_number()) {}

void RuntimeSession::run() {
  while (!exchange_.quit.load()) {
    if (attach()) {
      attend();
      detach();
    } else {
      fail_queued();
      exchange_.work.wait(std::chrono::nanoseconds(kRetryPeriod).count());
    }
  }
}

bool RuntimeSession::attach() {
  const auto role = options_.writes ? service::Role::Controller : service::Role::Observer;
  auto opened = service::Connection::open(options_.socket, {.role = role, .name = "modbus-server"});
  if (!opened) {
    if (!std::exchange(told_absent_, true)) news_("absent", "the runtime does not answer", opened.error());
    return false;
  }
  told_absent_ = false;
  connection_ = std::move(*opened);
  sequence_ = 0;
  changed_ = Clock::now();
  news_("attached", "attends the runtime at " + options_.socket.string(), {});
  return true;
}

void RuntimeSession::attend() {
  while (!exchange_.quit.load() && !connection_->closed()) {
    std::array<pollfd, 2> entries{
        {{connection_->descriptor(), POLLIN, 0}, {exchange_.work.descriptor(), POLLIN, 0}}};
    poll(entries.data(), entries.size(), static_cast<int>(kTurn.count()));
    if (entries[1].revents != 0) exchange_.work.clear();
    while (auto message = connection_->receive(milliseconds(0))) hear(*message);
    send_writes();
    expire(Clock::now());
  }
}

void RuntimeSession::hear(const service::Message& message) {
  if (const auto* status = std::get_if<host::RuntimeStatus>(&message)) return hear_status(*status);
  const auto* reply = std::get_if<service::Reply>(&message);
  if (reply == nullptr || reply->client != client_) return;
  const auto found = under_way_.find(reply->id);
  if (found == under_way_.end()) return;
  const std::uint64_t ticket = found->second.ticket;
  under_way_.erase(found);
  answer(ticket, exception_of(*reply));
}

void RuntimeSession::hear_status(const host::RuntimeStatus& status) {
  const auto now = Clock::now();
  if (status.program_digest != digest_ && (refused_.empty() || status.program_digest != refused_))
    load(status.program_digest);
  const std::uint64_t sequence = connection_->snapshots().sequence();
  if (std::exchange(sequence_, sequence) != sequence) changed_ = now;
  auto patience = options_.stale_after;
  for (const host::TaskStatus& task : status.tasks)
    patience = std::max(patience, milliseconds(kIntervals * std::int64_t{task.interval_us} / 1'000));
  if (options_.real_time && now - changed_ > patience) return;  // the scan does not come back
  exchange_.good_until_ns.store(to_ns(now + options_.stale_after), std::memory_order_release);
}

void RuntimeSession::load(const std::string& digest) {
  digest_.clear();
  refused_.clear();
  publish(nullptr);
  if (digest.empty()) return;
  auto container = read_program(digest);
  if (!container) return;  // it changed meanwhile: the next status says to what
  auto info = reader::ProgramInfo::read(*container);
  if (!info) {
    refused_ = digest;
    return news_("refused", "the program of the runtime cannot be read", info.error());
  }
  map::BuiltMap built = map::build_map(*info, options_.map);
  digest_ = digest;
  news_("program", "serves the program " + digest.substr(0, 12), built.problems);
  publish(std::make_shared<Program>(Program{connection_, std::move(built.map), digest}));
}

result::Result<std::vector<std::byte>> RuntimeSession::read_program(const std::string& digest) {
  std::vector<std::byte> container;
  do {
    auto reply = connection_->call(service::ReadProgram{container.size()}, kPatience);
    if (!reply) return result::forward(reply);
    if (reply->digest != digest || reply->data.empty())
      return result::fail("R0002", {}, "another program was loaded while this one was read");
    container.insert(container.end(), reply->data.begin(), reply->data.end());
    if (container.size() >= reply->total_bytes) return container;
  } while (true);
}

void RuntimeSession::publish(std::shared_ptr<const Program> program) {
  {
    const std::lock_guard lock(exchange_.mutex);
    exchange_.program.swap(program);
  }
  exchange_.changes.fetch_add(1, std::memory_order_release);
}

void RuntimeSession::send_writes() {
  while (under_way_.size() < kMostUnderWay) {
    QueuedWrite write;
    {
      const std::lock_guard lock(exchange_.mutex);
      if (exchange_.writes.empty()) return;
      write = std::move(exchange_.writes.front());
      exchange_.writes.pop_front();
    }
    const std::uint64_t id = ++last_id_;
    under_way_.emplace(id, UnderWay{write.ticket, write.deadline});
    // A connection that fails here ends the attendance, which answers what is under way.
    connection_->send(service::Request{client_, id, service::WriteBlock{std::move(write.block)}});
  }
}

void RuntimeSession::expire(Clock::time_point now) {
  // Ids count, and the queue is one: the oldest come first.
  while (!under_way_.empty() && under_way_.begin()->second.deadline <= now) {
    answer(under_way_.begin()->second.ticket, Exception::DeviceFailure);
    under_way_.erase(under_way_.begin());
  }
  std::vector<std::uint64_t> late;
  {
    const std::lock_guard lock(exchange_.mutex);
    while (!exchange_.writes.empty() && exchange_.writes.front().deadline <= now) {
      late.push_back(exchange_.writes.front().ticket);
      exchange_.writes.pop_front();
    }
  }
  for (const std::uint64_t ticket : late) answer(ticket, Exception::DeviceFailure);
}

void RuntimeSession::answer(std::uint64_t ticket, Exception exception) {
  {
    const std::lock_guard lock(exchange_.mutex);
    exchange_.written.push_back({ticket, exception});
  }
  exchange_.done.notify();
}

void RuntimeSession::detach() {
  exchange_.good_until_ns.store(0, std::memory_order_release);
  digest_.clear();
  refused_.clear();
  publish(nullptr);
  for (const auto& [id, write] : under_way_) answer(write.ticket, Exception::DeviceFailure);
  under_way_.clear();
  fail_queued();
  if (!exchange_.quit.load()) news_("lost", "the runtime is gone", {});
  connection_.reset();
}

void RuntimeSession::fail_queued() {
  std::deque<QueuedWrite> writes;
  {
    const std::lock_guard lock(exchange_.mutex);
    writes.swap(exchange_.writes);
  }
  for (const QueuedWrite& write : writes) answer(write.ticket, Exception::DeviceFailure);
}

}  // namespace stepwright::modbus::server::internal
