#include "hmi_web/protocol/pictures.h"

#include <utility>

#include "hmi_web/protocol/json_text.h"

namespace stepwright::protocol {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestName = 64;

bool has_word(const json& picture, const char* key) {
  const auto found = picture.find(key);
  if (found == picture.end() || !found->is_string()) return false;
  const auto size = found->get_ref<const std::string&>().size();
  return size > 0 && size <= kLongestName;
}

}  // namespace

std::optional<std::string> pictures_message(const std::string& document) {
  if (document.size() > kMostPicturesBytes) return std::nullopt;
  // Writing a value out again recurses, so that what is nested deeper than any picture is left out.
  constexpr int kMaxDepth = 12;
  const auto shallow = [](int depth, json::parse_event_t, json&) { return depth < kMaxDepth; };
  json said = json::parse(document, shallow, /*allow_exceptions=*/false);
  if (!said.is_object()) return std::nullopt;
  const auto list = said.find("pictures");
  if (list == said.end() || !list->is_array()) return std::nullopt;
  json pictures = json::array();
  for (json& picture : *list) {
    if (pictures.size() >= kMostPictures) break;
    if (picture.is_object() && has_word(picture, "kind") && has_word(picture, "id"))
      pictures.push_back(std::move(picture));
  }
  return text({{"type", "pictures"}, {"pictures", std::move(pictures)}});
}

}  // namespace stepwright::protocol
