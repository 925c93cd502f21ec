#include "tests/unit/runtime/modbus/server/tls/plant_certificates.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace stepwright::modbus::server {

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The first block of shell commands of the document.
std::string recipe() {
  const std::string text = text_of(STEPWRIGHT_SOURCE_DIR "/runtime/doc/modbus_security.md");
  const std::string fence = "```sh\n";
  const std::size_t begin = text.find(fence), end = text.find("```", begin + fence.size());
  if (begin == std::string::npos || end == std::string::npos) throw std::runtime_error("no recipe");
  return text.substr(begin + fence.size(), end - begin - fence.size());
}

}  // namespace

PlantCertificates::PlantCertificates() {
  run(recipe());
}

void PlantCertificates::run(const std::string& script) const {
  std::ofstream(folder_ / "script") << script;
  const std::string command = "cd " + folder_.path().string() + " && sh -e script >log 2>&1";
  if (std::system(command.c_str()) != 0) throw std::runtime_error(script + "\n" + text_of(folder_ / "log"));
}

void PlantCertificates::certify(const std::string& name, const std::string& extensions,
                                const std::string& authority, int days) {
  std::ofstream(folder_ / (name + ".ext")) << extensions;
  run("openssl req -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -keyout " + name + ".key -out " +
      name + ".csr -subj /CN=" + name + "\nopenssl x509 -req -in " + name + ".csr -CA " + authority +
      ".crt -CAkey " + authority + ".key -CAcreateserial -days " + std::to_string(days) + " -extfile " +
      name + ".ext -out " + name + ".crt\n");
}

void PlantCertificates::make_authority(const std::string& name) {
  run("openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 30 -keyout " + name +
      ".key -out " + name + ".crt -subj /CN=" + name + " -addext basicConstraints=critical,CA:TRUE\n");
}

void PlantCertificates::revoke(const std::string& name, const std::string& list) {
  run("touch index.txt; echo 01 >crlnumber\n"
      "printf '[ca]\\ndefault_ca = plant\\n[plant]\\ndatabase = index.txt\\ncrlnumber = "
      "crlnumber\\ndefault_md = sha256\\n"
      "default_crl_days = 30\\n' >ca.cnf\n"
      "openssl ca -config ca.cnf -cert plant-ca.crt -keyfile plant-ca.key -revoke " +
      name +
      ".crt\n"
      "openssl ca -config ca.cnf -cert plant-ca.crt -keyfile plant-ca.key -gencrl -out " +
      list + "\n");
}

}  // namespace stepwright::modbus::server
