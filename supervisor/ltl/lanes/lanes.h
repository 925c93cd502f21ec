#pragma once

// Two lines of work, each in a thread of its own where there are two, one after the other
// where there is one. What they do must not depend on which of them is first.
//
//   on_lanes(threads, [&](std::size_t lane) { found[lane] = work(lane); });   // returns when both are done

#include <cstddef>
#include <functional>

namespace stepwright::ltl {

inline constexpr std::size_t kLanes = 2;

// 1 or 2: so many as are asked for, or for 0 as the machine has.
std::size_t threads_of(std::size_t asked);

// Lane 0 is the caller's thread. Without a second thread, because there is none to be had, as with one.
void on_lanes(std::size_t threads, const std::function<void(std::size_t lane)>& work);

}  // namespace stepwright::ltl
