#pragma once

// The route table as an OpenAPI 3.1 document.
//
//   print(openapi(table, "0.1.0"));
//
// Pure; any thread.

#include <string>

#include "hmi_web/api/route_table.h"

namespace stepwright::api {

std::string openapi(const RouteTable& table, const std::string& version);

}  // namespace stepwright::api
