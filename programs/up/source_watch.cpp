#include "programs/up/source_watch.h"

#include <utility>

#include "programs/up/compile_step.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::up {
namespace {

constexpr const char* kName = "watch";
constexpr const char* kWhatIs = "`stepwright status`";

// What the processes read at their start and never again.
std::vector<std::filesystem::path> settings_of(const config::CellConfig& config) {
  std::vector<std::filesystem::path> files = {
      config.file,        config.history.alarms, config.hmi.recipes,       config.hmi.tags,
      config.hmi.drawing, config.plant.file,     config.plant.stepped.file};
  files.insert(files.end(), config.plant.stepped.sources.begin(), config.plant.stepped.sources.end());
  for (const config::MonitorConfig& each : config.monitors) files.push_back(each.formula_file);
  std::erase_if(files, [](const std::filesystem::path& each) { return each.empty(); });
  return files;
}

}  // namespace

SourceWatch::SourceWatch(const config::CellConfig& config, std::vector<std::string> overrides,
                         std::filesystem::path programs)
    : config_(config),
      overrides_(std::move(overrides)),
      programs_(std::move(programs)),
      sources_(config.boot.sources),
      settings_(settings_of(config)) {}

void SourceWatch::begin(Work work, Console& console) {
  auto pipe = processes::LinePipe::open();
  if (!pipe) return console.line(kName, result::to_string(pipe.error()));
  if (work == Work::Compile) {
    auto image = MemoryFile::make();
    if (!image) return console.line(kName, result::to_string(image.error()));
    image_ = std::move(*image);
  }
  process::ChildOptions options = work == Work::Compile
                                      ? compile_command(config_, programs_, *image_)
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
  // The runtime is in charge of a program that is loaded, also where it does not run yet.
  const bool loaded = done == Work::Download && exit == result::to_int(result::ExitCode::BudgetExhausted);
  if (exit != 0 && !loaded) {
    console.line(kName, done == Work::Compile ? "not brought in: the sources are wrong; nothing has changed"
                        : exit == result::to_int(result::ExitCode::RuntimeFault)
                            ? "not brought in: " + std::string(kWhatIs) + " says what is"
                            : "not brought in: nothing has changed");
    return;
  }
  if (done == Work::Compile) {
    const auto unwritten = keep_program(fresh_image(config_), image_->bytes());
    image_.reset();
    if (unwritten.empty()) return begin(Work::Download, console);
    console.line(kName, result::to_string(unwritten));
    return console.line(kName, "not brought in: nothing has changed");
  }
  std::error_code error;
  std::filesystem::rename(fresh_image(config_), config_.boot.program, error);
  if (error) console.line(kName, "not kept for the next start: " + error.message());
  console.line(kName, loaded ? "brought in, and not known to run: " + std::string(kWhatIs) + " says what is"
                             : "brought in: what was saved runs");
}

void SourceWatch::turn(Console& console) {
  if (work_ != Work::None) {
    for (const std::string& line : pipe_.lines()) console.line(kName, line);
    if (const auto exit = child_->poll()) finish(exit->code, console);
    return;
  }
  look_at_settings(console);
  const FileTimes::News news = sources_.look();
  for (const std::filesystem::path& file : news.gone)
    console.line(kName, file.filename().string() +
                            " is gone: the program before goes on, and the cell does not start again without "
                            "it. Put it back, or take it out of [runtime] sources");
  if (news.saved.empty()) return;
  console.line(kName, "a source was saved: compiles");
  begin(Work::Compile, console);
}

void SourceWatch::look_at_settings(Console& console) {
  const FileTimes::News news = settings_.look();
  const std::string file = config_.file.string();
  for (const std::filesystem::path& each : news.saved)
    console.line(kName, each.filename().string() +
                            " was saved: it counts from the next start on. `stepwright check " + file +
                            "` looks at it, `stepwright down " + file + "` and `stepwright up " + file +
                            "` bring it in");
  for (const std::filesystem::path& each : news.gone)
    console.line(kName, each.filename().string() +
                            " is gone: the cell goes on without reading it, and does "
                            "not start again before it is back");
}

}  // namespace stepwright::up
