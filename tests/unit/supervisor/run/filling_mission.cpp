#include "tests/unit/supervisor/run/filling_mission.h"

#include <fmt/format.h>

#include <utility>

#include "ladder/driver/compile.h"

namespace stepwright::filling {
namespace {

using run::ActionRecord;
using run::ActionState;
using run::Cause;
using run::Decision;
using run::Episode;
using run::ImageReader;
using run::IncidentKind;
using run::Phase;
using run::Response;
using run::Verdict;

// The plan: one action, whose end the program sees itself.
result::Result<std::vector<std::byte>> program_for(int counts) {
  driver::CompileInput input;
  input.texts.push_back({"filling.st", fmt::format(R"(
PROGRAM filling
VAR
  level AT %IW1 : INT;
  pump AT %QX0.0 : BOOL;
END_VAR
INITIAL_STEP Fill:
  pump(N);
END_STEP
TRANSITION full FROM Fill TO Done := level >= {};
END_TRANSITION
STEP Done:
END_STEP
END_PROGRAM
)",
                                                   counts)});
  auto output = driver::compile(input);
  if (!output) return result::forward(output);
  return std::move(output->container);
}

}  // namespace

FillingMission::FillingMission(run::Controller& controller, run::MissionOptions options, int counts,
                               Observer observer)
    : Mission(controller, std::move(options), std::move(observer)), counts_(counts) {}

bool FillingMission::begin() {
  set_phase(Phase::Planning, "filling the vehicle");
  return await_operator("nothing moves until an operator starts it") && launch();
}

// What is planned, and that it runs.
bool FillingMission::launch() {
  const auto program = program_for(counts_);
  if (!program) return give_up("no program could be made", program.error());
  auto reader = ImageReader::create(*program, "filling", {"filling.level"});
  if (!reader) return give_up("the program cannot be read", reader.error());
  reader_ = std::move(*reader);
  if (!await_runtime() || !bring_to_run([&] { return install(*program); })) return false;
  Episode episode;
  episode.digest = digest_;
  episode.started_s = clock_.now_s();
  episode.actions.emplace_back();
  episode.actions.back().text = "(fill v1)";
  episode.actions.back().state = ActionState::Active;
  record_.episodes.push_back(std::move(episode));
  set_phase(Phase::Executing, "the pump runs");
  return true;
}

// A program that runs is relieved without a stop. False: the runtime is lost, or the run is over (phase
// Safe).
bool FillingMission::install(const std::vector<std::byte>& program) {
  if (runs() && change(program)) return await_event(host::EventKind::Changed);
  return download(program) && start();
}

// What is observed.
Decision FillingMission::judge_image(std::span<const std::byte> image) {
  const bool done = reader_->active_steps(image).back();
  record_.observed["level"] = reader_->values(image).at("filling.level");
  publish(/*now=*/true);
  if (auto cause = due(clock_.now_s())) return {Verdict::Replan, *std::move(cause)};
  return {done ? Verdict::Finished : Verdict::GoOn};
}

// What a surprise means: the same again, from where the level is.
bool FillingMission::replan(const Cause& cause) {
  open_incident(cause);
  record_.replans.push_back({clock_.now_s(), run::sentence_of(cause.evidence), {}});
  set_phase(Phase::Replanning, run::sentence_of(cause.evidence));
  decide(Response::Replan);
  return launch();
}

bool FillingMission::recover_runtime() {
  return replan({IncidentKind::LostRuntime, {"the runtime was lost"}});
}

// What people may ask for: from any thread.
result::Result<void> FillingMission::take(const run::Request& request) {
  if (request.word() == "start") return accept_start();
  if (request.word() != "change") return run::not_of_this_mission("start, change, abort");
  const auto counts = request.number("value");
  if (request.text("fluent") != "(level v1)" || !counts || !(*counts >= 1 && *counts <= 32'767)) {
    return run::no_request(R"_(for example {"request": "change", "fluent": "(level v1)", "value": 2500})_");
  }
  if (over()) return run_is_over();
  wanted_.add({0.0, static_cast<int>(*counts)});
  return {};
}

// And what becomes of it, in the thread of the run.
std::optional<Cause> FillingMission::due(double time_s) {
  const std::vector<Level> wanted = wanted_.take(time_s);
  if (wanted.empty()) return std::nullopt;
  counts_ = wanted.back().counts;
  return Cause{IncidentKind::NewGoal, {fmt::format("{} counts are wanted", counts_)}};
}

// How it comes to rest.
bool FillingMission::finish() {
  ActionRecord& action = record_.episodes.back().actions.back();
  action.state = ActionState::Done;
  action.finished_s = clock_.now_s();
  (void)controller_.stop("the vehicle is full");
  set_phase(Phase::Done, "the vehicle is full");
  return false;
}

void FillingMission::publish(bool) {
  tell();
}

}  // namespace stepwright::filling
