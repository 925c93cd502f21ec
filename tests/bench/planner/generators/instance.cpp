#include "tests/bench/planner/generators/instance.h"

#include <fmt/format.h>

#include <sstream>

namespace stepwright::bench {
namespace {

model::GroundAction action_of(const std::string& line) {
  std::istringstream words(line);
  model::GroundAction action;
  words >> action.name;
  for (std::string word; words >> word;) action.arguments.push_back(word);
  return action;
}

// FNV-1a: enough to notice that a text has changed.
std::uint64_t hash_of(const std::string& text, std::uint64_t hash) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

}  // namespace

std::string Instance::name() const {
  return fmt::format("{}-{}-{}", generator, size, seed);
}

std::string Instance::digest() const {
  return fmt::format("{:016x}", hash_of(problem, hash_of(domain, 0xcbf29ce484222325ULL)));
}

Instance make_instance(const Generator& generator, int size, std::uint64_t seed) {
  Random random(hash_of(generator.name, seed * 1000 + static_cast<std::uint64_t>(size)));
  Draft draft = generator.draft(size, random);
  Instance instance;
  instance.generator = generator.name;
  instance.size = size;
  instance.seed = seed;
  instance.classical = generator.classical;
  instance.domain = generator.domain;
  instance.problem = std::move(draft.problem);
  instance.lower_bound = draft.lower_bound;
  for (const std::string& line : draft.reference) instance.reference.push_back(action_of(line));
  return instance;
}

}  // namespace stepwright::bench
