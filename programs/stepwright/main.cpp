// `stepwright COMMAND ...`: the one command. It replaces itself by the program of the command, which stands
// beside it, so that each process links only what it needs (ADR 0001).

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/process/standard_output.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/ground/settings/toml_document.h"

namespace {

using stepwright::result::ExitCode;
using stepwright::result::to_int;

struct Command {
  const char* name;
  const char* program;
  const char* summary;
};

constexpr std::array kCommands = {
    Command{"new", "stepwright-new", "write the folder of a new cell, which runs as it is"},
    Command{"up", "stepwright-up", "start all processes of a cell, and keep them alive"},
    Command{"down", "stepwright-up", "end all processes of a cell, in order"},
    Command{"status", "stepwright-up", "say how the processes of a cell are"},
    Command{"demo", "stepwright-demo", "run a cell: all its processes, its main job, a report"},
    Command{"plan", "stepwright-plan", "find a plan for a PDDL problem"},
    Command{"validate", "stepwright-plan", "check a plan step by step"},
    Command{"plant", "stepwright-plant", "check a plant of components, list it, run it without a controller"},
    Command{"campaign", "stepwright-campaign",
            "run a cell many times with random faults, and judge every run"},
    Command{"binding", "stepwright-binding", "try every action of a planned cell on its simulated plant"},
    Command{"fleet", "stepwright-fleet", "plan vehicles on one floor: loads, paths, envelopes, schedule"},
    Command{"htn", "stepwright-htn", "decompose the tasks of an HDDL problem into actions"},
    Command{"ltl", "stepwright-ltl",
            "temporal logic: plan drives, judge traces, write automata and monitors"},
    Command{"reach", "stepwright-reach",
            "what a sequence of picks and places leaves to poses, or why it cannot be done"},
    Command{"arm", "stepwright-arm", "plan a path of a robot's arm among obstacles, judged by its bodies"},
    Command{"tamp", "stepwright-tamp", "plan tasks and motions of a robot cell together"},
    Command{"translate", "stepwright-translate",
            "turn a plan into SFC, Ladder, PLCopen XML or Omron mnemonics"},
    Command{"compile", "stepwright-compile", "compile ST and PLCopen sources to a bytecode image"},
    Command{"explain", "stepwright-compile", "describe a diagnostic code, or list all"},
    Command{"show", "stepwright-show", "print programs as text or as pages (SVG)"},
    Command{"exec", "stepwright-exec", "run an image without a clock"},
    Command{"test", "stepwright-test", "run the tests of ST sources in simulated time"},
    Command{"scan-test", "stepwright-scan-test", "measure scan timing beside a bare wake-up loop"},
    Command{"check", "stepwright-check", "check a cell's configuration, planning files and program"},
    Command{"reference", "stepwright-reference",
            "print every key of a cell's file, with its values and default"},
    Command{"runtime", "stepwright-runtime", "the scan process"},
    Command{"gateway", "stepwright-gateway",
            "serve a controller that is reached over Modbus only as a runtime"},
    Command{"guard", "stepwright-guard", "drive the outputs to their safe state when the runtime is lost"},
    Command{"modbus-client", "stepwright-modbus-client", "physical devices over Modbus as the I/O of a cell"},
    Command{"link", "stepwright-link", "carry the runtime's service over Fast DDS"},
    Command{"supervisor", "stepwright-supervisor", "plan, download, watch and replan"},
    Command{"hmi", "stepwright-hmi", "show the cell in a browser"},
    Command{"download", "stepwright-download", "bring a program to a running cell, also by an online change"},
    Command{"start", "stepwright-monitor", "start the loaded program of a runtime"},
    Command{"stop", "stepwright-monitor", "stop it, with its outputs in their safe state"},
    Command{"fault", "stepwright-monitor", "make a fault of the simulated plant hold, or end it"},
    Command{"force", "stepwright-monitor", "hold a variable of a runtime at a value"},
    Command{"unforce", "stepwright-monitor", "release a variable, or all"},
    Command{"forces", "stepwright-monitor", "list what is forced"},
    Command{"watch", "stepwright-monitor", "print values of a runtime again and again"},
    Command{"snapshot", "stepwright-monitor", "print all values of one scan"},
    Command{"step", "stepwright-monitor", "stand still in simulated time and run some scans"},
    Command{"continue", "stepwright-monitor", "end the standing still"},
    Command{"record", "stepwright-monitor", "record everything that decides the scans"},
    Command{"trace", "stepwright-monitor", "write variables as a table, a row for every scan"},
    Command{"replay", "stepwright-replay", "run a recording again and compare every image"},
    Command{"metrics", "stepwright-metrics", "the figures of a runtime in the text form of Prometheus"},
    Command{"modbus-server", "stepwright-modbus-server", "serve the variables of a runtime over Modbus"},
    Command{"registers", "stepwright-registers", "list the Modbus addresses of a program's variables"},
    Command{"vda5050", "stepwright-vda5050", "check messages of VDA 5050 by the rules of the standard"},
    Command{"reload", "stepwright-metrics", "have a runtime read its configuration again"},
};

// A command that is started without standard streams must not take a file of its own for one of them.
void fill_standard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (fcntl(stream, F_GETFD) >= 0) continue;
    if (open("/dev/null", O_RDWR) != stream) return;  // nothing can be opened: then no file can either
  }
}

void print_usage(std::FILE* out) {
  std::fputs("usage: stepwright COMMAND [OPTION ...]\n\n", out);
  for (const Command& command : kCommands) std::fprintf(out, "  %-11s %s\n", command.name, command.summary);
  std::fputs("\n`stepwright COMMAND --help` describes a command.\n", out);
}

int unknown(std::string_view name) {
  std::vector<std::string> names;
  for (const Command& command : kCommands) names.emplace_back(command.name);
  const std::string meant = stepwright::settings::closest(name, names);
  std::fprintf(stderr, "stepwright: there is no command '%.*s'\n", static_cast<int>(name.size()),
               name.data());
  if (!meant.empty()) std::fprintf(stderr, "  hint: did you mean '%s'?\n", meant.c_str());
  print_usage(stderr);
  return to_int(ExitCode::Usage);
}

}  // namespace

int main(int argc, char** argv) {
  fill_standard_streams();
  stepwright::process::tell_lost_output();
  if (argc < 2) {
    print_usage(stderr);
    return to_int(ExitCode::Usage);
  }
  const std::string_view name = argv[1];
  if (name == "--help" || name == "-h" || name == "help") {
    print_usage(stdout);
    return to_int(ExitCode::Done);
  }
  if (name == "--version") {
    std::puts("stepwright " STEPWRIGHT_VERSION);
    return to_int(ExitCode::Done);
  }
  for (const Command& command : kCommands) {
    if (name != command.name) continue;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
    const std::string program = (self.parent_path() / command.program).string();
    execv(program.c_str(), argv);
    std::fprintf(stderr,
                 "stepwright: cannot start %s: %s\n  hint: is it built? (scripts/demo builds everything)\n",
                 program.c_str(), std::strerror(errno));
    return to_int(ExitCode::RuntimeFault);
  }
  return unknown(name);
}
