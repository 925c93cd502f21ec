#include "supervisor/fleet/vda5050/order.h"

namespace stepwright::fleet::vda5050 {

std::optional<std::size_t> decision_point(const Order& order) {
  std::optional<std::size_t> last;
  for (std::size_t k = 0; k < order.nodes.size() && order.nodes[k].released; ++k) last = k;
  return last;
}

}  // namespace stepwright::fleet::vda5050
