#include "programs/up/source_watch.h"

#include <utility>

#include "programs/up/compile_step.h"

namespace stepwright::up {
namespace {

constexpr const char* kName = "watch";
// A file that did not change from one look to the next is written.
constexpr std::chrono::milliseconds kBetweenLooks{200};

}  // namespace

SourceWatch::SourceWatch(const config::CellConfig& config, std::vector<std::string> overrides,
                         std::filesystem::path programs)
    : config_(config), overrides_(std::move(overrides)), programs_(std::move(programs)), seen_(times()) {
  newest_ = seen_;
}

// A file that is being replaced may be missing for a moment: then it is as it was.
SourceWatch::Times SourceWatch::times() const {
  Times found;
  for (const std::filesystem::path& source : config_.boot.sources) {
    std::error_code error;
    const auto time = std::filesystem::last_write_time(source, error);
    const auto before = seen_.find(source);
    if (!error) found[source] = time;
    if (error && before != seen_.end()) found[source] = before->second;
  }
  return found;
}

void SourceWatch::look() {
  if (Clock::now() < look_at_) return;
  look_at_ = Clock::now() + kBetweenLooks;
  Times now = times();
  due_ = now != seen_ && now == newest_;
  newest_ = std::move(now);
}

void SourceWatch::begin(Work work, Console& console) {
  auto pipe = processes::LinePipe::open();
  if (!pipe) return console.line(kName, result::to_string(pipe.error()));
  process::ChildOptions options = work == Work::Compile
                                      ? compile_command(config_, programs_, fresh_image(config_))
                                      : change_command(config_, overrides_, programs_, fresh_image(config_));
  options.output = pipe->writing_end();
  auto child = process::ChildProcess::start(options);
  if (!child) return console.line(kName, result::to_string(child.error()));
  pipe_ = std::move(*pipe);
  child_.emplace(std::move(*child));
  work_ = work;
}

void SourceWatch::finish(int exit, Console& console) {
  for (const std::string& line : pipe_.last_lines()) console.line(kName, line);
  child_.reset();
  const Work done = std::exchange(work_, Work::None);
  if (exit != 0) {
    console.line(kName, done == Work::Compile
                            ? "not brought in: the sources are wrong; the program before goes on"
                            : "not brought in: the program before goes on");
    return;
  }
  if (done == Work::Compile) return begin(Work::Download, console);
  std::error_code error;
  std::filesystem::rename(fresh_image(config_), config_.boot.program, error);
  console.line(kName, error ? "brought in, but not kept for the next start: " + error.message()
                            : "brought in: what was saved runs");
}

void SourceWatch::turn(Console& console) {
  if (work_ != Work::None) {
    for (const std::string& line : pipe_.lines()) console.line(kName, line);
    if (const auto exit = child_->poll()) finish(exit->code, console);
    return;
  }
  look();
  if (!due_) return;
  due_ = false;
  seen_ = newest_;
  console.line(kName, "a source was saved: compiles");
  begin(Work::Compile, console);
}

}  // namespace stepwright::up
