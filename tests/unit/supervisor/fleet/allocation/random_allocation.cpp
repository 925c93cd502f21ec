#include "tests/unit/supervisor/fleet/allocation/random_allocation.h"

#include <chrono>
#include <cstdint>
#include <random>
#include <string>

namespace stepwright::fleet {

namespace {

using std::chrono::milliseconds;

class Drawing {
 public:
  Drawing(const DrawnSize& size, std::mt19937& random) : size_(size), random_(random) {}

  AllocationProblem draw() {
    draw_ways();
    for (std::uint32_t v = 0; v < size_.vehicles; ++v) draw_vehicle(v);
    for (std::uint32_t t = 0; t < size_.transports; ++t) draw_transport(t);
    if (size_.constraints) {
      const std::uint32_t constraints = below(4);
      for (std::uint32_t c = 0; c < constraints; ++c) draw_constraint(c);
    }
    if (size_.fixed) draw_fixed();
    problem_.objective = {below(3) * 10, below(3), below(2) * 5};
    return problem_;
  }

 private:
  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(random_() % bound); }
  LocationId location() { return LocationId(below(static_cast<std::uint32_t>(problem_.locations.size()))); }
  milliseconds time(std::uint32_t most) { return milliseconds(100 * below(most)); }

  void draw_ways() {
    const std::uint32_t locations = 3 + below(3);
    for (std::uint32_t i = 0; i < locations; ++i) problem_.locations.push_back("l" + std::to_string(i));
    const std::uint32_t classes = 1 + below(2);
    const std::uint32_t missing = below(3) == 0 ? 5 : 40;
    for (std::uint32_t k = 0; k < classes; ++k) {
      TravelTimes times(locations);
      for (std::uint32_t i = 0; i < locations; ++i) {
        for (std::uint32_t j = 0; j < locations; ++j) {
          if (i != j && below(missing) != 0) times.set(LocationId(i), LocationId(j), time(20));
        }
      }
      problem_.classes.push_back(times);
    }
  }

  void draw_vehicle(std::uint32_t v) {
    // Every other time like the vehicle before, so that exchanging the two changes nothing.
    if (v > 0 && below(2) == 0) {
      problem_.vehicles.push_back(problem_.vehicles.back());
      problem_.vehicles.back().name = "v" + std::to_string(v);
      return;
    }
    TransportVehicle vehicle;
    vehicle.name = "v" + std::to_string(v);
    vehicle.vehicle_class = below(static_cast<std::uint32_t>(problem_.classes.size()));
    vehicle.start = location();
    vehicle.capacity = 1 + below(3);
    if (below(3) == 0) vehicle.available = time(10);
    if (below(4) == 0) vehicle.finish = location();
    problem_.vehicles.push_back(vehicle);
  }

  void draw_transport(std::uint32_t t) {
    Transport transport;
    transport.name = "t" + std::to_string(t);
    transport.amount = 1 + below(size_.most_amount);
    transport.from = location();
    transport.to = location();
    transport.pick_up_service = time(3);
    transport.set_down_service = time(3);
    transport.divisible = below(4) != 0;
    if (below(2) == 0) transport.due = time(40);
    transport.weight = 1 + below(3);
    if (size_.fixed && below(6) == 0) transport.vehicle = VehicleId(below(size_.vehicles));
    problem_.transports.push_back(transport);
  }

  TransportTimepoint timepoint() {
    switch (below(5)) {
      case 0:
        return {};
      case 1:
        return start_of(VehicleId(below(size_.vehicles)));
      case 2:
        return start_of(TransportId(below(size_.transports)));
      default:
        return end_of(TransportId(below(size_.transports)));
    }
  }

  void draw_constraint(std::uint32_t c) {
    TransportConstraint constraint;
    constraint.name = "c" + std::to_string(c);
    constraint.from = below(2) == 0 ? TransportTimepoint{} : timepoint();
    constraint.to = timepoint();
    const milliseconds least = time(30) - milliseconds(500);
    constraint.distance = {below(2) == 0 ? least : milliseconds(-100'000'000),
                           below(3) != 0 ? least + time(60) : milliseconds(100'000'000)};
    problem_.constraints.push_back(constraint);
  }

  void draw_fixed() {
    if (size_.transports > 1 && below(4) == 0) {
      const std::uint32_t before = below(size_.transports - 1);
      problem_.orders.push_back({TransportId(before), TransportId(before + 1)});
    }
    if (below(4) != 0) return;
    // One or two transports, one after the other or together; the beginning may leave one aboard.
    FixedRoute route{VehicleId(below(size_.vehicles)), {}, below(2) == 0};
    const std::uint32_t first = below(size_.transports);
    const auto amount = [&](std::uint32_t t) { return 1 + below(problem_.transports[t].amount); };
    const std::uint32_t load = amount(first);
    route.stops.push_back({LoadAction::PickUp, TransportId(first), load});
    const bool also = first + 1 < size_.transports && below(2) == 0;
    const std::uint32_t other_load = also ? amount(first + 1) : 0;
    if (also && below(2) == 0) {
      route.stops.push_back({LoadAction::PickUp, TransportId(first + 1), other_load});
      route.stops.push_back({LoadAction::SetDown, TransportId(first + 1), other_load});
    }
    if (route.whole || below(2) == 0) {
      route.stops.push_back({LoadAction::SetDown, TransportId(first), load});
    }
    problem_.routes.push_back(route);
  }

  const DrawnSize& size_;
  std::mt19937& random_;
  AllocationProblem problem_;
};

}  // namespace

AllocationProblem draw_allocation(const DrawnSize& size, std::mt19937& random) {
  return Drawing(size, random).draw();
}

}  // namespace stepwright::fleet
