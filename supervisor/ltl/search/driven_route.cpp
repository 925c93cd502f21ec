#include "supervisor/ltl/search/driven_route.h"

#include <algorithm>

namespace stepwright::ltl {

Route tail_of(const Route& route, const DriveMark& mark) {
  Route tail = {{place_of(mark), mark.task, {}}};
  if (mark.next < route.size())
    tail.insert(tail.end(), route.begin() + static_cast<std::ptrdiff_t>(mark.next), route.end());
  if (tail.size() > 1) {
    auto& through = tail[1].through;
    through.erase(through.begin(),
                  through.begin() + static_cast<std::ptrdiff_t>(std::min(mark.seen, through.size())));
  }
  return tail;
}

Route with_other_end(const Route& route, const DriveMark& mark, const Route& other, std::size_t& offset) {
  Route made(route.begin(), route.begin() + static_cast<std::ptrdiff_t>(std::min(mark.next, route.size())));
  RoutePoint here{place_of(mark), mark.task, {}};
  if (mark.next < route.size()) {
    const auto& through = route[mark.next].through;
    here.through.assign(through.begin(),
                        through.begin() + static_cast<std::ptrdiff_t>(std::min(mark.seen, through.size())));
  }
  offset = made.size();
  made.push_back(std::move(here));
  made.insert(made.end(), other.begin() + 1, other.end());
  return made;
}

Drive joined(const Drive& drive, std::size_t mark, const Drive& other, std::size_t offset, std::size_t seen) {
  const DriveMark& at = drive.marks[mark];
  Drive made;
  made.end = other.end;
  made.pieces.assign(drive.pieces.begin(), drive.pieces.begin() + static_cast<std::ptrdiff_t>(at.pieces));
  made.pieces.insert(made.pieces.end(), other.pieces.begin(), other.pieces.end());
  made.marks.assign(drive.marks.begin(), drive.marks.begin() + static_cast<std::ptrdiff_t>(mark) + 1);
  for (DriveMark each : other.marks) {
    each.pieces += at.pieces;
    each.length_m += at.length_m;
    if (each.next == 1) each.seen += seen;
    each.next += offset;
    made.marks.push_back(each);
  }
  return made;
}

}  // namespace stepwright::ltl
