#pragma once

// A chart of two steps that take turns: news for whoever follows a program although nothing takes a step in
// it. A pure function.

#include <chrono>

#include "ladder/graphic/sfc_chart.h"

namespace stepwright::vehicle {

graphic::SfcChart news_chart(std::chrono::milliseconds every);

}  // namespace stepwright::vehicle
