// stepwright show FILE... [--pou NAME] [--to text|svg] [--paper a4|a3] [-o FILE]

#include "programs/show/show_command.h"

int main(int argc, char** argv) {
  return stepwright::show::run_show(argc, argv);
}
