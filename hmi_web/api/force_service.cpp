#include "hmi_web/api/force_service.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "hmi_web/api/cell_codes.h"
#include "hmi_web/api/internal/shared_places.h"
#include "hmi_web/storage/private_files.h"
#include "runtime/ground/files/durable_file.h"

namespace stepwright::api {
namespace {

using nlohmann::json;
using std::chrono::system_clock;

std::int64_t seconds_of(system_clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count();
}

system_clock::time_point time_of(std::int64_t seconds) {
  return system_clock::time_point(std::chrono::seconds(seconds));
}

// A link that cannot tell what is forced is asked again after so many rounds: it may be another one by then.
constexpr int kRoundsOfPause = 30;
constexpr std::size_t kMostForceBytes = std::size_t{16} << 20;

json to_json(const std::vector<StandingForce>& standing, const std::vector<ForcedPlace>& others) {
  json list = json::array();
  for (const ForcedPlace& each : others) {
    list.push_back({{"name", each.name},
                    {"value", each.value},
                    {"user", ""},
                    {"reason", ""},
                    {"since_s", nullptr},
                    {"until_s", nullptr}});
  }
  for (const StandingForce& each : standing) {
    // Somebody else has forced it since: it is listed above, and once.
    const auto same_name = [&](const ForcedPlace& other) { return other.name == each.name; };
    if (std::any_of(others.begin(), others.end(), same_name)) continue;
    list.push_back({{"name", each.name},
                    {"value", each.value},
                    {"user", each.user},
                    {"reason", each.reason},
                    {"since_s", seconds_of(each.since)},
                    {"until_s", seconds_of(each.until)}});
  }
  return {{"forces", std::move(list)}};
}

std::string text_of(const json& document) {
  return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::optional<std::vector<StandingForce>> from_json(const std::string& text) {
  const json document = json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!document.is_object() || !document.contains("forces") || !document["forces"].is_array())
    return std::nullopt;
  std::vector<StandingForce> standing;
  for (const json& entry : document["forces"]) {
    const bool right = entry.is_object() && entry.value("name", json()).is_string() &&
                       entry.value("value", json()).is_string() && entry.value("user", json()).is_string() &&
                       entry.value("reason", json()).is_string() &&
                       entry.value("since_s", json()).is_number_integer() &&
                       entry.value("until_s", json()).is_number_integer();
    if (!right) return std::nullopt;
    standing.push_back({entry["name"], entry["value"], entry["user"], entry["reason"],
                        time_of(entry["since_s"]), time_of(entry["until_s"])});
  }
  return standing;
}

void leave_out(std::vector<StandingForce>& standing, const std::string& name) {
  std::erase_if(standing, [&](const StandingForce& each) { return each.name == name; });
}

}  // namespace

result::Result<std::unique_ptr<ForceService>> ForceService::open(std::filesystem::path file,
                                                                 CellControl& control,
                                                                 access::AuditLog& audit,
                                                                 access::WallClock clock,
                                                                 OnChange on_change) {
  std::vector<StandingForce> standing;
  auto text = files::read_text(file, kMostForceBytes, storage::kPrivateFile);
  if (!text) return result::forward(text);
  if (*text) {
    auto read = from_json(**text);
    if (!read) {
      return result::fail("H0022", {file.string(), 0, 0}, "the list of what is forced is damaged",
                          "release everything with `stepwright unforce --all`, then remove the file");
    }
    standing = std::move(*read);
  }
  return std::unique_ptr<ForceService>(new ForceService(std::move(file), control, audit, std::move(clock),
                                                        std::move(on_change), std::move(standing)));
}

ForceService::ForceService(std::filesystem::path file, CellControl& control, access::AuditLog& audit,
                           access::WallClock clock, OnChange on_change, std::vector<StandingForce> standing)
    : file_(std::move(file)),
      control_(control),
      audit_(audit),
      clock_(std::move(clock)),
      on_change_(std::move(on_change)),
      standing_(std::move(standing)) {
  tell();
  thread_ = std::thread([this] { run(); });
}

ForceService::~ForceService() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  stop_signal_.notify_all();
  thread_.join();
}

result::Result<StandingForce> ForceService::force(const ForceOrder& order) {
  const std::lock_guard turn(turn_);
  const std::vector<StandingForce> before = standing();
  StandingForce fresh{order.name, order.value, order.user, order.reason, clock_(), clock_() + order.duration};
  auto after = before;
  leave_out(after, order.name);
  if (after.size() >= kMostForces)
    return result::fail(kTooMuchForced, {}, "too much is forced already", "release something first");
  after.push_back(fresh);
  // Listed before it is done: who has forced what a crash leaves is known.
  if (auto kept = keep(after); !kept) return result::forward(kept);
  auto forced = control_.force(order.name, order.value, order.duration);
  if (!forced) {
    (void)keep(before);  // at worst something is released that was not forced
    return result::forward(forced);
  }
  after.back().value = fresh.value = *forced;
  missing_.erase(order.name);
  if (auto kept = keep(after); !kept) return result::forward(kept);
  ask_runtime();
  tell();
  return fresh;
}

result::Result<void> ForceService::unforce(const std::string& name) {
  const std::lock_guard turn(turn_);
  if (auto done = control_.unforce(name); !done) return done;
  auto after = standing();
  leave_out(after, name);
  if (auto kept = keep(std::move(after)); !kept) return kept;
  ask_runtime();
  tell();
  return {};
}

void ForceService::look() {
  const std::lock_guard turn(turn_);
  ask_runtime();
  end_what_is_due();
  tell();
}

void ForceService::ask_runtime() {
  if (pause_ > 0) {
    --pause_;
    return;
  }
  const auto forced = control_.forced();
  if (forced) return compare(*forced);
  if (link_is_of_another_version(forced.error())) pause_ = kRoundsOfPause;
}

// What the runtime has beside ours is of somebody else. What it has not, or with another value, has ended.
void ForceService::compare(const std::vector<ForcedPlace>& forced) {
  std::vector<ForcedPlace> others = forced;
  std::set<std::string> missing;
  for (const StandingForce& each : standing()) {
    const auto place = control_.as_forced(each.name, each.value);
    // Nobody answers, or another program has just come: nothing is known. Any other refusal: the program has
    // no such variable any more.
    if (!place && is_asked_again(place.error())) return;
    if (place && std::erase(others, *place) > 0) continue;
    if (!missing_.contains(each.name)) {
      missing.insert(each.name);
      continue;
    }
    if (each.until <= clock_()) {
      take_off(each, "timer", "the time is over that " + each.user + " had set", "done");
      continue;
    }
    const bool taken = place && std::any_of(others.begin(), others.end(), [&](const ForcedPlace& other) {
                         return other.name == place->name;
                       });
    take_off(each, "runtime",
             taken ? "somebody else has forced it since" : "the runtime does not force it any more", "seen");
  }
  missing_ = std::move(missing);
  const std::lock_guard lock(mutex_);
  others_ = std::move(others);
}

// Where the disk is full it stays listed and is taken off again and again, which harms nobody.
void ForceService::take_off(const StandingForce& gone, const char* by, const std::string& why,
                            const std::string& result) {
  auto left = standing();
  leave_out(left, gone.name);
  (void)keep(std::move(left));
  (void)audit_.append({.user = by,
                       .action = "tag.unforce",
                       .target = gone.name,
                       .before = gone.value,
                       .reason = why,
                       .result = result});
}

// The runtime does it by itself; here it is done for one that is late, or that cannot tell what it forces.
void ForceService::end_what_is_due() {
  const auto now = clock_();
  for (const StandingForce& each : standing()) {
    // What has perhaps ended already is not released before that is sure: it may be somebody else's.
    if (each.until > now || missing_.contains(each.name)) continue;
    // Tried again in a second. A refusal means that there is nothing to release any more: another program
    // runs.
    const auto released = control_.unforce(each.name);
    if (!released && is_asked_again(released.error())) return;
    take_off(each, "timer", "the time is over that " + each.user + " had set",
             released ? "done" : "refused: " + released.error().front().message);
  }
}

result::Result<void> ForceService::keep(std::vector<StandingForce> standing) {
  if (auto written = files::replace_file(file_, text_of(to_json(standing, {})), storage::kPrivateFile);
      !written)
    return written;
  {
    const std::lock_guard lock(mutex_);
    standing_ = std::move(standing);
  }
  tell();
  return {};
}

void ForceService::tell() {
  std::string now = json();
  if (now == told_) return;
  told_ = std::move(now);
  on_change_(told_);
}

std::vector<StandingForce> ForceService::standing() const {
  const std::lock_guard lock(mutex_);
  return standing_;
}

std::string ForceService::json() const {
  nlohmann::json document;
  {
    const std::lock_guard lock(mutex_);
    document = to_json(standing_, others_);
  }
  const auto program = control_.program();
  for (nlohmann::json& each : document["forces"]) {
    each["also"] = program ? shared_places(*program, each["name"].get_ref<const std::string&>())
                           : std::vector<std::string>();
  }
  return text_of(document);
}

std::vector<std::string> ForceService::names() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const StandingForce& each : standing_) names.push_back(each.name);
  for (const ForcedPlace& each : others_) names.push_back(each.name);
  return names;
}

void ForceService::run() {
  std::unique_lock lock(mutex_);
  while (!stop_signal_.wait_for(lock, std::chrono::seconds(1), [this] { return stopping_; })) {
    lock.unlock();
    look();
    lock.lock();
  }
}

}  // namespace stepwright::api
