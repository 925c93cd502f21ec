#include "runtime/service/server.h"

#include <poll.h>

#include <algorithm>
#include <list>
#include <new>
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

// A process may have as many of them as are free (16 if it is alone), so that another finds room.
constexpr std::size_t kMaxClients = 32;
constexpr int kAcceptedPerTurn = 32;
// More than a socket holds unread.
constexpr int kReadsOfOverdue = 16;

// A disk that takes longer keeps nobody from going on.
constexpr milliseconds kKeptWithin{5'000};

const result::Diagnostics& not_kept_yet() {
  static const result::Diagnostics warning{
      {"R0027",
       result::Severity::Warning,
       {},
       "the program is not kept for the next start yet: the disk takes its time",
       "until it is, a power cut brings back the program before"}};
  return warning;
}

// Tickets of commands that the service itself gives; the request handler counts from 1.
constexpr std::uint64_t kOwnTicket = 0;

}  // namespace

struct Server::State {
  State(Listener l, host::RuntimePort& p, const ServerConfig& config)
      : listener(std::move(l)),
        port(p),
        handler(p, events),
        supervisor(config.supervisor_lost_after),
        greeting_within(config.greeting_within),
        persistence(config.persistence),
        incarnation(p.status().incarnation),
        program(p.status().program_digest),
        process(config.version),
        observer(config.observer == nullptr ? nobody : *config.observer) {}

  void read(Session& session);
  void accept_clients();
  void take_news();
  void pass_on(const Answer& answer);
  void answer(Answer answer);
  void pass_on_held();
  void serve(Session& session);
  void receive(Session& session, const Message& message);
  void greet(Session& session, const Hello& hello);
  void request(Session& session, const Request& request);
  std::optional<Reply> handle(Session& session, const Request& request);
  void reload(Session& session, const Request& request);
  void push_events(Session& session);
  void push_status();
  void hear_everybody();
  void watch_supervisor();
  void watch_program();
  void forget_closed();
  std::size_t clients() const;

  Listener listener;
  host::RuntimePort& port;
  EventHistory events;
  RequestHandler handler;
  SupervisorWatch supervisor;
  milliseconds greeting_within;
  ProgramPersistence* persistence;
  const std::uint64_t incarnation;
  std::string program;  // its digest, as it was last looked at
  ProcessWatch process;
  ServiceObserver nobody;
  ServiceObserver& observer;
  struct Held {
    Answer answer;
    Clock::time_point until;
  };
  std::vector<Held> held;  // answers to downloads whose programs are being kept
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
      {stop_descriptor, POLLIN, 0},
      {s.listener.descriptor(), POLLIN, 0},
      {s.port.descriptor(), POLLIN, 0},
      {s.persistence == nullptr || s.held.empty() ? -1 : s.persistence->descriptor(), POLLIN, 0}};
  for (const Session& session : s.sessions) {
    const int wanted = POLLIN | (session.wants_to_write() ? POLLOUT : 0);
    entries.push_back({session.descriptor(), static_cast<short>(wanted), 0});
  }
  const auto until_status = std::chrono::ceil<milliseconds>(s.status_at + kStatusPeriod - Clock::now());
  const auto wait = std::clamp(std::min(timeout, until_status), milliseconds(0), timeout);
  poll(entries.data(), entries.size(), static_cast<int>(wait.count()));

  std::size_t next = 4;
  for (Session& session : s.sessions) {
    const short ready = entries[next++].revents;
    if ((ready & (POLLIN | POLLHUP | POLLERR)) != 0) {
      s.read(session);
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
  for (Session& session : sessions) {
    if (!session.greeted && Clock::now() - session.since() > greeting_within) session.close();
  }
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
  for (int i = 0; i < kAcceptedPerTurn; ++i) {
    Descriptor socket = listener.accept();
    if (!socket.ok()) return;
    sessions.emplace_back(++last_session, std::move(socket));
    const pid_t peer = sessions.back().process();
    const auto own = static_cast<std::size_t>(std::count_if(
        sessions.begin(), sessions.end(), [&](const Session& each) { return each.process() == peer; }));
    // One too many is closed at once.
    if (own + sessions.size() > kMaxClients + 1) sessions.pop_back();
  }
}

// What a client says may be too large for the memory that there is: then the connection is given up.
void Server::State::read(Session& session) {
  try {
    session.read();
    serve(session);
  } catch (const std::bad_alloc&) {
    session.close();
  }
}

// What there is no memory for at present stays where it is until the next turn.
void Server::State::take_news() try {
  port.clear();
  bool completed = false;
  while (auto event = port.take_event()) {
    event->incarnation = incarnation;
    observer.on_event(*event);
    // A rollback brings a program that no command has loaded.
    completed = completed || event->kind == host::EventKind::RolledBack;
    events.append(std::move(*event));
    status_due = true;
  }
  while (auto completion = port.take_completion()) {
    status_due = true;
    completed = true;
    if (auto done = handler.complete(*completion)) answer(std::move(*done));
  }
  if (completed) watch_program();
  pass_on_held();
} catch (const std::bad_alloc&) {
  status_due = true;
}

void Server::State::pass_on(const Answer& answer) {
  handler.remember(answer.reply);
  const auto session = std::find_if(sessions.begin(), sessions.end(),
                                    [&](const Session& each) { return each.number() == answer.session; });
  if (answer.commit && !answer.reply.accepted()) {
    observer.on_refusal(session == sessions.end() ? "" : session->name,
                        {answer.reply.client, answer.reply.id, *answer.commit}, answer.reply);
  }
  if (session != sessions.end()) session->send(answer.reply);
}

void Server::State::watch_program() {
  if (persistence == nullptr) return;
  std::string now = port.status().program_digest;
  if (now == program) return;
  program = std::move(now);
  persistence->keep(port.program());
}

// A download is answered when its program will be there after a power cut, too.
void Server::State::answer(Answer answer) {
  if (persistence == nullptr || !answer.commit || !answer.reply.accepted()) return pass_on(answer);
  watch_program();
  held.push_back({std::move(answer), Clock::now() + kKeptWithin});
}

void Server::State::pass_on_held() {
  if (held.empty()) return;
  const auto outcome = persistence->outcome();
  std::erase_if(held, [&](Held& each) {
    if (!outcome && Clock::now() < each.until) return false;
    const result::Diagnostics& late = outcome ? *outcome : not_kept_yet();
    each.answer.reply.problems.insert(each.answer.reply.problems.end(), late.begin(), late.end());
    pass_on(each.answer);
    return true;
  });
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
  if (session.role != Role::Controller && !only_reads(request.body)) {
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
  if (std::holds_alternative<Stop>(request.body)) observer.on_stop();
  if (std::holds_alternative<Reload>(request.body)) return reload(session, request);
  auto reply = handle(session, request);
  if (!reply) return;
  if (!reply->accepted()) observer.on_refusal(session.name, request, *reply);
  if (std::holds_alternative<ResendEvents>(request.body) && reply->accepted()) {
    session.next_event = std::min(session.next_event, reply->offset);
  }
  session.send(std::move(*reply));
}

std::optional<Reply> Server::State::handle(Session& session, const Request& request) try {
  for (Held& each : held) {
    if (each.answer.reply.client != request.client || each.answer.reply.id != request.id) continue;
    each.answer.session = session.number();  // it asks again over a new connection
    return std::nullopt;
  }
  return handler.handle(session.number(), request);
} catch (const std::bad_alloc&) {
  Reply reply;
  reply.client = request.client;
  reply.id = request.id;
  auto failed = result::fail("R0072", {}, "the system gives no memory for this request; nothing was changed",
                             "the limit of memory may be reached (MemoryMax= of the unit, ulimit -v)");
  reply.problems = std::move(failed.value());
  return reply;
}

// Not remembered: reading a file twice does no harm.
void Server::State::reload(Session& session, const Request& request) {
  Reply reply;
  reply.client = request.client;
  reply.id = request.id;
  reply.problems = observer.on_reload();
  session.send(reply);
}

void Server::State::push_events(Session& session) try {
  if (!session.greeted) return;
  while (session.keeps_up() && !session.closed()) {
    const host::StepEvent* event = events.at_or_after(session.next_event);
    if (event == nullptr) return;
    session.send(*event);
    session.next_event = event->sequence + 1;
  }
} catch (const std::bad_alloc&) {
  // It is sent in another turn.
}

void Server::State::push_status() try {
  status_due = false;
  status_at = Clock::now();
  host::RuntimeStatus status = port.status();
  process.fill(status.process, clients());
  observer.on_status(status);
  for (Session& session : sessions) {
    if (session.greeted && session.keeps_up()) session.send(status);
  }
} catch (const std::bad_alloc&) {
  // The next one comes within kStatusPeriod.
}

// This thread may have been busy while the supervisor spoke: nobody is lost whose word has come and was not
// read.
void Server::State::hear_everybody() {
  for (Session& session : sessions) {
    for (int i = 0; i < kReadsOfOverdue && !session.closed() && session.readable(); ++i) read(session);
  }
}

void Server::State::watch_supervisor() {
  if (supervisor.overdue(Clock::now())) hear_everybody();
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
