// stepwright download --config CELL.toml IMAGE.swb [--change|--restart-charts|--replace] [--json FILE]

#include "programs/download/download_command.h"

int main(int argc, char** argv) {
  return stepwright::download::run_download(argc, argv);
}
