#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

constexpr std::size_t kWays = 4;
enum Port : std::size_t { kIn, kWay, kSelect = kWay + kWays, kElse = kSelect + kWays };

// A hose over several places: the first way that is selected takes it, or the one called `otherwise`.
class Selector final : public Component {
 public:
  void evaluate(std::uint32_t stage, const Frame& f) const override {
    const std::size_t way = way_now(f);
    if (stage == 0) {
      for (const std::uint32_t what : {kPressure, kAvailable, kTemperature})
        across(f, kIn, what) = across(f, way, what);
      return;
    }
    for (std::size_t i = 0; i <= kWays; ++i) {
      const std::size_t port = i < kWays ? kWay + i : static_cast<std::size_t>(kElse);
      for (const std::uint32_t what : {kFlow, kHeatFlow})
        through(f, port, what) = port == way ? through(f, kIn, what) : 0.0;
    }
  }

 private:
  std::size_t way_now(const Frame& f) const {
    for (std::size_t i = 0; i < kWays; ++i)
      if (across(f, kSelect + i) >= 0.5) return kWay + i;
    return kElse;
  }
};

}  // namespace

ComponentType selector_type() {
  ComponentType type = {.name = "selector",
                        .meaning =
                            "joins its inlet to the first of four ways that is selected; to none of them: to "
                            "otherwise, or the floor",
                        .parameters = {},
                        .ports = {{.name = "in",
                                   .kind = PortKind::Fluid,
                                   .role = Role::Node,
                                   .reads = 1,
                                   .meaning = "the pump or pipe that leads here"}},
                        .faults = {},
                        .stages = 2,
                        .make = [](const Parameters&) { return std::make_unique<Selector>(); }};
  for (std::size_t i = 1; i <= kWays; ++i)
    type.ports.push_back({.name = "way_" + std::to_string(i),
                          .kind = PortKind::Fluid,
                          .stage = 1,
                          .reads = 0,
                          .open = Open::Floor,
                          .meaning = "where it leads when it is selected"});
  for (std::size_t i = 1; i <= kWays; ++i)
    type.ports.push_back({.name = "select_" + std::to_string(i),
                          .kind = PortKind::Logic,
                          .reads = 0,
                          .open = Open::Constant,
                          .meaning = "takes that way"});
  type.ports.push_back({.name = "otherwise",
                        .kind = PortKind::Fluid,
                        .stage = 1,
                        .reads = 0,
                        .open = Open::Floor,
                        .meaning = "the way that it takes when none is selected"});
  return type;
}

}  // namespace stepwright::components::library
