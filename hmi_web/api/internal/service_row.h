#pragma once

// Rows of a service that a server may lack.

#include <utility>

#include "hmi_web/api/route.h"

namespace stepwright::api {

// `route`, answered by `deed` at the service, and by `absent` where there is none.
template <typename Service, typename Deed>
Route with_service(Service* service, Route route, Answer (*absent)(), Deed deed) {
  route.handler = [service, absent, deed = std::move(deed)](const Call& call) {
    return service == nullptr ? absent() : deed(*service, call);
  };
  return route;
}

}  // namespace stepwright::api
