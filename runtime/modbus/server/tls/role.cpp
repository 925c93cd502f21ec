#include "runtime/modbus/server/tls/internal/role.h"

#include <openssl/asn1.h>
#include <openssl/objects.h>

#include <algorithm>

namespace stepwright::modbus::server {

namespace {

using Oid = Openssl<ASN1_OBJECT, ASN1_OBJECT_free>;
using Utf8 = Openssl<ASN1_UTF8STRING, ASN1_UTF8STRING_free>;

// A NUL or a line break in a role could make it look like another one in a log or in a comparison.
bool is_plain(const std::string& text) {
  return std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
}

}  // namespace

std::optional<std::string> role_of(const X509* certificate) {
  const Oid oid(OBJ_txt2obj(kRoleOid, 1));
  const int first = X509_get_ext_by_OBJ(certificate, oid.get(), -1);
  if (first < 0) return "";
  if (X509_get_ext_by_OBJ(certificate, oid.get(), first) >= 0) return std::nullopt;
  const ASN1_OCTET_STRING* const data = X509_EXTENSION_get_data(X509_get_ext(certificate, first));
  const unsigned char* at = ASN1_STRING_get0_data(data);
  const unsigned char* const end = at + ASN1_STRING_length(data);
  const Utf8 text(d2i_ASN1_UTF8STRING(nullptr, &at, ASN1_STRING_length(data)));
  ERR_clear_error();
  if (!text || at != end) return std::nullopt;
  const int length = ASN1_STRING_length(text.get());
  if (length < 1 || length > kMostRoleBytes) return std::nullopt;
  std::string role(reinterpret_cast<const char*>(ASN1_STRING_get0_data(text.get())),
                   static_cast<std::size_t>(length));
  if (!is_plain(role)) return std::nullopt;
  return role;
}

}  // namespace stepwright::modbus::server
