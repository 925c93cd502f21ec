#pragma once

// `stepwright download`: brings a compiled program to a running cell, through the socket of its runtime.

namespace stepwright::download {

// stepwright download --config CELL.toml IMAGE.swb [--change|--restart-charts|--replace] [--json FILE]
// Exit codes: 0 done; 1 the image or the change was refused; 2 usage; 5 no runtime answers.
int run_download(int argc, char** argv);

}  // namespace stepwright::download
