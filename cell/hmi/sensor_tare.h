#pragma once

// The tare of the sensors out of the supervisor's plan document, so that a level on the page is the level
// that plan and report speak of. Pure; any thread.
//
//   tare_of(R"({"tare": {"S3": 41.5}})")  ->  {{"S3", 41.5}}

#include <string>

#include "hmi_web/server/cell_source.h"

namespace stepwright::hmi {

// Empty for a document that is not JSON or has no tare; entries that are no numbers are left out.
server::Tare tare_of(const std::string& plan_document);

}  // namespace stepwright::hmi
