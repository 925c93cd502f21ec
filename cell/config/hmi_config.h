#pragma once

// The page of a cell: [hmi] of its configuration.
//
//   [hmi]
//   host = "127.0.0.1"            # beyond loopback: only with TLS and once an administrator has been claimed
//   names = ["line.plant"]        # what browsers may call it beside `host`; needed with 0.0.0.0 and ::
//   port = 8080                   # 0: any free one
//   anonymous = "none"            # "viewer": whoever is at this machine may look without logging in
//   tls_certificate = "page.pem"  # a chain in PEM form, and its key
//   tls_key = "page.key"
//   access_dir = "access"         # users, audit trail; default: in the state folder
//   idle_minutes = 30             # without any request: logged out
//   session_hours = 12            # logged out in any case
//   refresh_ms = 20               # at the shortest, between two pictures of the values
//   recipes = "recipes.toml"      # beside this file: the tags that recipes set (hmi_web/doc/recipes.md)
//   recipes_dir = "recipes"       # the recipes themselves; default: in the state folder
//   programs_dir = "programs"     # programs that can be brought back (hmi_web/doc/change.md); likewise
//   tags = "tags.csv"             # beside this file: what people want to know of tags (hmi_web/doc/tags.md)
//   screens_dir = "screens"       # screens that people draw on the page (hmi_web/doc/screens.md); likewise
//   drawing = "plant.svg"         # the plant's picture, drawn by hand (hmi_web/doc/drawings.md)
//
//
//   [hmi.wall]                    # a display on the wall that looks without logging in, and never acts
//   addresses = ["10.0.0.17", "192.168.7.0/24"]   # who calls from there is a viewer
//   panels = ["alarms", "synoptic", "trend"]      # that /#wall shows, in this order
//
// Pure.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/ground/network/ip_range.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {

struct WallConfig {
  std::vector<network::IpRange> addresses;  // empty: there is no such display
  std::vector<std::string> panels = {};     // empty: the page chooses by what the cell has
};

struct HmiConfig {
  std::string host = "127.0.0.1";
  std::vector<std::string> names;  // of the Host header, without a port and brackets
  std::uint16_t port = 8080;
  std::vector<std::string>
      metrics_of;                 // runtimes of the domain beside the cell's own whose figures /metrics gives
  bool anonymous_viewer = false;  // at this machine only
  std::filesystem::path certificate;  // empty: no TLS
  std::filesystem::path key;
  std::filesystem::path access_dir;
  std::filesystem::path recipes;  // the file of definitions; empty: there are no recipes
  std::filesystem::path recipes_dir;
  std::filesystem::path programs_dir;
  std::filesystem::path tags;  // a table beside [tags]; empty: there is none
  std::filesystem::path screens_dir;
  std::filesystem::path drawing;  // empty: the picture is made from the plant's description
  WallConfig wall;
  std::chrono::minutes idle{30};
  std::chrono::hours session{12};
  std::chrono::milliseconds refresh{20};  // between two pictures of the values, at the shortest
};

// The address that a browser goes to while the server listens at `host` and `port`: where these are all
// addresses of the machine, by the first of `names`, as no other is served.
std::string page_address(const HmiConfig& hmi, const std::string& host, std::uint16_t port);

// The screen of a panel "screen:NAME" of [hmi.wall]; empty for any other panel.
std::string wall_screen(const std::string& panel);

// "localhost", 127.x.y.z, ::1.
bool is_loopback(const std::string& host);

// Errors are reported to the document: C0003, C0004, C0468 (a host beyond loopback without TLS), C0469 (half
// of what TLS needs), C0470 (names that are none, or missing), C0471 (an address of a wall display that is
// none, a panel that there is not).
HmiConfig read_hmi(const settings::TomlTable& hmi, const std::filesystem::path& folder,
                   const std::filesystem::path& state_dir);

}  // namespace stepwright::config
