#include "programs/up/process_supervisor.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "cell/processes/process_list.h"
#include "cell/processes/setup_token.h"
#include "programs/up/ask_program.h"
#include "runtime/ground/process/command_line.h"

namespace stepwright::up {
namespace {

using processes::KeptProcess;
using processes::Phase;
using result::ExitCode;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kLongestTurn{20};
constexpr seconds kBetweenTries{1};  // to write the record on a disk that is full
// A process that takes longer than this to be ready is named.
constexpr seconds kTellAfter{5};
// Four signs of life are due in this time. A page server may have many to answer, a gateway waits for its
// controller, and a planner may have all the machine's memory to fill and to give back.
constexpr seconds kSilence{5};
constexpr seconds kSilenceOfPage{15};
constexpr seconds kSilenceOfGateway{30};
constexpr seconds kSilenceOfSupervisor{30};
// A runtime may wait for a disk behind its safe outputs.
constexpr seconds kTimeToEnd{10};

std::string program_of(const std::filesystem::path& programs, const std::string& name) {
  return (programs / ("stepwright-" + name)).string();
}

process::ChildOptions command_of(const ProcessSupervisorSetting& setting, const std::string& name,
                                 const std::string& notify) {
  process::ChildOptions options;
  options.arguments = {program_of(setting.programs, name), name, "--config", setting.config.file.string()};
  for (const std::string& each : setting.overrides) {
    options.arguments.emplace_back("--set");
    options.arguments.push_back(each);
  }
  options.environment = {notify};
  return options;
}

milliseconds silence_of(const std::string& name) {
  if (name == "gateway") return kSilenceOfGateway;
  if (name == "supervisor") return kSilenceOfSupervisor;
  return name == "hmi" ? kSilenceOfPage : kSilence;
}

result::Result<void> check_program(const std::filesystem::path& programs, const std::string& name) {
  const std::string program = program_of(programs, name);
  if (access(program.c_str(), X_OK) == 0) return {};
  return result::fail("M0001", {program, 0, 0}, "the program of '" + name + "' is missing",
                      "is it built, or installed? (scripts/build release programs)");
}

// Why the cell is up and does not do what it is for; empty: it does, or names no program.
std::string idle_program(const config::CellConfig& config) {
  if (config.boot.program.empty() || config.controller.remote()) return "";
  const processes::ProgramRecord program = ask_program(config);
  const bool missing = is_missing(program, config);
  if (!missing && !is_in_fault(program)) return "";
  return (missing ? "without its program: " : "and its program is in fault: ") +
         (program.detail.empty() ? "`stepwright status` says what is" : program.detail);
}

// A gateway is ready before its controller has power, and serves its socket once that answers.
bool is_without_controller(const config::CellConfig& config) {
  return config.controller.remote() && !config.controller.loaded_by_hand &&
         ask_program(config).state == kNoAnswer;
}

}  // namespace

// The lock says that the cell is not up; what is left over here would only mislead people, but for who has
// asked for the end and is to hear what it has left behind.
ProcessSupervisor::~ProcessSupervisor() {
  if (!killed_.empty()) return;
  std::error_code ignored;
  std::filesystem::remove(processes::record_path(setting_.config), ignored);
}

result::Result<std::unique_ptr<ProcessSupervisor>> ProcessSupervisor::make(ProcessSupervisorSetting setting,
                                                                           Console& console) {
  auto listener = process::NotifyListener::open();
  if (!listener) return result::forward(listener);
  std::unique_ptr<ProcessSupervisor> supervisor(
      new ProcessSupervisor(std::move(setting), console, std::move(*listener)));
  const ProcessSupervisorSetting& kept = supervisor->setting_;
  for (const std::string& name : processes::starting_order(kept.config)) {
    const process::ChildOptions options = command_of(kept, name, supervisor->listener_.variable());
    if (auto there = check_program(kept.programs, name); !there) return result::forward(there);
    auto member = KeptProcess::make(name, options, {}, silence_of(name));
    if (!member) return result::forward(member);
    supervisor->members_.push_back(std::move(*member));
  }
  // The runtime starts its guard itself.
  if (kept.config.safety.guard.enabled && !kept.config.controller.remote()) {
    if (auto there = check_program(kept.programs, "guard"); !there) return result::forward(there);
  }
  supervisor->kept_ = supervisor->record();
  // A folder without room is told while somebody still listens.
  if (auto unwritten = processes::write_record(processes::record_path(kept.config), *supervisor->kept_);
      !unwritten.empty())
    return tl::unexpected(std::move(unwritten));
  if (kept.watch) supervisor->watch_.emplace(kept.config, kept.overrides, kept.programs);
  return supervisor;
}

KeptProcess* ProcessSupervisor::find(const std::string& name) {
  const auto at = std::ranges::find(members_, name, &KeptProcess::name);
  return at == members_.end() ? nullptr : &*at;
}

const KeptProcess* ProcessSupervisor::failed() const {
  const auto at = std::ranges::find(members_, Phase::Failed, &KeptProcess::phase);
  return at == members_.end() ? nullptr : &*at;
}

void ProcessSupervisor::start_next() {
  if (begun_ == members_.size() || failed() != nullptr) return;
  if (begun_ > 0 && members_[begun_ - 1].phase() != Phase::Ready) {
    if (patience_told_ || Clock::now() < begun_at_ + kTellAfter) return;
    patience_told_ = true;
    console_.say("waits until " + members_[begun_ - 1].name() + " is ready");
    return;
  }
  KeptProcess& next = members_[begun_++];
  begun_at_ = Clock::now();
  patience_told_ = false;
  if (const auto started = next.start(); !started)
    console_.line(next.name(), result::to_string(started.error()));
}

void ProcessSupervisor::print_lines(KeptProcess& member) {
  for (const std::string& line : member.lines()) {
    console_.line(member.name(), line);
    if (member.name() != "hmi") continue;
    if (const auto token = processes::setup_token_of(line)) token_ = *token;
  }
}

void ProcessSupervisor::turn(const process::StopSignal* stop) {
  std::vector<pollfd> entries = {{listener_.descriptor(), POLLIN, 0}};
  if (stop != nullptr) entries.push_back({stop->descriptor(), POLLIN, 0});
  for (const KeptProcess& member : members_) entries.push_back({member.descriptor(), POLLIN, 0});
  poll(entries.data(), entries.size(), static_cast<int>(kLongestTurn.count()));
  for (KeptProcess& member : members_) print_lines(member);
  const auto now = Clock::now();
  for (const process::Notice& notice : listener_.take()) {
    for (KeptProcess& member : members_) member.hear(notice, now);
    // It says other things, too, such as that it has read its configuration again.
    const KeptProcess& page = *find("hmi");
    if (page.status().starts_with("http")) address_ = page.status();
  }
  for (KeptProcess& member : members_) {
    const std::string news = member.turn(now);
    if (news.empty()) continue;
    print_lines(member);
    console_.line(member.name(), news);
  }
  if (watch_ && ready_ && stop != nullptr) watch_->turn(console_);
  keep_record();
}

void ProcessSupervisor::tell_token() {
  if (!ready_ || token_.empty()) return;
  console_.say("to act on the page, log in there with the set-up token " + token_ + " (once)");
  token_.clear();
}

void ProcessSupervisor::become_ready() {
  const bool all =
      std::ranges::all_of(members_, [](const KeptProcess& each) { return each.phase() == Phase::Ready; });
  if (ready_ || !all) return;
  ready_ = true;
  const std::string idle = idle_program(setting_.config);
  if (idle.empty()) {
    console_.say("the cell '" + setting_.config.name + "' is ready: " + address_);
  } else {
    console_.say("the cell '" + setting_.config.name + "' is up " + idle);
    console_.say("its page is " + address_ + "; a program that is downloaded is taken");
  }
  if (is_without_controller(setting_.config))
    console_.say("its controller does not answer yet; `stepwright status` says when it does");
  tell_token();
  const std::string down = "`stepwright down " + setting_.config.file.string() + "`";
  console_.say(setting_.terminal ? "Ctrl-C ends it; so does " + down : down + " ends it");
  keep_record();
  init_.ready(address_);
  setting_.on_up(idle.empty() ? ExitCode::Done : ExitCode::RuntimeFault);
}

void ProcessSupervisor::tell_failure(const KeptProcess& member) {
  if (std::ranges::find(told_failed_, member.name()) != told_failed_.end()) return;
  told_failed_.push_back(member.name());
  const std::string file = setting_.config.file.string();
  console_.say(member.name() +
               " is left alone, the others go on. Mend what it says (`stepwright check --config " + file +
               "`), then `stepwright down " + file + "` and `stepwright up " + file + "`");
}

processes::CellRecord ProcessSupervisor::record() const {
  processes::CellRecord record;
  record.cell = setting_.config.name;
  record.config = processes::whole_path(setting_.config.file);
  record.pid = getpid();
  record.clock = setting_.config.clock.mode == config::ClockMode::Real ? "real" : "simulated";
  record.ready = ready_;
  record.address = address_;
  for (const KeptProcess& each : members_)
    record.processes.push_back(
        {each.name(), each.pid(), to_string(each.phase()), each.restarts(), each.reason()});
  record.killed = killed_;
  return record;
}

void ProcessSupervisor::keep_record() {
  processes::CellRecord news = record();
  const auto now = Clock::now();
  if (kept_ == news || now < next_try_) return;
  const auto unwritten = processes::write_record(processes::record_path(setting_.config), news);
  if (!unwritten.empty() && !record_fails_) console_.say(result::to_string(unwritten));
  record_fails_ = !unwritten.empty();
  if (record_fails_) {
    next_try_ = now + kBetweenTries;
  } else {
    kept_ = std::move(news);
  }
}

void ProcessSupervisor::kill(KeptProcess& member) {
  const std::string left = processes::left_behind_by(member.name());
  console_.say(member.name() + " does not end: it is killed" + (left.empty() ? "" : "; " + left));
  killed_.push_back(member.name());
  keep_record();
  member.kill_now();
}

void ProcessSupervisor::end_all() {
  init_.stopping();
  // What waits for its next start is not started any more.
  for (KeptProcess& each : members_)
    if (!each.runs()) each.ask_to_end();
  for (const std::string& name : processes::ending_order(setting_.config)) {
    KeptProcess* const member = find(name);
    if (member == nullptr || !member->runs()) continue;
    console_.say("ends " + name);
    member->ask_to_end();
    const auto deadline = Clock::now() + kTimeToEnd;
    while (member->runs() && Clock::now() < deadline) turn(nullptr);
    if (member->runs()) kill(*member);
    while (member->runs()) turn(nullptr);
  }
}

ExitCode ProcessSupervisor::run(const process::StopSignal& stop) {
  while (!stop.came()) {
    start_next();
    turn(&stop);
    become_ready();
    tell_token();
    const KeptProcess* const lost = failed();
    if (lost == nullptr) continue;
    if (ready_) {
      for (const KeptProcess& each : members_)
        if (each.phase() == Phase::Failed) tell_failure(each);
      continue;
    }
    const std::string name = lost->name();
    const auto exit = lost->exit();
    const bool wrong = exit && !exit->killed && exit->code == to_int(ExitCode::BadInput);
    end_all();
    console_.say("the cell '" + setting_.config.name + "' is not up: " + name +
                 " has failed. Mend what it says above; `stepwright check --config " +
                 setting_.config.file.string() + "` finds what is wrong with the cell");
    return wrong ? ExitCode::BadInput : ExitCode::RuntimeFault;
  }
  const bool whole = failed() == nullptr;
  end_all();
  console_.say("the cell '" + setting_.config.name + "' is down");
  return whole && killed_.empty() ? ExitCode::Done : ExitCode::RuntimeFault;
}

}  // namespace stepwright::up
