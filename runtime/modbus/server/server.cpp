#include "runtime/modbus/server/server.h"

#include <sys/epoll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace stepwright::modbus::server {
namespace {

using std::chrono::milliseconds;

// A ticket is a count and the slot of its session: a late answer finds another ticket there.
constexpr std::uint64_t kSlotBits = 16;
constexpr std::uint64_t kSlotMask = (1u << kSlotBits) - 1;
// What epoll gives back of everything that is no session.
constexpr std::uint64_t kAcceptor = 1ull << 63;
constexpr std::uint64_t kData = 1ull << 62;
constexpr std::uint64_t kWatched = 1ull << 61;
constexpr milliseconds kCheckPeriod{250};
constexpr int kEvents = 64;
// Of one acceptor in one turn, so that a flood of newcomers leaves time for those who are in.
constexpr int kAdmissions = 32;

bool add_to(int epoll, int descriptor, std::uint64_t key, std::uint32_t events) {
  epoll_event event{};
  event.events = events;
  event.data.u64 = key;
  return epoll_ctl(epoll, EPOLL_CTL_ADD, descriptor, &event) == 0;
}

}  // namespace

result::Result<std::unique_ptr<Server>> Server::create(ServerOptions options, ProcessData& data) {
  const int epoll = epoll_create1(EPOLL_CLOEXEC);
  if (epoll < 0 || !add_to(epoll, data.descriptor(), kData, EPOLLIN)) {
    const int error = errno;
    if (epoll >= 0) close(epoll);
    return result::fail("R0101", {}, std::string("the system gives no descriptor: ") + std::strerror(error));
  }
  return std::unique_ptr<Server>(new Server(std::move(options), data, epoll));
}

Server::Server(ServerOptions options, ProcessData& data, int epoll)
    : options_(std::move(options)),
      data_(data),
      access_(options_.clients),
      identity_(options_),
      shared_{options_, access_, identity_, data_, figures_},
      epoll_(epoll),
      now_(Clock::now()),
      next_check_(now_ + kCheckPeriod) {}

Server::~Server() {
  visitors_.clear();  // their transports before their acceptors
  close(epoll_);
}

void Server::add(std::unique_ptr<Acceptor> acceptor) {
  if (acceptor->descriptor() >= 0)
    add_to(epoll_, acceptor->descriptor(), kAcceptor | acceptors_.size(), EPOLLIN);
  acceptors_.push_back(std::move(acceptor));
}

void Server::watch(int descriptor) {
  add_to(epoll_, descriptor, kWatched, EPOLLIN);
}

void Server::turn(milliseconds timeout) {
  std::array<epoll_event, kEvents> events;
  const int count = epoll_wait(epoll_, events.data(), kEvents, static_cast<int>(timeout.count()));
  now_ = Clock::now();
  for (int i = 0; i < count; ++i) {
    const std::uint64_t key = events[static_cast<std::size_t>(i)].data.u64;
    if (key == kData) {
      take_written();
    } else if ((key & kAcceptor) != 0) {
      Acceptor& acceptor = *acceptors_[key & ~kAcceptor];
      admit(acceptor);
      figures_.turned_away += acceptor.take_refused();
    } else if (key == kWatched) {
      interrupted_ = true;
    } else {
      serve(key, events[static_cast<std::size_t>(i)].events);
    }
  }
  if (now_ >= next_check_) check_all();
}

void Server::run_for(milliseconds time) {
  interrupted_ = false;
  const auto end = now_ + time;
  do {
    turn(time);
  } while (!interrupted_ && now_ < end);
}

void Server::serve(std::uint64_t key, std::uint32_t events) {
  Visitor& visitor = visitors_[key & kSlotMask];
  // It may have left earlier in this turn.
  if (visitor.session == nullptr || visitor.session->ticket() != key) return;
  Session& session = *visitor.session;
  if ((events & (EPOLLERR | EPOLLHUP)) != 0) return leave(key);
  const std::uint64_t before = figures_.requests;
  if ((events & EPOLLOUT) != 0) session.writable(now_);
  if ((events & EPOLLIN) != 0 && !session.done()) session.readable(now_);
  if (figures_.requests != before)
    figures_.service_time.record(std::chrono::nanoseconds(Clock::now() - now_).count());
  settle(visitor);
}

// What the session waits for now; or it leaves.
void Server::settle(Visitor& visitor) {
  Session& session = *visitor.session;
  if (session.done()) return leave(session.ticket());
  const std::uint32_t events = (session.wants_read() ? std::uint32_t{EPOLLIN} : 0u) |
                               (session.wants_write() ? std::uint32_t{EPOLLOUT} : 0u);
  if (events == visitor.events) return;
  visitor.events = events;
  epoll_event event{};
  event.events = events;
  event.data.u64 = session.ticket();
  epoll_ctl(epoll_, EPOLL_CTL_MOD, session.transport().descriptor(), &event);
}

void Server::take_written() {
  data_.clear();
  while (const auto done = data_.take_written()) {
    Visitor& visitor = visitors_[done->ticket & kSlotMask];
    if (visitor.session == nullptr || visitor.session->ticket() != done->ticket) continue;
    visitor.session->written(done->exception, now_);
    settle(visitor);
  }
}

void Server::admit(Acceptor& acceptor) {
  for (int i = 0; i < kAdmissions; ++i) {
    if (figures_.connections >= options_.max_connections) {
      ++figures_.turned_away;
      return acceptor.turn_away();
    }
    auto transport = acceptor.admit();
    if (transport == nullptr) return;
    enter(std::move(transport));
  }
}

void Server::enter(std::unique_ptr<Transport> transport) {
  const std::string address = transport->address();
  const auto here = by_address_.find(address);
  if (here != by_address_.end() && here->second >= options_.max_per_address) {
    ++figures_.turned_away;
    return;
  }
  std::size_t slot = visitors_.size();
  if (free_.empty()) {
    visitors_.emplace_back();
  } else {
    slot = free_.back();
    free_.pop_back();
  }
  const std::uint64_t ticket = ++last_ticket_ << kSlotBits | slot;
  const int descriptor = transport->descriptor();
  Visitor& visitor = visitors_[slot];
  visitor.session = std::make_unique<Session>(ticket, std::move(transport), shared_, now_);
  visitor.events = EPOLLIN;
  visitor.address = address;
  if (!address.empty()) ++by_address_[address];
  ++figures_.connections;
  ++figures_.accepted;
  if (!add_to(epoll_, descriptor, ticket, EPOLLIN)) leave(ticket);
}

void Server::leave(std::uint64_t ticket) {
  const std::size_t slot = ticket & kSlotMask;
  Visitor& visitor = visitors_[slot];
  const auto found = by_address_.find(visitor.address);
  if (found != by_address_.end() && --found->second == 0) by_address_.erase(found);
  epoll_ctl(epoll_, EPOLL_CTL_DEL, visitor.session->transport().descriptor(), nullptr);
  visitor.session.reset();
  free_.push_back(slot);
  --figures_.connections;
}

void Server::check_all() {
  next_check_ = now_ + kCheckPeriod;
  for (Visitor& visitor : visitors_) {
    if (visitor.session == nullptr) continue;
    visitor.session->check(now_);
    if (visitor.session->done()) leave(visitor.session->ticket());
  }
}

std::span<const std::byte> Server::Identity::identification(std::uint8_t object) const {
  if (object >= options_.identification.size()) return {};
  const std::string& text = options_.identification[object];
  return std::as_bytes(std::span(text).first(std::min<std::size_t>(text.size(), 200)));
}

}  // namespace stepwright::modbus::server
