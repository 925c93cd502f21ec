#include "hmi_web/api/internal/known_names.h"

#include "runtime/ground/result/closest.h"

namespace stepwright::api {
namespace {

constexpr std::size_t kMostEdits = 2;

}  // namespace

std::string names_hint(const std::string& name, const std::vector<std::string>& known) {
  if (const std::string* meant = result::closest(name, known, kMostEdits))
    return "did you mean '" + *meant + "'?";
  if (known.empty()) return "none";
  std::string all;
  for (const std::string& each : known) all += (all.empty() ? "" : ", ") + each;
  return "possible: " + all;
}

}  // namespace stepwright::api
