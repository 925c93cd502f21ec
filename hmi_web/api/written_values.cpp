#include "hmi_web/api/written_values.h"

#include <utility>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::api {
namespace {

// One may have been on its way when the value was taken; the next one was not.
constexpr std::uint64_t kShownAfter = 2;

}  // namespace

void WrittenValues::note(std::string_view name, std::string text, std::uint64_t images) {
  const std::lock_guard lock(mutex_);
  std::erase_if(values_, [&](const auto& each) { return each.second.images + kShownAfter <= images; });
  values_.insert_or_assign(naming::upper(name), Written{std::move(text), images});
}

std::optional<std::string> WrittenValues::of(std::string_view name, std::uint64_t images) {
  const std::lock_guard lock(mutex_);
  const auto found = values_.find(naming::upper(name));
  if (found == values_.end() || found->second.images + kShownAfter <= images) return std::nullopt;
  return found->second.text;
}

}  // namespace stepwright::api
