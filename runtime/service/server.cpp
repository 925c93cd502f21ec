#include "runtime/service/server.h"

#include <poll.h>

#include <algorithm>
#include <list>
#include <utility>
#include <vector>

#include "runtime/service/internal/event_history.h"
#include "runtime/service/internal/listener.h"
#include "runtime/service/internal/process_watch.h"
#include "runtime/service/internal/request_handler.h"
#include "runtime/service/internal/session.h"
#include "runtime/service/internal/supervisor_watch.h"
#include "runtime/service/messages.h"

namespace stepwright::service {
namespace {

using namespace internal;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::size_t kMaxClients = 16;

// Tickets of commands that the service itself gives; the request handler counts from 1.
constexpr std::uint64_t kOwnTicket = 0;

}  // namespace

struct Server::State {
  State(Listener l, host::RuntimePort& p, const ServerConfig& config)
      : listener(std::move(l)),
        port(p),
        handler(p, events),
        supervisor(config.supervisor_lost_after),
        on_program(config.on_program),
        program(p.status().program_digest),
        process(config.version),
        observer(config.observer == nullptr ? nobody : *config.observer) {}

  void accept_clients();
  void take_news();
  void serve(Session& session);
  void receive(Session& session, const Message& message);
  void greet(Session& session, const Hello& hello);
  void request(Session& session, const Request& request);
  void reload(Session& session, const Request& request);
  void push_events(Session& session);
  void push_status();
  void watch_supervisor();
  void watch_program();
  void forget_closed();
  std::size_t clients() const;

  Listener listener;
  host::RuntimePort& port;
  EventHistory events;
  RequestHandler handler;
  SupervisorWatch supervisor;
  std::function<void(std::span<const std::byte>)> on_program;
  std::string program;  // its digest, as it was last looked at
  ProcessWatch process;
  ServiceObserver nobody;
  ServiceObserver& observer;
  std::list<Session> sessions;
  std::uint64_t last_session = 0;
  bool status_due = false;
  Clock::time_point status_at{};
};

Server::Server(std::unique_ptr<State> state) : state_(std::move(state)) {}
Server::~Server() = default;

result::Result<std::unique_ptr<Server>> Server::create(const ServerConfig& config, host::RuntimePort& port) {
  auto listener = Listener::bind(config.socket);
  if (!listener) return result::forward(listener);
  return std::unique_ptr<Server>(new Server(std::make_unique<State>(std::move(*listener), port, config)));
}

void Server::run(int stop_descriptor) {
  pollfd stop{stop_descriptor, POLLIN, 0};
  while (poll(&stop, 1, 0) == 0) turn(kStatusPeriod, stop_descriptor);
}

void Server::turn(milliseconds timeout, int stop_descriptor) {
  State& s = *state_;
  std::vector<pollfd> entries{
      {stop_descriptor, POLLIN, 0}, {s.listener.descriptor(), POLLIN, 0}, {s.port.descriptor(), POLLIN, 0}};
  for (const Session& session : s.sessions) {
    const int wanted = POLLIN | (session.wants_to_write() ? POLLOUT : 0);
    entries.push_back({session.descriptor(), static_cast<short>(wanted), 0});
  }
  const auto until_status = std::chrono::ceil<milliseconds>(s.status_at + kStatusPeriod - Clock::now());
  const auto wait = std::clamp(std::min(timeout, until_status), milliseconds(0), timeout);
  poll(entries.data(), entries.size(), static_cast<int>(wait.count()));

  std::size_t next = 3;
  for (Session& session : s.sessions) {
    const short ready = entries[next++].revents;
    if ((ready & (POLLIN | POLLHUP | POLLERR)) != 0) {
      session.read();
      s.serve(session);
    }
  }
  if (entries[1].revents != 0) s.accept_clients();
  s.take_news();
  s.watch_supervisor();
  for (Session& session : s.sessions) s.push_events(session);
  if (s.status_due || Clock::now() - s.status_at >= kStatusPeriod) s.push_status();
  for (Session& session : s.sessions) {
    if (session.wants_to_write()) session.write();
  }
  s.forget_closed();
}

void Server::set_supervisor_lost_after(milliseconds lost_after) {
  state_->supervisor.set_lost_after(lost_after);
}

void Server::State::forget_closed() {
  const std::size_t known = clients();
  for (const Session& session : sessions) {
    if (session.closed() && session.greeted) observer.on_client(session.name, session.role, false);
  }
  sessions.remove_if([](const Session& session) { return session.closed(); });
  if (clients() != known) status_due = true;
}

std::size_t Server::State::clients() const {
  return static_cast<std::size_t>(std::count_if(sessions.begin(), sessions.end(),
                                                [](const Session& session) { return session.greeted; }));
}

void Server::State::accept_clients() {
  while (true) {
    Descriptor socket = listener.accept();
    if (!socket.ok()) return;
    // One too many is closed at once: it goes out of scope.
    if (sessions.size() < kMaxClients) sessions.emplace_back(++last_session, std::move(socket));
  }
}

void Server::State::take_news() {
  port.clear();
  bool completed = false;
  while (auto event = port.take_event()) {
    observer.on_event(*event);
    // A rollback brings a program that no command has loaded.
    completed = completed || event->kind == host::EventKind::RolledBack;
    events.append(std::move(*event));
    status_due = true;
  }
  while (auto completion = port.take_completion()) {
    status_due = true;
    completed = true;
    auto answer = handler.complete(*completion);
    if (!answer) continue;
    for (Session& session : sessions) {
      if (session.number() == answer->session) session.send(std::move(answer->reply));
    }
  }
  if (completed) watch_program();
}

void Server::State::watch_program() {
  if (!on_program) return;
  std::string now = port.status().program_digest;
  if (now == program) return;
  program = std::move(now);
  on_program(port.program());
}

void Server::State::serve(Session& session) {
  while (auto message = session.next()) receive(session, *message);
}

void Server::State::receive(Session& session, const Message& message) {
  if (const auto* hello = std::get_if<Hello>(&message); hello != nullptr && !session.greeted) {
    return greet(session, *hello);
  }
  if (session.greeted) {
    if (const auto* asked = std::get_if<Request>(&message)) return request(session, *asked);
    const auto* life = std::get_if<SupervisorLife>(&message);
    if (life != nullptr && session.role == Role::Controller) {
      if (life->alive) supervisor.heard(Clock::now());
      return;
    }
  }
  // Anything else has no place here: this is no client of ours.
  session.close();
}

void Server::State::greet(Session& session, const Hello& hello) {
  if (hello.name.size() > host::kMaxNameBytes) return session.close();
  if (hello.version != kProtocolVersion) {
    session.welcome(port.snapshot_descriptor());  // it says which version is spoken here
    return session.close();
  }
  session.greeted = true;
  session.role = hello.role;
  session.next_event = hello.first_event == 0 ? events.last() + 1 : hello.first_event;
  session.name = hello.name;
  observer.on_client(session.name, session.role, true);
  session.welcome(port.snapshot_descriptor());
  host::RuntimeStatus status = port.status();
  process.fill(status.process, clients());
  session.send(status);
}

void Server::State::request(Session& session, const Request& request) {
  const bool reads = std::holds_alternative<ReadProgram>(request.body) ||
                     std::holds_alternative<ResendEvents>(request.body) ||
                     std::holds_alternative<ReadForces>(request.body) ||
                     std::holds_alternative<ReadRecording>(request.body);
  if (session.role != Role::Controller && !reads) {
    Reply reply;
    reply.client = request.client;
    reply.id = request.id;
    auto failed = result::fail("R0002", {}, "an observer may not change anything");
    reply.problems = std::move(failed.value());
    return session.send(reply);
  }
  // Who starts with a barrier or acknowledges an event is a supervisor, even if it dies before its first
  // heartbeat.
  const auto* start = std::get_if<Start>(&request.body);
  if ((start != nullptr && start->barrier) || std::holds_alternative<Acknowledge>(request.body)) {
    supervisor.heard(Clock::now());
  }
  if (std::holds_alternative<Reload>(request.body)) return reload(session, request);
  auto reply = handler.handle(session.number(), request);
  if (!reply) return;
  if (!reply->accepted()) observer.on_refusal(session.name, request, *reply);
  if (std::holds_alternative<ResendEvents>(request.body) && reply->accepted()) {
    session.next_event = std::min(session.next_event, reply->offset);
  }
  session.send(std::move(*reply));
}

// Not remembered: reading a file twice does no harm.
void Server::State::reload(Session& session, const Request& request) {
  Reply reply;
  reply.client = request.client;
  reply.id = request.id;
  reply.problems = observer.on_reload();
  session.send(reply);
}

void Server::State::push_events(Session& session) {
  if (!session.greeted) return;
  while (session.keeps_up() && !session.closed()) {
    const host::StepEvent* event = events.at_or_after(session.next_event);
    if (event == nullptr) return;
    session.send(*event);
    session.next_event = event->sequence + 1;
  }
}

void Server::State::push_status() {
  status_due = false;
  status_at = Clock::now();
  host::RuntimeStatus status = port.status();
  process.fill(status.process, clients());
  observer.on_status(status);
  for (Session& session : sessions) {
    if (session.greeted && session.keeps_up()) session.send(status);
  }
}

void Server::State::watch_supervisor() {
  const auto change = supervisor.check(Clock::now());
  if (change == SupervisorWatch::Change::None) return;
  observer.on_supervisor(change == SupervisorWatch::Change::Came);
  host::Command command;
  command.ticket = kOwnTicket;
  command.kind = change == SupervisorWatch::Change::Came ? host::CommandKind::SupervisorAlive
                                                         : host::CommandKind::SupervisorLost;
  if (!port.submit(command)) supervisor.repeat();
}

}  // namespace stepwright::service
