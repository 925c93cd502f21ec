#pragma once

// Trucks that bring packages, as HDDL of any size: what shows how the search grows.

#include <string>

namespace stepwright::htn::test {

// Recursion at the end of its methods only. A truck drives on from where it is, to any place that a road
// leads to.
std::string transport_domain();

// One truck on a ring of one-way roads.
std::string ring_problem(int places, int packages);

// One truck on a square of side x side places, roads both ways.
std::string grid_problem(int side, int packages);

}  // namespace stepwright::htn::test
