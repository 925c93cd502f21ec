#include "supervisor/ltl/scene/problem_reader.h"

#include <cmath>
#include <fstream>
#include <optional>
#include <utility>

#include "supervisor/ltl/scene/internal/json_text.h"
#include "supervisor/ltl/scene/map_floor.h"
#include "supervisor/ltl/scene/scene_reader.h"
#include "supervisor/map/map_file.h"

namespace stepwright::ltl {

namespace {

using internal::Complaints;
using internal::is_object;
using internal::kFarthest_m;
using internal::member;
using internal::number;
using nlohmann::json;

constexpr std::uintmax_t kMostBytes = 64u << 20;

// Nothing for what is no file, or too large a one.
std::optional<std::string> read_file(const std::filesystem::path& path) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) return std::nullopt;
  const std::uintmax_t bytes = std::filesystem::file_size(path, failed);
  if (failed || bytes > kMostBytes) return std::nullopt;
  std::string text(bytes, '\0');
  std::ifstream in(path, std::ios::binary);
  if (!in.read(text.data(), static_cast<std::streamsize>(bytes))) return std::nullopt;
  return text;
}

class ProblemReader {
 public:
  ProblemReader(const json& root, const std::filesystem::path& file, const TrainModel& train)
      : root_(root), file_(file), wrong_(file.string()) {
    problem_.train = train;
  }

  result::Result<Problem> read() {
    if (is_object(root_, "", {"scene", "map", "train", "start", "task"}, wrong_)) {
      read_floor();
      read_train();
      read_start();
      read_task();
    }
    if (!wrong_.found.empty()) return tl::unexpected(std::move(wrong_.found));
    return std::move(problem_);
  }

 private:
  void read_floor() {
    const json& map = member(root_, "map");
    const json& scene = member(root_, "scene");
    if (map.is_null() && scene.is_null())
      wrong_.add("L0402", "scene", "is missing", "the name of a GeoJSON file, or \"map\" with a map.yaml");
    if (!map.is_null() && !read_map_floor(map)) return;
    if (!scene.is_null()) read_scene_floor(scene, map.is_null() ? Border::InTheScene : Border::FromElsewhere);
  }

  static bool is_file_name(const json& name) {
    return name.is_string() && name.get_ref<const std::string&>().find('\0') == std::string::npos;
  }

  bool read_map_floor(const json& name) {
    if (!is_file_name(name)) {
      wrong_.add("L0402", "map", "is no file name");
      return false;
    }
    auto map = fleet::read_map(file_.parent_path() / name.get<std::string>());
    if (map)
      problem_.floor = floor_of(*map, name.get<std::string>());
    else
      wrong_.take(std::move(map.error()));
    return map.has_value();
  }

  void read_scene_floor(const json& name, Border border) {
    if (!is_file_name(name)) return wrong_.add("L0402", "scene", "is no file name");
    const auto path = file_.parent_path() / name.get<std::string>();
    const auto text = read_file(path);
    if (!text) return wrong_.add("L0401", "scene", "'" + path.string() + "' cannot be read, or is too large");
    auto floor = read_scene(*text, path.string(), std::move(problem_.floor), border);
    if (!floor) return wrong_.take(std::move(floor.error()));
    problem_.floor = *std::move(floor);
  }

  void read_train() {
    const json& train = member(root_, "train");
    if (train.is_null()) return;
    if (!is_object(train, "train",
                   {"trailers", "reading", "hitch_m", "wheelbase_m", "length_m", "width_m", "spacing_m",
                    "most_speed_m_s", "most_lock_rad", "most_acceleration_m_s2", "most_lock_rate_rad_s",
                    "most_hitch_rad"},
                   wrong_))
      return;
    read_figures(train);
    if (const json& count = member(train, "trailers"); !count.is_null()) {
      const auto read = number(count, "train.trailers", 0, kMostTrailers, wrong_);
      if (read && *read != std::floor(*read)) wrong_.add("L0402", "train.trailers", "is no whole number");
      if (read) problem_.train.trailers = static_cast<std::size_t>(*read);
    }
    if (const json& reading = member(train, "reading"); !reading.is_null()) {
      if (reading == "printed")
        problem_.train.reading = HitchReading::Printed;
      else if (reading != "pulled")
        wrong_.add("L0402", "train.reading", "is none of pulled, printed");
    }
    if (auto sound = validate(problem_.train); !sound) wrong_.take(std::move(sound.error()));
  }

  void read_figures(const json& train) {
    TrainModel& model = problem_.train;
    const std::pair<const char*, double*> figures[] = {
        {"hitch_m", &model.hitch_m},
        {"wheelbase_m", &model.wheelbase_m},
        {"length_m", &model.length_m},
        {"width_m", &model.width_m},
        {"spacing_m", &model.spacing_m},
        {"most_speed_m_s", &model.most_speed_m_s},
        {"most_lock_rad", &model.most_lock_rad},
        {"most_acceleration_m_s2", &model.most_acceleration_m_s2},
        {"most_lock_rate_rad_s", &model.most_lock_rate_rad_s},
        {"most_hitch_rad", &model.most_hitch_rad},
    };
    for (const auto& [name, into] : figures) {
      const json& value = member(train, name);
      if (value.is_null()) continue;
      if (const auto read = number(value, std::string("train.") + name, 0.0, 1000.0, wrong_)) *into = *read;
    }
  }

  void read_start() {
    const json& start = member(root_, "start");
    if (start.is_null()) return wrong_.add("L0402", "start", "is missing");
    if (!is_object(start, "start", {"x_m", "y_m", "heading_rad"}, wrong_)) return;
    const auto read_member = [&](const char* name, double most, double& into) {
      const std::string key = std::string("start.") + name;
      if (member(start, name).is_null()) return wrong_.add("L0402", key, "is missing");
      if (const auto read = number(member(start, name), key, -most, most, wrong_)) into = *read;
    };
    read_member("x_m", kFarthest_m, problem_.start.x_m);
    read_member("y_m", kFarthest_m, problem_.start.y_m);
    read_member("heading_rad", 10.0, problem_.start.heading_rad);
  }

  void read_task() {
    const json& task = member(root_, "task");
    if (!task.is_string())
      return wrong_.add("L0402", "task", "is missing or no text", "a formula over the scene's places");
    problem_.task = task.get<std::string>();
  }

  const json& root_;
  const std::filesystem::path& file_;
  Complaints wrong_;
  Problem problem_;
};

}  // namespace

result::Result<Problem> read_planning_problem(std::string_view text, const std::filesystem::path& file,
                                              const TrainModel& train) {
  auto root = internal::parse(text, file.string());
  if (!root) return result::forward(root);
  return ProblemReader(*root, file, train).read();
}

}  // namespace stepwright::ltl
