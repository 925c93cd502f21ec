#include "supervisor/fleet/schedule/internal/explain.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "supervisor/fleet/schedule/internal/model.h"

namespace stepwright::fleet::internal {

namespace {

using Items = std::vector<std::uint32_t>;

// Makes a set of items that leaves no schedule minimal. `refuted(items)`: whether these leave none.
class QuickXplain {
 public:
  explicit QuickXplain(std::function<bool(const Items&)> refuted) : refuted_(std::move(refuted)) {}

  Items minimal(const Items& items) {
    if (items.empty() || refuted_({})) return {};
    return shrink({}, false, items);
  }

 private:
  // What of `items` is needed beside `others`, if something of it is new in them.
  Items shrink(const Items& others, bool grown, const Items& items) {
    if (grown && refuted_(others)) return {};
    if (items.size() == 1) return items;
    const auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
    const Items low(items.begin(), middle), high(middle, items.end());
    const Items of_high = shrink(joined(others, low), true, high);
    const Items of_low = shrink(joined(others, of_high), !of_high.empty(), low);
    return joined(of_low, of_high);
  }
  static Items joined(const Items& a, const Items& b) {
    Items both = a;
    both.insert(both.end(), b.begin(), b.end());
    return both;
  }

  std::function<bool(const Items&)> refuted_;
};

class Explainer {
 public:
  Explainer(const Motion& motion, const Sections& sections, std::span<const TemporalConstraint> constraints,
            Mode mode, const SearchLimits& limits)
      : motion_(motion), sections_(sections), constraints_(constraints), mode_(mode), limits_(limits) {}

  std::uint64_t conflicts() const { return conflicts_; }

  Core explain() {
    Items all(motion_.vehicles());
    for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
    Core core;
    core.vehicles = QuickXplain([this](const Items& some) { return refuted_by_vehicles(some); }).minimal(all);
    std::ranges::sort(core.vehicles);
    const std::set<std::uint32_t> vehicles(core.vehicles.begin(), core.vehicles.end());
    const Items parts = parts_of(vehicles);
    const Items needed =
        QuickXplain([&](const Items& some) { return refuted_by_parts(vehicles, some); }).minimal(parts);
    for (const std::uint32_t part : needed) add(part, core);
    core.minimal = !stopped_;
    return core;
  }

 private:
  // Parts are numbered: temporal constraints, then slowest motions, then sections.
  std::uint32_t slowest_part(std::uint32_t vehicle) const {
    return static_cast<std::uint32_t>(constraints_.size()) + vehicle;
  }
  std::uint32_t section_part(std::uint32_t section) const {
    return slowest_part(motion_.vehicles()) + section;
  }

  bool names_only(const TemporalConstraint& c, const std::set<std::uint32_t>& vehicles) const {
    return vehicles.contains(c.to.at.vehicle) && (!c.from || vehicles.contains(c.from->at.vehicle));
  }

  Items parts_of(const std::set<std::uint32_t>& vehicles) const {
    Items parts;
    for (std::uint32_t c = 0; c < constraints_.size(); ++c) {
      if (names_only(constraints_[c], vehicles)) parts.push_back(c);
    }
    for (const std::uint32_t v : vehicles) parts.push_back(slowest_part(v));
    for (std::uint32_t s = 0; s < sections_.sections.size(); ++s) {
      const CriticalSection& section = sections_.sections[s];
      if (vehicles.contains(section.a) && vehicles.contains(section.b)) parts.push_back(section_part(s));
    }
    return parts;
  }

  bool refuted_by_vehicles(const Items& some) {
    const std::set<std::uint32_t> vehicles(some.begin(), some.end());
    return refuted_by_parts(vehicles, parts_of(vehicles));
  }

  bool refuted_by_parts(const std::set<std::uint32_t>& vehicles, const Items& parts) {
    std::vector<char> kept(motion_.labels().precedences(), 0);
    Items chosen;
    for (const std::uint32_t v : vehicles) kept[motion_.labels().fastest(v)] = 1;
    for (const std::uint32_t part : parts) {
      if (part < slowest_part(0)) {
        kept[motion_.labels().temporal(part)] = 1;
      } else if (part < section_part(0)) {
        kept[motion_.labels().slowest(part - slowest_part(0))] = 1;
      } else {
        chosen.push_back(part - section_part(0));
      }
    }
    if (stopped_) return false;
    SearchLimits left = limits_;
    if (limits_.conflicts > 0) left.conflicts = limits_.conflicts - conflicts_;
    const SearchModel model = make_model(motion_, sections_, mode_, kept, chosen);
    const SearchObjective none;
    Search search(model, none, left);
    const Answer answer = search.next();
    conflicts_ += search.figures().conflicts;
    stopped_ = answer == Answer::OutOfTime || answer == Answer::Cancelled ||
               (limits_.conflicts > 0 && conflicts_ >= limits_.conflicts);
    return answer == Answer::No;
  }

  void add(std::uint32_t part, Core& core) const {
    if (part < slowest_part(0)) {
      core.constraints.push_back(part);
    } else if (part < section_part(0)) {
      core.slowest.push_back(part - slowest_part(0));
    } else {
      const auto pairs = sections_.of(sections_.sections[part - section_part(0)]);
      core.sections.emplace_back(pairs.begin(), pairs.end());
    }
  }

  const Motion& motion_;
  const Sections& sections_;
  std::span<const TemporalConstraint> constraints_;
  Mode mode_;
  SearchLimits limits_;  // of all searches together
  std::uint64_t conflicts_ = 0;
  bool stopped_ = false;
};

}  // namespace

Core explain(const Motion& motion, const Sections& sections, std::span<const TemporalConstraint> constraints,
             Mode mode, const SearchLimits& limits, std::uint64_t& conflicts) {
  Explainer explainer(motion, sections, constraints, mode, limits);
  Core core = explainer.explain();
  conflicts = explainer.conflicts();
  return core;
}

}  // namespace stepwright::fleet::internal
