#include "hmi_web/api/online_change_service.h"

#include <algorithm>
#include <span>
#include <utility>

#include "hmi_web/access/secrets.h"
#include "hmi_web/api/cell_codes.h"
#include "runtime/bytecode/reader/loaded_program.h"

namespace stepwright::api {
namespace {

using change::Outcome;
using change::Version;
using reader::LoadedProgram;

std::string digest_of(std::span<const std::byte> container) {
  return access::sha256_hex({reinterpret_cast<const char*>(container.data()), container.size()});
}

// A label for people, and for diagnostics; never a path that is opened.
bool is_file_name(const std::string& name) {
  return !name.empty() && name.size() <= kLongestSourceName &&
         std::none_of(name.begin(), name.end(),
                      [](unsigned char c) { return c < 0x20 || c == 0x7F || c == '/' || c == '\\'; });
}

auto no_program(const std::string& what, const std::string& hint) {
  return result::fail("H0094", {}, what, hint);
}

result::Diagnostics not_running() {
  return result::fail("R0031", {}, "no program is running that could be changed",
                      "start it, or bring the new one with `stepwright download --replace`")
      .value();
}

result::Diagnostics engaged_problem(const std::string& why) {
  return result::fail(kSupervisorActs, {}, "the supervisor acts in this runtime: " + why,
                      "hold or abort its run first; when it is resumed it brings its own program again")
      .value();
}

// What the outcome of a trial is called in the audit trail.
std::string result_of(const Trial& trial) {
  switch (trial.state) {
    case Trial::State::Kept:
      return "kept";
    case Trial::State::RolledBack:
      return "rolled back by the runtime: " + trial.why;
    default:
      return "the end of the trial is not known: " + trial.why;
  }
}

Outcome outcome_of(const Trial& trial) {
  return trial.state == Trial::State::Kept         ? Outcome::Kept
         : trial.state == Trial::State::RolledBack ? Outcome::RolledBack
                                                   : Outcome::Unknown;
}

}  // namespace

OnlineChangeService::OnlineChangeService(CellChange& cell, change::VersionStore& versions,
                                         access::AuditLog& audit, access::WallClock clock)
    : cell_(cell), versions_(versions), audit_(audit), clock_(std::move(clock)) {}

result::Result<Candidate> OnlineChangeService::take_container(const std::string& name, std::string bytes) {
  if (!is_file_name(name)) return no_program("this is no name of a file", "1 to 128 bytes, without slashes");
  const auto view = std::as_bytes(std::span(bytes));
  return keep(name, {view.begin(), view.end()}, {});
}

result::Result<Candidate> OnlineChangeService::take_sources(const SourceTexts& sources) {
  std::string name;
  for (const auto& [file, text] : sources) {
    if (!is_file_name(file))
      return no_program("this is no name of a file", "1 to 128 bytes, without slashes");
    name += (name.empty() ? "" : ", ") + file;
  }
  auto compiled = cell_.compile(sources);
  if (!compiled) return result::forward(compiled);
  if (name.size() > change::kLongestName) name = std::to_string(sources.size()) + " files";
  return keep(std::move(name), std::move(compiled->container), std::move(compiled->warnings));
}

result::Result<Candidate> OnlineChangeService::keep(std::string name, std::vector<std::byte> container,
                                                    result::Diagnostics warnings) {
  if (container.size() > change::kMostContainerBytes)
    return no_program("the program is too large",
                      "at most " + std::to_string(change::kMostContainerBytes) + " bytes");
  // What it is called is said by whoever brought it: diagnostics name the file.
  if (auto verified = LoadedProgram::load(container, name); !verified) return result::forward(verified);
  container = cell_.fitted(std::move(container));
  Candidate candidate{digest_of(container), std::move(name), container.size(), std::move(warnings)};
  const std::lock_guard lock(mutex_);
  std::erase_if(candidates_, [&](const Waiting& each) { return each.candidate.digest == candidate.digest; });
  candidates_.push_front({candidate, std::move(container)});
  if (candidates_.size() > kMostCandidates) candidates_.pop_back();
  return candidate;
}

result::Result<OnlineChangeService::Known> OnlineChangeService::known(const std::string& digest) const {
  {
    const std::lock_guard lock(mutex_);
    for (const Waiting& each : candidates_) {
      if (each.candidate.digest == digest) return Known{each.candidate.name, each.container};
    }
  }
  const auto version = versions_.find(digest);
  auto container = versions_.container(digest);
  if (!container) return result::forward(container);
  return Known{version ? version->name : "", std::move(*container)};
}

std::string OnlineChangeService::digest_of_loaded() {
  auto now = cell_.loaded();
  return now ? now->digest : "";
}

result::Result<Comparison> OnlineChangeService::compare(const std::string& digest) {
  auto next = known(digest);
  if (!next) return result::forward(next);
  auto now = cell_.loaded();
  if (!now) return result::forward(now);
  auto before = LoadedProgram::load(*now->container, "the running program");
  if (!before) return result::forward(before);
  auto after = LoadedProgram::load(next->container, next->name);
  if (!after) return result::forward(after);
  auto diff = change::compare(*before, *after, now->image);
  if (!diff) return result::forward(diff);
  Comparison seen{now->digest, digest, std::move(*diff), {}};
  if (!now->running) seen.now = not_running();
  if (const std::string why = cell_.engaged(); !why.empty()) seen.now = engaged_problem(why);
  return seen;
}

Answer OnlineChangeService::sources(const std::string& digest) {
  const auto program = known(digest);
  return program ? cell_.sources(digest, program->container) : refused(program.error());
}

result::Result<void> OnlineChangeService::check(const ChangeOrder& order, const LoadedNow& now) {
  {
    const std::lock_guard lock(mutex_);
    if (newest_ && newest_->trial.state == Trial::State::Running)
      return result::fail(kOnTrial, {}, "a change is still on trial", "wait until it is kept or rolled back");
  }
  if (const std::string why = cell_.engaged(); !why.empty()) return tl::unexpected(engaged_problem(why));
  if (!now.running) return tl::unexpected(not_running());
  if (now.digest != order.base) {
    return result::fail(kComparedWithAnother, {},
                        "another program runs than the one that this one was compared with",
                        "look at the differences to " + now.digest.substr(0, 12) + ", then decide again");
  }
  if (now.digest == order.program)
    return result::fail(kRunsAlready, {}, "this program runs already", "there is nothing to change");
  return {};
}

// Both programs are on the disk before anything happens: whatever the change leads to, there is a way back.
result::Result<void> OnlineChangeService::write_down(const ChangeOrder& order, const LoadedNow& now,
                                                     const Known& next) {
  Version fresh{order.program, next.name, order.user, order.reason, now.digest, clock_(), Outcome::Trial, {}};
  if (!versions_.find(now.digest)) {
    const Version found{now.digest, "", "", "", "", fresh.when - std::chrono::seconds(1), Outcome::Found, {}};
    if (auto kept = versions_.put(found, *now.container); !kept) return kept;
  }
  return versions_.put(fresh, next.container);
}

// The versions are as they were, as nothing has happened. Of a disk that fails now, one too many is kept.
// Where nobody has answered the program may run all the same: then both stay.
void OnlineChangeService::take_back(const ChangeOrder& order, const Known& next, const std::string& running,
                                    const std::optional<Version>& before, bool was_known,
                                    const result::Diagnostics& problems) {
  if (nobody_answers(problems)) {
    (void)versions_.settle(order.program, Outcome::Unknown, problems.front().message);
    return;
  }
  if (before) {
    (void)versions_.put(*before, next.container);
  } else {
    (void)versions_.remove(order.program);
  }
  if (!was_known) (void)versions_.remove(running);
}

result::Result<ChangeRecord> OnlineChangeService::change(const ChangeOrder& order) {
  const std::lock_guard one(turn_);
  auto now = cell_.loaded();
  if (!now) return result::forward(now);
  if (auto good = check(order, *now); !good) return result::forward(good);
  auto next = known(order.program);
  if (!next) return result::forward(next);
  // A file of the store is as foreign as what a page brings.
  if (auto verified = LoadedProgram::load(next->container, next->name); !verified)
    return result::forward(verified);
  auto before = versions_.find(order.program);
  const bool found = versions_.find(now->digest).has_value();
  if (auto written = write_down(order, *now, *next); !written) return result::forward(written);
  auto takeover = cell_.change(next->container, order.restart_charts);
  if (!takeover) {
    take_back(order, *next, now->digest, before, found, takeover.error());
    return result::forward(takeover);
  }
  (void)versions_.trim(order.program, now->digest);
  ChangeRecord record{order, next->name, clock_(), std::move(*takeover), cell_.trial()};
  record.trial.state = Trial::State::Running;  // its end is told by turn() only, and written down there
  {
    const std::lock_guard lock(mutex_);
    newest_ = record;
  }
  return record;
}

void OnlineChangeService::turn() {
  ChangeRecord record;
  {
    const std::lock_guard lock(mutex_);
    if (!newest_ || newest_->trial.state != Trial::State::Running) return;
    newest_->trial = cell_.trial();
    if (newest_->trial.state == Trial::State::None) newest_->trial.state = Trial::State::Running;
    if (newest_->trial.state == Trial::State::Running) return;
    record = *newest_;
  }
  const Trial& trial = record.trial;
  (void)versions_.settle(record.order.program, outcome_of(trial), trial.why);
  (void)audit_.append(
      {.user = record.order.user,
       .role = record.order.role,
       .address = record.order.address,
       .action = "change.outcome",
       .target = record.name,
       .before = record.order.base,
       .after = trial.state == Trial::State::RolledBack ? record.order.base : record.order.program,
       .reason = record.order.reason,
       .result = result_of(trial)});
}

std::optional<ChangeRecord> OnlineChangeService::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

}  // namespace stepwright::api
