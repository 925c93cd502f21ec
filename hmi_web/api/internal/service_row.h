#pragma once

// Rows of a service that a server may lack.

#include <utility>

#include "hmi_web/api/route.h"

namespace stepwright::api {

// `route`, answered by `handler` at the service, and by `absent` where there is none.
template <typename Service, typename Handler>
Route with_service(Service* service, Route route, Answer (*absent)(), Handler handler) {
  route.handler = [service, absent, handler = std::move(handler)](const Call& call) {
    return service == nullptr ? absent() : handler(*service, call);
  };
  return route;
}

}  // namespace stepwright::api
