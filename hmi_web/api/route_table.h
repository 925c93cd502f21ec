#pragma once

// All routes of the server, and which of them a request means.
//
//   const RouteTable table({...});
//   const Match match = table.find("POST", "/api/plan/abort?x=1");   // match.route, match.parameters
//
// Immutable; any thread. Invariant: no two rows have the same method and shape of path.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_web/api/route.h"

namespace stepwright::api {

struct Match {
  const Route* route = nullptr;
  std::map<std::string, std::string, std::less<>> parameters = {};
  bool readable = true;      // false: the query has a part that cannot be decoded
  std::string unknown = {};  // the first parameter of the query that the row does not name
  std::string allowed = {};  // without a route: methods that the path has, "GET, POST"; empty: no such path
};

class RouteTable {
 public:
  // Rows that contradict each other are a programmer's error.
  explicit RouteTable(std::vector<Route> rows);

  // HEAD is GET. What is encoded is decoded.
  Match find(std::string_view method, std::string_view target) const;
  const std::vector<Route>& rows() const { return rows_; }

 private:
  std::vector<Route> rows_;
};

}  // namespace stepwright::api
