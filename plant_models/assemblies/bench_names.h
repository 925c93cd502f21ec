#pragma once

// The parts of the tank bench and the order in which arrays hold them.

#include <cstddef>

namespace stepwright::assemblies {

enum class Tank : std::size_t { F1, V1, A1, A2 };     // supplier, vehicle, distributors
enum class Pump : std::size_t { B1, B2, B3, B4 };     // loading, unloading, customers of a1 and a2
enum class Place : std::size_t { F1, A1, A2, None };  // in the order of the switches fc1, fc2, fc3

inline constexpr std::size_t kTanks = 4;
inline constexpr std::size_t kPumps = 4;
inline constexpr std::size_t kPlaces = 3;
inline constexpr std::size_t kLevelSensors = 3;  // S1 in v1, S2 in a1, S3 in a2
inline constexpr std::size_t kClients = 2;       // c1 draws from a1 with B3, c2 from a2 with B4

constexpr std::size_t index(Tank tank) {
  return static_cast<std::size_t>(tank);
}
constexpr std::size_t index(Pump pump) {
  return static_cast<std::size_t>(pump);
}
constexpr std::size_t index(Place place) {
  return static_cast<std::size_t>(place);
}

// The distributor that serves a client.
constexpr Tank client_tank(std::size_t client) {
  return client == 0 ? Tank::A1 : Tank::A2;
}

}  // namespace stepwright::assemblies
