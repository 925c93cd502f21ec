#include "tests/unit/supervisor/run/filling_mission.h"

#include <fmt/format.h>

#include <utility>

#include "ladder/driver/compile.h"

namespace stepwright::run {
namespace {

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

FillingMission::FillingMission(Controller& controller, int counts, Observer observer)
    : Mission(controller, {.cell = "bench"}, std::move(observer)), counts_(counts) {}

bool FillingMission::begin() {
  set_phase(Phase::Planning, "filling the vehicle");
  return launch();
}

// What is planned, and that it runs.
bool FillingMission::launch() {
  const auto program = program_for(counts_);
  if (!program) return give_up("no program could be made", program.error());
  auto reader = ImageReader::create(*program, "filling", {"filling.level"});
  if (!reader) return give_up("the program cannot be read", reader.error());
  reader_ = std::move(*reader);
  do {
    if (!await_runtime()) return false;
    if (download(*program) && start()) {
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
  } while (record_.phase != Phase::Safe);  // the runtime was lost meanwhile
  return false;
}

// What is observed.
Decision FillingMission::judge_image(std::span<const std::byte> image) {
  const bool done = reader_->active_steps(image).back();
  record_.observed["level"] = reader_->values(image).at("filling.level");
  publish(/*now=*/true);
  return {done ? Verdict::Finished : Verdict::GoOn};
}

// What a surprise means: the same again, from where the level is.
bool FillingMission::replan(const Cause& cause) {
  open_incident(cause);
  record_.replans.push_back({clock_.now_s(), sentence_of(cause.evidence), {}});
  set_phase(Phase::Replanning, sentence_of(cause.evidence));
  decide(Response::Replan);
  return launch();
}

bool FillingMission::recover_runtime() {
  return replan({IncidentKind::LostRuntime, {"the runtime was lost"}});
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

}  // namespace stepwright::run
