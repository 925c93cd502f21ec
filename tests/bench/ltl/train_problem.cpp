#include "tests/bench/ltl/train_problem.h"

#include <fstream>
#include <iterator>
#include <random>

#include "supervisor/ltl/scene/scene_reader.h"
#include "supervisor/ltl/train/walls.h"

namespace stepwright::bench {

using namespace ltl;

std::optional<Floor> published_floor(const std::string& name) {
  const std::string file = std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/ltl/" + name;
  std::ifstream in(file);
  auto floor = read_scene(std::string(std::istreambuf_iterator<char>(in), {}), file);
  if (!floor) return std::nullopt;
  return *std::move(floor);
}

Problem train_problem(const Floor& floor, const std::string& task, std::size_t trailers, std::uint64_t seed) {
  Problem problem{floor, {.trailers = trailers}, {}, task};
  TrainModel wide = problem.train;
  wide.length_m += 0.2;
  wide.width_m += 0.2;
  const Walls walls(floor, wide);
  const auto map = make_regions(floor);
  std::mt19937_64 dice(seed);
  std::uniform_real_distribution<double> x(-30.0, 30.0), y(-25.0, 25.0), heading(-3.14, 3.14);
  while (map) {
    problem.start = {x(dice), y(dice), heading(dice)};
    const LinkBoxes boxes = link_boxes(wide, standing_at(wide, problem.start));
    bool is_free = !walls.meet(boxes, wide.links());
    for (std::size_t link = 0; link < wide.links() && is_free; ++link) {
      const std::uint32_t region = map->locate(boxes[link].middle);
      is_free = region != kNoRegion && map->region(region).label == 0;
    }
    if (is_free) break;
  }
  return problem;
}

}  // namespace stepwright::bench
