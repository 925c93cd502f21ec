#pragma once

// Rows of a desk that a server may lack.

#include <utility>

#include "hmi_web/api/route.h"

namespace stepwright::api {

// `route`, answered by `deed` at the desk, and by `absent` where there is none.
template <typename Desk, typename Deed>
Route with_desk(Desk* desk, Route route, Answer (*absent)(), Deed deed) {
  route.handler = [desk, absent, deed = std::move(deed)](const Call& call) {
    return desk == nullptr ? absent() : deed(*desk, call);
  };
  return route;
}

}  // namespace stepwright::api
