#include "hmi_web/change/version_file.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "hmi_web/access/secrets.h"
#include "hmi_web/change/codes.h"

namespace stepwright::change {
namespace {

using nlohmann::json;
using std::chrono::system_clock;

constexpr std::array kOutcomes = {Outcome::Found, Outcome::Trial, Outcome::Kept, Outcome::RolledBack,
                                  Outcome::Unknown};
constexpr std::size_t kLongestText = 1'024;  // of a member

std::string cut(const std::string& text) {
  return text.substr(0, kLongestText);
}

std::optional<std::string> text_of(const json& head, const char* key) {
  const auto found = head.find(key);
  if (found == head.end() || !found->is_string()) return std::nullopt;
  auto text = found->get<std::string>();
  if (text.size() > kLongestText) return std::nullopt;
  return text;
}

std::optional<Outcome> outcome_of(const std::string& text) {
  const auto* found =
      std::find_if(kOutcomes.begin(), kOutcomes.end(), [&](Outcome each) { return to_string(each) == text; });
  return found == kOutcomes.end() ? std::nullopt : std::optional(*found);
}

std::optional<Version> version_of(const json& head) {
  if (!head.is_object() || head.value("format", json()) != 1) return std::nullopt;
  Version version;
  const std::array<std::pair<const char*, std::string*>, 6> texts = {{{"digest", &version.digest},
                                                                      {"name", &version.name},
                                                                      {"user", &version.user},
                                                                      {"reason", &version.reason},
                                                                      {"replaced", &version.replaced},
                                                                      {"note", &version.note}}};
  for (const auto& [key, text] : texts) {
    auto found = text_of(head, key);
    if (!found) return std::nullopt;
    *text = *std::move(found);
  }
  const json when = head.value("when_s", json());
  const auto outcome = outcome_of(text_of(head, "outcome").value_or(""));
  if (!when.is_number_unsigned() || !outcome) return std::nullopt;
  // Later than the year 9999 is no time of ours, and would not fit the clock.
  const auto seconds = when.get<std::uint64_t>();
  if (seconds > 253'402'300'799u) return std::nullopt;
  version.when = system_clock::time_point(std::chrono::seconds(seconds));
  version.outcome = *outcome;
  const bool known = is_digest(version.digest) && (version.replaced.empty() || is_digest(version.replaced));
  return known ? std::optional(std::move(version)) : std::nullopt;
}

}  // namespace

const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::Found:
      return "found";
    case Outcome::Trial:
      return "trial";
    case Outcome::Kept:
      return "kept";
    case Outcome::RolledBack:
      return "rolled_back";
    case Outcome::Unknown:
      return "unknown";
  }
  return "unknown";
}

bool is_digest(std::string_view text) {
  return text.size() == 64 && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
         });
}

tl::unexpected<result::Diagnostics> damaged_version(const std::string& name, const std::string& what) {
  return result::fail(kVersionDamaged, {name, 0, 0}, "the file of a program version is damaged: " + what,
                      "restore it from a copy, or remove it");
}

std::string to_file(const Version& version, std::span<const std::byte> container) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(version.when.time_since_epoch());
  const json head = {{"format", 1},
                     {"digest", version.digest},
                     {"name", cut(version.name)},
                     {"user", cut(version.user)},
                     {"reason", cut(version.reason)},
                     {"replaced", version.replaced},
                     {"when_s", static_cast<std::uint64_t>(std::max<std::int64_t>(seconds.count(), 0))},
                     {"outcome", to_string(version.outcome)},
                     {"note", cut(version.note)}};
  std::string bytes = head.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
  bytes.append(reinterpret_cast<const char*>(container.data()), container.size());
  return bytes;
}

result::Result<VersionFile> from_file(std::string_view bytes, const std::string& name) {
  if (bytes.size() > kLargestVersionFile) return damaged_version(name, "it is too long");
  const std::size_t end = bytes.substr(0, kLongestHead).find('\n');
  if (end == std::string_view::npos) return damaged_version(name, "its first line has no end");
  const json head = json::parse(bytes.substr(0, end), nullptr, /*allow_exceptions=*/false);
  auto version = version_of(head);
  if (!version) return damaged_version(name, "its first line does not describe a version");
  const std::string_view container = bytes.substr(end + 1);
  if (access::sha256_hex(container) != version->digest)
    return damaged_version(name,
                           "its program is not the one with the digest " + version->digest.substr(0, 12));
  return VersionFile{*std::move(version), std::as_bytes(std::span(container))};
}

}  // namespace stepwright::change
