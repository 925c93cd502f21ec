#include "supervisor/fleet/vda5050/check_message.h"

#include "supervisor/fleet/vda5050/internal/document.h"

namespace stepwright::fleet::vda5050 {

result::Diagnostics check_message(Topic topic, std::string_view text, const std::string& source) {
  const Document document = read_document(topic, text, source);
  return document.wrong;
}

}  // namespace stepwright::fleet::vda5050
