#pragma once

// Certificates for tests: those of the recipe in runtime/doc/modbus_security.md, which is run as it stands
// there, and others that must not be let in.

#include <filesystem>
#include <string>

#include "tests/support/temporary_folder.h"

namespace stepwright::modbus::server {

class PlantCertificates {
 public:
  // Runs the recipe in a temporary folder, which goes with the object. Throws std::runtime_error if it fails.
  PlantCertificates();

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

  // NAME.crt and NAME.key with these lines of extensions, certified by AUTHORITY.crt, valid for so many days
  // from now.
  void certify(const std::string& name, const std::string& extensions,
               const std::string& authority = "plant-ca", int days = 30);
  // An authority of its own: NAME.crt, NAME.key.
  void make_authority(const std::string& name);
  // A revocation list of the plant's authority with NAME.crt in it.
  void revoke(const std::string& name, const std::string& list);

 private:
  void run(const std::string& script) const;

  support::TemporaryFolder folder_;
};

inline constexpr const char* kClient = "extendedKeyUsage = clientAuth\n";
inline constexpr const char* kRole = "1.3.6.1.4.1.50316.802.1 = ASN1:";

}  // namespace stepwright::modbus::server
