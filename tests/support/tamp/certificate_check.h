#pragma once

// Certificates and witnesses of a network of intervals, checked by other means than they were made with: arcs
// as rows of numbers from 0 to 2^32 - 1, cells listed one by one, linear rows in exact fractions. Slow.
//
// Functions without state; any thread.
//
//   EXPECT_EQ(wrong_with(network, network.certificate(), dropped), "");

#include <string>
#include <vector>

#include "supervisor/tamp/intervals/cause/witness.h"
#include "supervisor/tamp/intervals/network/network.h"

namespace stepwright::tamp::testing {

// Follows the steps; empty if they prove that the network's constraints have no solution.
std::string wrong_with(const Network& network, const Certificate& certificate,
                       const std::vector<bool>& dropped = {});

// The first constraint that the witness does not meet; empty if it meets all but the dropped ones. Linear
// rows to 10 nm, which is what rounding to nanometres costs.
std::string wrong_with(const Network& network, const Witness& witness, const std::vector<bool>& dropped = {});

}  // namespace stepwright::tamp::testing
