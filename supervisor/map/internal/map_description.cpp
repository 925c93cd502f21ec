#include "supervisor/map/internal/map_description.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "runtime/ground/result/closest.h"

namespace stepwright::fleet::internal {

namespace {

constexpr double kSmallestResolution_m = 1e-3;
constexpr double kLargestResolution_m = 10.0;
constexpr double kFarthestOrigin_m = 1e6;

const std::vector<std::string>& known_keys() {
  static const std::vector<std::string> keys = {"image",           "resolution",  "origin", "negate",
                                                "occupied_thresh", "free_thresh", "mode"};
  return keys;
}

class DescriptionReader {
 public:
  explicit DescriptionReader(const std::string& file) : file_(file) {}

  result::Result<MapDescription> read(const YAML::Node& root) {
    if (!root.IsMap()) {
      complain(root.Mark(), "a map file is a table of keys and values",
               "the keys are image, resolution, origin, negate, occupied_thresh and free_thresh");
      return tl::unexpected(std::move(diagnostics_));
    }
    check_keys(root);
    MapDescription map;
    map.image = image(root);
    map.resolution_m = number(root, "resolution", kSmallestResolution_m, kLargestResolution_m);
    map.origin = origin(root);
    map.negate = negate(root);
    map.occupied_thresh = number(root, "occupied_thresh", 0.0, 1.0);
    map.free_thresh = number(root, "free_thresh", 0.0, 1.0);
    check_mode(root);
    if (diagnostics_.empty() && map.free_thresh > map.occupied_thresh) {
      complain(
          root["free_thresh"].Mark(),
          fmt::format("free_thresh {} is above occupied_thresh {}", map.free_thresh, map.occupied_thresh),
          "a cell between the two is unknown: free_thresh is the smaller one");
    }
    if (!diagnostics_.empty()) return tl::unexpected(std::move(diagnostics_));
    return map;
  }

 private:
  void complain(const YAML::Mark& mark, std::string message, std::string hint = {}) {
    const auto from_one = [](int k) { return k < 0 ? 0u : static_cast<std::uint32_t>(k) + 1; };
    diagnostics_.push_back({"F0103",
                            result::Severity::Error,
                            {file_, from_one(mark.line), from_one(mark.column)},
                            std::move(message),
                            std::move(hint)});
  }

  void check_keys(const YAML::Node& root) {
    std::set<std::string> seen;
    for (const auto& entry : root) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : std::string("?");
      const auto& known = known_keys();
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        const std::string* meant = result::closest(key, known, 3);
        complain(entry.first.Mark(), fmt::format("unknown key '{}'", key),
                 meant != nullptr ? fmt::format("did you mean '{}'?", *meant) : std::string());
      } else if (!seen.insert(key).second) {
        complain(entry.first.Mark(), fmt::format("the key '{}' is there twice", key));
      }
    }
  }

  // The scalar of a key; complains where there is none.
  std::optional<YAML::Node> scalar(const YAML::Node& root, const char* key) {
    const YAML::Node value = root[key];
    if (!value) {
      complain(root.Mark(), fmt::format("the key '{}' is missing", key));
      return std::nullopt;
    }
    if (!value.IsScalar()) {
      complain(value.Mark(), fmt::format("'{}' is one value, not a list or table", key));
      return std::nullopt;
    }
    return value;
  }

  std::string image(const YAML::Node& root) {
    const auto value = scalar(root, "image");
    if (value && value->Scalar().empty()) complain(value->Mark(), "'image' is empty");
    return value ? value->Scalar() : std::string();
  }

  double number_of(const YAML::Node& value, const char* key, double least, double most) {
    double number = 0.0;
    if (!value.IsScalar() || !YAML::convert<double>::decode(value, number) || !std::isfinite(number)) {
      complain(value.Mark(), fmt::format("'{}' is a number", key));
    } else if (number < least || number > most) {
      complain(value.Mark(), fmt::format("'{}' is {}, outside {} to {}", key, number, least, most));
    }
    return number;
  }

  double number(const YAML::Node& root, const char* key, double least, double most) {
    const auto value = scalar(root, key);
    return value ? number_of(*value, key, least, most) : 0.0;
  }

  geometry::Point origin(const YAML::Node& root) {
    const YAML::Node value = root["origin"];
    if (!value || !value.IsSequence() || value.size() != 3) {
      complain(value ? value.Mark() : root.Mark(), "'origin' is a list of three numbers: x, y and yaw",
               "origin: [0.0, 0.0, 0.0]");
      return {};
    }
    const double yaw = number_of(value[2], "origin", -kFarthestOrigin_m, kFarthestOrigin_m);
    if (yaw != 0.0) {
      complain(value[2].Mark(), fmt::format("the map is turned by {} rad; only 0 is read", yaw),
               "turn the image and set the yaw to 0");
    }
    return {number_of(value[0], "origin", -kFarthestOrigin_m, kFarthestOrigin_m),
            number_of(value[1], "origin", -kFarthestOrigin_m, kFarthestOrigin_m)};
  }

  bool negate(const YAML::Node& root) {
    const auto value = scalar(root, "negate");
    if (!value) return false;
    const std::string& text = value->Scalar();
    if (text == "1" || text == "true") return true;
    if (text != "0" && text != "false") complain(value->Mark(), "'negate' is 0 or 1");
    return false;
  }

  void check_mode(const YAML::Node& root) {
    if (!root["mode"]) return;
    const auto mode = scalar(root, "mode");
    if (!mode || mode->Scalar() == "trinary") return;
    complain(mode->Mark(), fmt::format("mode '{}' is not read", mode->Scalar()),
             "only trinary is: free, occupied, unknown");
  }

  const std::string& file_;
  result::Diagnostics diagnostics_;
};

}  // namespace

result::Result<MapDescription> read_description(std::string_view text, const std::string& file) {
  try {
    return DescriptionReader(file).read(YAML::Load(std::string(text)));
  } catch (const YAML::Exception& error) {
    const bool known = !error.mark.is_null();
    return result::fail("F0102",
                        {file, known ? static_cast<std::uint32_t>(error.mark.line) + 1 : 0,
                         known ? static_cast<std::uint32_t>(error.mark.column) + 1 : 0},
                        "this is not YAML: " + error.msg);
  }
}

}  // namespace stepwright::fleet::internal
