// Bringing a program to run: by an online change from the program that runs, so that the plant is never
// without control, or by download and start.

#include <chrono>
#include <utility>

#include "supervisor/executive/executive.h"
#include "supervisor/translate/monitors.h"

namespace stepwright::executive {
namespace {

using std::chrono::milliseconds;

// Longer than any restart that somebody waits for; after it the answer counts as missing.
constexpr milliseconds kPatience{5'000};

}  // namespace

result::Result<ImageReader> Executive::reader_of(const PreparedPlan& prepared, Kind kind) const {
  std::vector<std::string> variables;
  for (const translate::Sensor& sensor : desk_.binding().sensors) {
    variables.push_back(translate::filtered_variable(sensor));
    variables.push_back(sensor.tag);
    if (kind == Kind::Observer) variables.push_back(translate::half_variable(sensor));
  }
  for (const translate::ObservedFact& fact : desk_.binding().facts) variables.push_back(fact.tag);
  return ImageReader::create(prepared.container, prepared.translation.instance, variables);
}

// The readers of a program; gives up if it lacks what they need.
bool Executive::read_program(const PreparedPlan& prepared, Kind kind) {
  auto reader = reader_of(prepared, kind);
  if (!reader) return give_up("the program cannot be read", reader.error());
  reader_ = std::move(*reader);
  alarm_reader_.reset();
  if (kind == Kind::Observer || prepared.translation.monitors.empty()) return true;
  std::vector<std::string> alarms = {translate::kAlarmCount};
  for (std::size_t i = 0; i < prepared.translation.monitors.size(); ++i) {
    alarms.push_back(translate::alarm_scan_variable(i));
    alarms.push_back(translate::alarm_value_variable(i));
  }
  auto alarm_reader = ImageReader::create(prepared.container, prepared.translation.instance, alarms);
  if (!alarm_reader) return give_up("the program cannot be read", alarm_reader.error());
  alarm_reader_ = std::move(*alarm_reader);
  return true;
}

// False if the runtime is lost (phase unchanged) or refuses (phase Safe).
bool Executive::install(const PreparedPlan& prepared, Kind kind) {
  alarms_seen_ = 0;
  alarms_told_.clear();
  // The first plan starts the trace of the first run from nothing. Every other program takes over from the
  // one before: what the programs of people have latched (an emergency stop, until somebody resets it) stays.
  const bool relieves = !record_.replans.empty() || another_run_;
  return (relieves && can_take_over() && take_over(prepared, kind)) ||
         (record_.phase != Phase::Safe && download_and_start(prepared, kind));
}

// As far as the newest status tells; the runtime knows for sure.
bool Executive::can_take_over() const {
  const auto status = controller_.status();
  return !digest_.empty() && status && status->state == host::RuntimeState::Running &&
         status->program_digest == digest_ && controller_.alive();
}

// False if it is refused, or if no news of it came: then the program is installed as if none ran.
bool Executive::take_over(const PreparedPlan& prepared, Kind kind) {
  auto digest = controller_.change(prepared.container);
  if (!digest) {
    (void)controller_.stop("the next program cannot take over");
    return false;
  }
  digest_ = std::move(*digest);
  confirmed_ = false;
  silent_rounds_ = 0;
  return read_program(prepared, kind) && await_event(host::EventKind::Changed);
}

bool Executive::download_and_start(const PreparedPlan& prepared, Kind kind) {
  auto digest = controller_.download(prepared.container);
  if (!digest)
    return controller_.alive() ? give_up("the runtime refuses the program", digest.error()) : false;
  digest_ = std::move(*digest);
  confirmed_ = false;
  silent_rounds_ = 0;
  if (!read_program(prepared, kind)) return false;
  if (auto started = controller_.start(options_.barrier); !started) {
    return controller_.alive() ? give_up("the runtime does not start the program", started.error()) : false;
  }
  return await_event(host::EventKind::Started);
}

// The news that the program runs. What comes before it is of the one before.
bool Executive::await_event(host::EventKind kind) {
  for (const auto deadline = std::chrono::steady_clock::now() + kPatience;
       std::chrono::steady_clock::now() < deadline && controller_.alive();) {
    const auto event = controller_.wait_event(milliseconds(200));
    if (!event) continue;
    (void)controller_.acknowledge(event->sequence);
    if (event->kind != kind || event->program_digest != digest_) continue;
    clock_.see(event->incarnation, event->time_ns);
    return true;
  }
  return false;
}

}  // namespace stepwright::executive
