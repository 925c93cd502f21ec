#include "hmi_web/screens/screen_store.h"

#include <algorithm>
#include <cstdio>
#include <system_error>
#include <utility>

#include "hmi_web/screens/codes.h"
#include "hmi_web/screens/version_text.h"
#include "hmi_web/storage/private_files.h"
#include "runtime/ground/files/durable_file.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::screens {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestHead = 4'096;

// No screen has a name that begins with a dot.
constexpr const char* kStart = ".start";
// Of folders from before: beside it no folder of a screen called so could stand.
constexpr const char* kOldStart = "start";

// ".start", ".start-operator".
std::string start_file(const std::string& role, const char* name = kStart) {
  return role.empty() ? name : std::string(name) + "-" + role;
}
bool has_start(const std::string& role) {
  return role.empty() || std::find(kStartRoles.begin(), kStartRoles.end(), role) != kStartRoles.end();
}

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

auto unknown(const std::string& name) {
  return result::fail(kNoSuchScreen, {}, "there is no screen '" + name + "'",
                      "somebody may have removed it meanwhile");
}

bool is_same(const Version& one, const Version& other) {
  return one.saved_by == other.saved_by && one.based_on == other.based_on && one.aside && other.aside;
}

}  // namespace

const Version* Screen::current() const {
  const auto found =
      std::find_if(versions.rbegin(), versions.rend(), [](const Version& each) { return !each.aside; });
  return found == versions.rend() ? nullptr : &*found;
}

const Version* Screen::shown() const {
  const Version* const now = current();
  return now == nullptr || now->removed || now->is_symbol ? nullptr : now;
}

namespace {

bool is_name(std::string_view name) {
  return !name.empty() && name.size() <= kLongestName && is_letter_or_digit(name.front()) &&
         is_letter_or_digit(name.back()) && std::all_of(name.begin(), name.end(), [](char c) {
           return is_letter_or_digit(c) || c == ' ' || c == '.' || c == '_' || c == '-';
         });
}

}  // namespace

result::Result<void> check_name(std::string_view name) {
  if (is_name(name) && naming::upper(name).ends_with(".SVG"))
    return result::fail(kNoName, {}, "the name of a screen does not end in .svg",
                        "NAME.svg is the file of a screen that somebody has put there");
  if (name == "server.lock")
    return result::fail(kNoName, {}, "a screen cannot be called server.lock",
                        "the server keeps a file of that name in the folder of screens");
  if (is_name(name)) return {};
  return result::fail(
      kNoName, {}, "this cannot be the name of a screen",
      "up to 64 letters, digits, blanks and . _ - of ASCII; a letter or a digit at both ends");
}

result::Result<std::unique_ptr<ScreenStore>> ScreenStore::open(fs::path folder) {
  if (auto made = files::make_private_folder(folder, storage::kPrivateFile); !made)
    return result::forward(made);
  std::unique_ptr<ScreenStore> store(new ScreenStore(std::move(folder)));
  store->look();
  return store;
}

void ScreenStore::look() {
  std::error_code error;
  for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
    const fs::file_status status = at->symlink_status(error);
    if (fs::is_directory(status) && is_name(at->path().filename().string()))
      look_at_folder(at->path());
    else if (fs::is_regular_file(status) && at->path().extension() == ".svg")
      look_at_file(at->path());
  }
  for (auto& [name, screen] : screens_)
    std::sort(screen.versions.begin(), screen.versions.end(),
              [](const Version& a, const Version& b) { return a.number < b.number; });
  look_at_starts();
}

void ScreenStore::look_at_starts() {
  std::vector<std::string> roles(kStartRoles.begin(), kStartRoles.end());
  roles.emplace_back();
  for (const std::string& role : roles) {
    move_start(role);
    const auto text = files::read_bounded(folder_ / start_file(role), kLongestName);
    if (text && is_name(*text)) starts_[role] = *text;
  }
}

// From where it stood before, with what a failure has left beside it.
void ScreenStore::move_start(const std::string& role) {
  std::error_code error;
  const fs::path old = folder_ / start_file(role, kOldStart);
  const fs::path half = old.string() + ".new";
  if (fs::is_regular_file(fs::symlink_status(half, error))) fs::remove(half, error);
  if (!fs::is_regular_file(fs::symlink_status(old, error))) return;
  const fs::path now = folder_ / start_file(role);
  if (!fs::exists(fs::symlink_status(now, error))) {
    const auto text = files::read_bounded(old, kLongestName);
    if (!text || !files::replace_file(now, *text, storage::kPrivateFile))
      return;  // the next start tries again
  }
  static_cast<void>(files::remove_file(old, storage::kPrivateFile));
}

void ScreenStore::look_at_file(const fs::path& file) {
  const std::string name = file.stem().string();
  if (!is_name(name)) return;
  auto drawn = drawing::load_drawing(file);
  if (!drawn) {
    damaged_.insert(damaged_.end(), drawn.error().begin(), drawn.error().end());
    return;
  }
  Screen& screen = screens_[name];
  screen.name = name;
  screen.versions.push_back({.least = drawn->least, .is_symbol = drawn->is_symbol});
}

void ScreenStore::look_at_folder(const fs::path& folder) {
  const std::string name = folder.filename().string();
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const fs::path& file = at->path();
    if (file.extension() != ".json" || !fs::is_regular_file(at->symlink_status(error))) continue;
    const auto text = files::read_bounded(file, kLargestHead);
    auto version = version_from_json(text.value_or(""), file.string());
    if (version && file_of(name, version->number, ".json") != file)
      version = result::fail(kScreenDamaged, {file.string(), 1, 1}, "the file has another version's name");
    if (!version) {
      damaged_.insert(damaged_.end(), version.error().begin(), version.error().end());
      continue;
    }
    Screen& screen = screens_[name];
    screen.name = name;
    screen.versions.push_back(std::move(*version));
  }
}

fs::path ScreenStore::file_of(const std::string& name, std::uint32_t version, const char* ending) const {
  if (version == 0) return folder_ / (name + ending);
  char number[16];
  std::snprintf(number, sizeof number, "%06u", static_cast<unsigned>(version));
  return folder_ / name / (number + std::string(ending));
}

std::vector<Screen> ScreenStore::list() const {
  const std::lock_guard lock(mutex_);
  std::vector<Screen> all;
  for (const auto& [name, screen] : screens_) all.push_back(screen);
  return all;
}

std::optional<Screen> ScreenStore::find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = screens_.find(name);
  if (found == screens_.end()) return std::nullopt;
  return found->second;
}

result::Result<drawing::Drawing> ScreenStore::read(const std::string& name, std::uint32_t version) const {
  const auto screen = find(name);
  if (!screen) return unknown(name);
  const bool known = std::any_of(screen->versions.begin(), screen->versions.end(), [&](const Version& each) {
    return each.number == version && !each.removed;
  });
  if (!known)
    return result::fail(kNoSuchScreen, {},
                        "the screen '" + name + "' has no version " + std::to_string(version),
                        "the oldest ones go when there are more than " + std::to_string(kMostVersions));
  return drawing::load_drawing(file_of(name, version, ".svg"));
}

result::Result<Version> ScreenStore::next(const std::string& name, std::uint32_t based_on) const {
  Version version{.number = 1, .based_on = based_on};
  const auto found = screens_.find(name);
  if (found == screens_.end()) {
    const auto there = std::count_if(screens_.begin(), screens_.end(), [](const auto& each) {
      const Version* now = each.second.current();
      return now != nullptr && !now->removed;
    });
    if (static_cast<std::size_t>(there) >= kMostScreens)
      return result::fail(kNoRoomForScreen, {}, "there are " + std::to_string(there) + " screens already",
                          "remove one that nobody needs");
    return version;
  }
  const Version* now = found->second.current();
  version.number = found->second.versions.back().number + 1;
  // Who begins anew does not come into the way of a screen that was removed.
  version.aside = now != nullptr && now->number != based_on && !(now->removed && based_on == 0);
  return version;
}

result::Result<Version> ScreenStore::write(const std::string& name, const Version& version,
                                           std::string_view svg) {
  if (auto made = files::make_private_folder(folder_ / name, storage::kPrivateFile); !made)
    return result::forward(made);
  if (!version.removed) {
    if (auto done = files::replace_file(file_of(name, version.number, ".svg"), svg, storage::kPrivateFile);
        !done)
      return result::forward(done);
  }
  // With it the version is there.
  auto done =
      files::replace_file(file_of(name, version.number, ".json"), to_json(version), storage::kPrivateFile);
  if (!done) return result::forward(done);
  Screen& screen = screens_[name];
  screen.name = name;
  screen.versions.push_back(version);
  forget_oldest(screen);
  return version;
}

void ScreenStore::forget_oldest(Screen& screen) {
  while (screen.versions.size() > kMostVersions) {
    const std::uint32_t now = screen.current() == nullptr ? 0 : screen.current()->number;
    const auto oldest =
        std::find_if(screen.versions.begin(), screen.versions.end(),
                     [&](const Version& each) { return each.number != 0 && each.number != now; });
    // The head first: a version without one is none.
    static_cast<void>(
        files::remove_file(file_of(screen.name, oldest->number, ".json"), storage::kPrivateFile));
    static_cast<void>(
        files::remove_file(file_of(screen.name, oldest->number, ".svg"), storage::kPrivateFile));
    screen.versions.erase(oldest);
  }
}

result::Result<Version> ScreenStore::save(const Save& save, Time now) {
  if (auto fits = check_name(save.name); !fits) return result::forward(fits);
  auto drawn = drawing::read_drawing(save.name + ".svg", save.svg);
  if (!drawn) return result::forward(drawn);
  const std::lock_guard lock(mutex_);
  auto version = next(save.name, save.based_on);
  if (!version) return version;
  version->saved_by = save.user;
  version->saved = now;
  version->comment = save.comment.substr(0, kLongestComment);
  version->least = drawn->least;
  version->is_symbol = drawn->is_symbol;
  // Who tries again gets no further copy.
  if (version->aside) {
    const Version newest = screens_.at(save.name).versions.back();
    const auto file = file_of(save.name, newest.number, ".svg");
    if (is_same(newest, *version) && files::read_bounded(file, drawing::kLargestFile) == drawn->svg)
      return newest;
  }
  return write(save.name, *version, drawn->svg);
}

result::Result<Version> ScreenStore::remove(const std::string& name, std::uint32_t based_on,
                                            const std::string& user, Time now) {
  const std::lock_guard lock(mutex_);
  const auto found = screens_.find(name);
  const Version* current = found == screens_.end() ? nullptr : found->second.current();
  if (current == nullptr || current->removed) return unknown(name);
  if (current->number != based_on)
    return result::fail(kSavedMeanwhile, {}, "'" + name + "' has a newer version than the one you saw",
                        "look at it before you remove it");
  auto version = next(name, based_on);
  if (!version) return version;
  version->saved_by = user;
  version->saved = now;
  version->least = current->least;
  version->removed = true;
  return write(name, *version, {});
}

std::string ScreenStore::start(const std::string& role) const {
  const std::lock_guard lock(mutex_);
  const auto found = starts_.find(role);
  return found == starts_.end() ? std::string() : found->second;
}

result::Result<void> ScreenStore::set_start(const std::string& name, const std::string& role) {
  if (!has_start(role))
    return result::fail(kNoSuchScreen, {},
                        "no page opens with a screen of the role '" + role.substr(0, 20) + "'",
                        "viewer, operator, engineer, or nothing for everybody");
  const std::lock_guard lock(mutex_);
  if (name.empty()) {
    if (auto done = files::remove_file(folder_ / start_file(role), storage::kPrivateFile); !done)
      return result::forward(done);
    starts_.erase(role);
    return {};
  }
  const auto found = screens_.find(name);
  if (found == screens_.end() || found->second.current() == nullptr || found->second.current()->removed)
    return unknown(name);
  if (auto done = files::replace_file(folder_ / start_file(role), name, storage::kPrivateFile); !done)
    return done;
  starts_[role] = name;
  return {};
}

}  // namespace stepwright::screens
