#include "hmi_web/change/version_store.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "hmi_web/change/codes.h"
#include "hmi_web/change/version_file.h"
#include "hmi_web/storage/private_files.h"
#include "runtime/ground/files/durable_file.h"

namespace stepwright::change {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".version";
// Of a folder that somebody has filled: more files are not looked at.
constexpr std::size_t kMostFiles = 10 * kMostVersions;

auto unknown(const std::string& digest) {
  return result::fail(kNoSuchVersion, {}, "there is no program " + digest.substr(0, 12) + " here",
                      "it may have been forgotten meanwhile: the list says which ones are kept");
}

auto spoilt(const fs::path& file, const std::string& what) {
  return damaged_version(file.string(), what);
}

result::Result<std::string> read_version(const fs::path& file) {
  std::error_code error;
  // A link would lead out of the folder, a pipe would never end.
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return spoilt(file, "it is no plain file");
  auto bytes = files::read_bounded(file, kLargestVersionFile);
  return bytes ? result::Result<std::string>(*std::move(bytes)) : spoilt(file, "it cannot be read");
}

void sort_newest_first(auto& kept) {
  std::stable_sort(kept.begin(), kept.end(),
                   [](const auto& a, const auto& b) { return a.version.when > b.version.when; });
}

}  // namespace

result::Result<std::unique_ptr<VersionStore>> VersionStore::open(fs::path folder) {
  if (auto made = files::make_private_folder(folder, storage::kPrivateFile); !made)
    return result::forward(made);
  std::unique_ptr<VersionStore> store(new VersionStore(std::move(folder)));
  store->read_folder();
  for (const Version& version : store->list()) {
    if (version.outcome != Outcome::Trial) continue;
    if (auto settled = store->settle(version.digest, Outcome::Unknown, ""); !settled)
      return result::forward(settled);
  }
  return store;
}

fs::path VersionStore::file_of(const std::string& digest) const {
  return folder_ / (digest + std::string(kEnding));
}

void VersionStore::read_folder() {
  const std::lock_guard lock(mutex_);
  std::error_code error;
  std::size_t looked = 0;
  for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
    const std::string file = at->path().filename().string();
    if (!file.ends_with(kEnding)) continue;
    if (++looked > kMostFiles) break;
    auto bytes = read_version(at->path());
    auto read = bytes ? from_file(*bytes, at->path().string())
                      : result::Result<VersionFile>(tl::unexpected(bytes.error()));
    if (read && read->version.digest + std::string(kEnding) != file)
      read = spoilt(at->path(), "it holds the program " + read->version.digest.substr(0, 12));
    if (read) {
      kept_.push_back({std::move(read->version), read->container.size()});
    } else {
      damaged_.push_back(read.error().front());
    }
  }
  sort_newest_first(kept_);
}

std::vector<VersionStore::Kept>::iterator VersionStore::at(const std::string& digest) {
  return std::find_if(kept_.begin(), kept_.end(),
                      [&](const Kept& each) { return each.version.digest == digest; });
}

std::vector<Version> VersionStore::list() const {
  const std::lock_guard lock(mutex_);
  std::vector<Version> versions;
  for (const Kept& each : kept_) versions.push_back(each.version);
  return versions;
}

std::optional<Version> VersionStore::find(const std::string& digest) const {
  for (Version& each : list()) {
    if (each.digest == digest) return std::move(each);
  }
  return std::nullopt;
}

result::Diagnostics VersionStore::damaged() const {
  const std::lock_guard lock(mutex_);
  return damaged_;
}

result::Result<std::vector<std::byte>> VersionStore::container(const std::string& digest) const {
  if (!find(digest)) return unknown(digest);  // nothing but a known digest becomes a path
  const std::lock_guard lock(mutex_);
  const fs::path file = file_of(digest);
  auto bytes = read_version(file);
  if (!bytes) return result::forward(bytes);
  auto read = from_file(*bytes, file.string());
  if (!read) return result::forward(read);
  if (read->version.digest != digest) return spoilt(file, "it holds another program");
  return std::vector<std::byte>(read->container.begin(), read->container.end());
}

result::Result<void> VersionStore::write(const Version& version, std::span<const std::byte> container) {
  return files::replace_file(file_of(version.digest), to_file(version, container), storage::kPrivateFile);
}

result::Result<void> VersionStore::put(const Version& version, std::span<const std::byte> container) {
  const std::lock_guard lock(mutex_);
  if (auto written = write(version, container); !written) return written;
  if (const auto known = at(version.digest); known != kept_.end()) kept_.erase(known);
  kept_.insert(kept_.begin(), {version, container.size()});
  sort_newest_first(kept_);
  return {};
}

result::Result<void> VersionStore::settle(const std::string& digest, Outcome outcome,
                                          const std::string& note) {
  auto bytes = container(digest);
  if (!bytes) return result::forward(bytes);
  const std::lock_guard lock(mutex_);
  const auto known = at(digest);
  if (known == kept_.end()) return unknown(digest);
  Version version = known->version;
  version.outcome = outcome;
  version.note = note;
  if (auto written = write(version, *bytes); !written) return written;
  known->version = std::move(version);
  return {};
}

result::Result<void> VersionStore::remove(const std::string& digest) {
  const std::lock_guard lock(mutex_);
  const auto known = at(digest);
  if (known == kept_.end()) return unknown(digest);
  if (auto removed = files::remove_file(file_of(digest), storage::kPrivateFile); !removed)
    return result::forward(removed);
  kept_.erase(known);
  return {};
}

result::Result<void> VersionStore::trim(const std::string& keep, const std::string& keep_too) {
  const std::lock_guard lock(mutex_);
  const auto too_much = [&] {
    std::size_t bytes = 0;
    for (const Kept& each : kept_) bytes += each.bytes;
    return kept_.size() > kMostVersions || bytes > kMostVersionBytes;
  };
  for (std::size_t i = kept_.size(); i-- > 0 && too_much();) {
    const std::string& digest = kept_[i].version.digest;
    if (digest == keep || digest == keep_too) continue;
    if (auto removed = files::remove_file(file_of(digest), storage::kPrivateFile); !removed)
      return result::forward(removed);
    kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return {};
}

}  // namespace stepwright::change
