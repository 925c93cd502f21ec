#!/usr/bin/env python3
"""Proves the arrows between folders: every #include of the tree against the table below.

A file may include its own folder and the folders that its folder points to, directly or through them.
No arrows lead round in a circle. Prints each include that breaks an arrow as file:line and exits with 1.
"""

import pathlib
import re
import sys

# folder -> folders it may include (their own arrows come with them)
ARROWS = {
    "runtime/base": [],
    "runtime/bytecode": ["runtime/base"],
    "runtime/bytecode/writer": ["runtime/bytecode", "runtime/ground/result"],
    "runtime/bytecode/reader": ["runtime/bytecode", "runtime/ground/result"],
    "runtime/image": ["runtime/base"],
    "runtime/operations": ["runtime/bytecode"],
    "runtime/vm": ["runtime/operations", "runtime/image"],
    "runtime/native": ["runtime/operations", "runtime/ground/result"],
    "runtime/scan": ["runtime/vm"],
    "runtime/io_memory": ["runtime/scan", "runtime/ground/result"],
    "runtime/ground/naming": [],
    "runtime/ground/result": ["runtime/ground/naming"],
    "runtime/ground/markup": [],
    "runtime/ground/settings": ["runtime/ground/result"],
    "runtime/ground/csv": ["runtime/ground/result"],
    "runtime/ground/network": [],
    "runtime/ground/files": ["runtime/ground/result"],
    "runtime/ground/process": ["runtime/ground/files"],
    "runtime/ground/log": ["runtime/ground/settings"],
    "runtime/ground/mqtt": ["runtime/ground/result"],
    "runtime/host": ["runtime/native", "runtime/scan", "runtime/bytecode/reader", "runtime/ground/naming", "runtime/record"],
    "runtime/record": ["runtime/scan", "runtime/bytecode/reader", "runtime/ground/files"],
    "runtime/service": ["runtime/host"],
    "runtime/dds": ["runtime/ground/network", "runtime/service"],
    "runtime/modbus/control": ["runtime/base"],
    "runtime/modbus/line": [],
    "runtime/modbus/pdu": [],
    "runtime/modbus/map": ["runtime/modbus/pdu", "runtime/host"],
    "runtime/modbus/server": ["runtime/ground/network", "runtime/modbus/line", "runtime/modbus/map", "runtime/service"],
    "runtime/modbus/master": ["runtime/modbus/line", "runtime/modbus/pdu", "runtime/ground/result"],
    "runtime/modbus/client": ["runtime/modbus/master", "runtime/scan"],
    "runtime/metrics": ["runtime/host"],
    "runtime/trace": ["runtime/bytecode/reader", "runtime/ground/files"],
    "runtime/exec": ["runtime/host", "runtime/trace"],
    "runtime/replay": ["runtime/host", "runtime/trace"],
    "runtime/scan_test": ["runtime/host"],
    "runtime/remote": ["runtime/service", "runtime/modbus/control", "runtime/modbus/master"],
    "firmware/decimal": [],
    "firmware/port": [],
    "firmware/storage": ["firmware/port", "runtime/base"],
    "firmware/app": ["firmware/storage", "runtime/scan", "runtime/modbus/pdu", "runtime/modbus/control"],
    "firmware/boards": ["firmware/app", "firmware/decimal"],
    "firmware/link": ["runtime/ground/result"],
    "ladder/source": ["runtime/ground/result", "runtime/base"],
    "ladder/syntax": ["ladder/source", "runtime/ground/naming"],
    "ladder/graphic": ["runtime/ground/result", "runtime/ground/markup", "runtime/base"],
    "ladder/print": ["ladder/graphic", "ladder/syntax"],
    "ladder/semantics/types": ["ladder/syntax", "runtime/bytecode"],
    "ladder/semantics/model": ["ladder/semantics/types"],
    "ladder/semantics/constants": ["ladder/semantics/model"],
    "ladder/semantics/analysis": ["ladder/semantics/constants"],
    "ladder/semantics/conversions": ["ladder/semantics/analysis"],
    "ladder/semantics/expressions": ["ladder/semantics/conversions"],
    "ladder/semantics/standard_functions": ["ladder/semantics/expressions"],
    "ladder/semantics/calls": ["ladder/semantics/standard_functions"],
    "ladder/semantics/declarations": ["ladder/semantics/expressions"],
    "ladder/semantics/configuration": ["ladder/semantics/calls", "ladder/semantics/declarations"],
    "ladder/semantics/statements": ["ladder/semantics/calls"],
    "ladder/semantics": ["ladder/semantics/configuration", "ladder/semantics/statements"],
    "ladder/lint": ["ladder/semantics/model"],
    "ladder/lowering": ["ladder/syntax", "ladder/graphic"],
    "ladder/codegen": ["ladder/semantics/constants", "runtime/bytecode/writer"],
    "ladder/exchange": ["ladder/graphic", "ladder/lowering"],
    "ladder/driver": ["ladder/lowering", "ladder/codegen", "ladder/lint", "ladder/print", "ladder/semantics"],
    "ladder/source_files": ["ladder/driver", "ladder/exchange", "runtime/ground/files"],
    "supervisor/model": ["runtime/base", "runtime/ground/result"],
    "supervisor/lisp": ["runtime/ground/result"],
    "supervisor/pddl/definition": ["supervisor/lisp"],
    "supervisor/pddl/lifted": ["supervisor/pddl/definition", "supervisor/model"],
    "supervisor/pddl/syntax": ["supervisor/pddl/definition"],
    "supervisor/pddl/semantics": ["supervisor/pddl/lifted", "supervisor/pddl/syntax"],
    "supervisor/pddl/task": ["supervisor/pddl/semantics"],
    "supervisor/pddl/action": ["supervisor/pddl/task"],
    "supervisor/pddl/plan": ["supervisor/pddl/action"],
    "supervisor/pddl/ground_task": ["supervisor/pddl/definition", "supervisor/model"],
    "supervisor/pddl/grounding": ["supervisor/pddl/lifted", "supervisor/pddl/ground_task"],
    "supervisor/pddl/search/space": ["supervisor/pddl/ground_task"],
    "supervisor/pddl/search/control": ["supervisor/pddl/search/space"],
    "supervisor/pddl/search/relaxation": ["supervisor/pddl/search/space"],
    "supervisor/pddl/search/landmarks": ["supervisor/pddl/search/control", "supervisor/pddl/search/relaxation"],
    "supervisor/pddl/search/bounds": ["supervisor/pddl/search/relaxation"],
    "supervisor/pddl/search/lp": ["supervisor/pddl/search/bounds"],
    "supervisor/pddl/search/pruning": ["supervisor/pddl/search/space"],
    "supervisor/pddl/search/engines": [
        "supervisor/pddl/search/landmarks", "supervisor/pddl/search/lp", "supervisor/pddl/search/pruning",
    ],
    "supervisor/pddl/search/improvement": ["supervisor/pddl/search/engines"],
    "supervisor/pddl/search/portfolio": ["supervisor/pddl/search/improvement"],
    "supervisor/pddl/planner": ["supervisor/pddl/plan", "supervisor/pddl/grounding", "supervisor/pddl/search/portfolio"],
    "supervisor/htn/syntax": ["supervisor/lisp"],
    "supervisor/htn/task": ["supervisor/htn/syntax"],
    "supervisor/htn/plan": ["supervisor/htn/task", "supervisor/model"],
    "supervisor/htn/search": ["supervisor/htn/plan"],
    "supervisor/ltl/formula": ["runtime/ground/result"],
    "supervisor/ltl/syntax": ["supervisor/ltl/formula"],
    "supervisor/ltl/automaton": ["supervisor/ltl/syntax"],
    "supervisor/ltl/hoa": ["supervisor/ltl/automaton"],
    "supervisor/ltl/drawing": ["supervisor/ltl/automaton", "runtime/ground/markup"],
    "supervisor/ltl/monitor": ["supervisor/ltl/automaton"],
    "supervisor/ltl/trace": ["supervisor/ltl/automaton", "runtime/ground/csv", "runtime/ground/naming"],
    "supervisor/ltl/guide": ["supervisor/ltl/automaton", "supervisor/ltl/regions"],
    "supervisor/ltl/train": ["supervisor/ltl/regions"],
    "supervisor/ltl/regions": ["supervisor/geometry", "runtime/ground/result"],
    "supervisor/ltl/lanes": [],
    "supervisor/ltl/scene": ["supervisor/ltl/train", "supervisor/map"],
    "supervisor/ltl/route": ["supervisor/ltl/lanes", "supervisor/ltl/scene", "supervisor/ltl/guide"],
    "supervisor/ltl/bound": ["supervisor/ltl/scene", "supervisor/ltl/guide"],
    "supervisor/ltl/search": ["supervisor/ltl/route"],
    "supervisor/ltl/checker": ["supervisor/ltl/automaton", "supervisor/ltl/train", "plant_models/ode"],
    "supervisor/ltl/planner": ["supervisor/ltl/search", "supervisor/ltl/checker", "runtime/ground/markup"],
    "supervisor/ltl/program": ["supervisor/ltl/planner", "supervisor/ltl/monitor", "supervisor/vehicle", "ladder/graphic"],
    "supervisor/ltl/mission": ["supervisor/ltl/drawing", "supervisor/ltl/program", "supervisor/run", "ladder/driver", "runtime/bytecode/reader"],
    "supervisor/tamp/intervals/reach": [],
    "supervisor/tamp/intervals/arm": ["supervisor/tamp/intervals/reach", "supervisor/motion/kinematics"],
    "supervisor/tamp/intervals/program": ["supervisor/tamp/intervals/reach", "ladder/graphic"],
    "supervisor/tamp/intervals/sequence": ["supervisor/tamp/intervals/reach", "runtime/ground/result"],
    "supervisor/tamp/intervals/network": ["supervisor/tamp/intervals/sequence"],
    "supervisor/tamp/intervals/cause": ["supervisor/geometry", "supervisor/tamp/intervals/network"],
    "supervisor/tamp/intervals/search": ["supervisor/tamp/intervals/cause"],
    "supervisor/tamp/intervals/file": ["supervisor/tamp/intervals/arm", "supervisor/tamp/intervals/sequence", "runtime/ground/settings"],
    "supervisor/tamp/intervals/drawing": ["supervisor/tamp/intervals/network", "runtime/ground/markup"],
    "supervisor/tamp/scene": ["supervisor/motion/path", "runtime/ground/settings"],
    "supervisor/tamp/predicates": ["supervisor/geometry", "supervisor/tamp/scene", "supervisor/htn/search"],
    "supervisor/tamp/literal": ["supervisor/tamp/predicates"],
    "supervisor/tamp/planner": ["supervisor/tamp/literal", "supervisor/pddl/planner", "supervisor/tamp/intervals/arm", "supervisor/tamp/intervals/cause"],
    "supervisor/tamp/judge": ["supervisor/tamp/scene"],
    "supervisor/tamp/drawing": ["supervisor/tamp/scene", "runtime/ground/markup"],
    "supervisor/tamp/schedule": ["supervisor/tamp/scene", "supervisor/motion/timing"],
    "supervisor/tamp/program": ["supervisor/tamp/schedule", "supervisor/vehicle", "ladder/graphic"],
    "supervisor/tamp/pictures": ["supervisor/tamp/program", "supervisor/run"],
    "supervisor/tamp/mission": ["supervisor/tamp/pictures", "supervisor/tamp/planner", "supervisor/tamp/program", "supervisor/run", "ladder/driver", "runtime/bytecode/reader"],
    "supervisor/motion/spatial": [],
    "supervisor/motion/robot": ["supervisor/motion/spatial", "runtime/ground/result"],
    "supervisor/motion/kinematics": ["supervisor/motion/robot"],
    "supervisor/motion/mesh": ["supervisor/motion/robot"],
    "supervisor/motion/spheres": ["supervisor/motion/mesh"],
    "supervisor/motion/collision": ["supervisor/motion/kinematics", "supervisor/motion/spheres"],
    "supervisor/motion/recheck": ["supervisor/motion/collision"],
    "supervisor/motion/path": ["supervisor/motion/recheck"],
    "supervisor/motion/blend": ["supervisor/motion/path"],
    "supervisor/motion/timing": ["supervisor/motion/blend"],
    "supervisor/motion/moveit": ["supervisor/motion/collision"],
    "supervisor/motion/ompl": ["supervisor/motion/path"],
    "supervisor/motion/scene": ["supervisor/motion/recheck", "runtime/ground/settings"],
    "supervisor/motion/drawing": ["supervisor/motion/path", "supervisor/geometry", "runtime/ground/markup"],
    "supervisor/motion/problem": ["supervisor/motion/moveit", "supervisor/motion/scene", "supervisor/motion/ompl", "runtime/ground/files"],
    "supervisor/geometry": [],
    "supervisor/vehicle": ["supervisor/geometry", "ladder/graphic"],
    "supervisor/map": ["supervisor/geometry", "runtime/ground/result"],
    "supervisor/fleet/lattice": ["supervisor/map", "runtime/ground/files"],
    "supervisor/fleet/envelope": ["supervisor/map"],
    "supervisor/fleet/network": ["runtime/base"],
    "supervisor/fleet/schedule": ["supervisor/fleet/network", "supervisor/fleet/envelope"],
    "supervisor/fleet/control": ["supervisor/geometry", "supervisor/vehicle", "runtime/ground/result"],
    "supervisor/fleet/plan": ["supervisor/fleet/lattice", "supervisor/fleet/schedule"],
    "supervisor/fleet/allocation": ["supervisor/fleet/network", "runtime/ground/result"],
    "supervisor/fleet/mission": ["runtime/ground/markup", "supervisor/fleet/allocation", "supervisor/fleet/plan"],
    "supervisor/fleet/traffic": ["supervisor/fleet/plan", "supervisor/fleet/control"],
    "supervisor/fleet/program": ["supervisor/fleet/plan", "supervisor/fleet/control", "supervisor/vehicle", "ladder/graphic"],
    "supervisor/fleet/report": ["supervisor/fleet/mission"],
    "supervisor/fleet/prepare": ["supervisor/fleet/mission", "supervisor/fleet/program", "ladder/driver"],
    "supervisor/fleet/executive": ["supervisor/fleet/prepare", "supervisor/fleet/report", "supervisor/run", "runtime/ground/files"],
    "supervisor/fleet/vda5050": ["supervisor/fleet/plan"],
    "supervisor/fleet/vda5050/link": ["supervisor/fleet/vda5050", "runtime/bytecode/reader", "runtime/ground/mqtt", "runtime/ground/settings"],
    "supervisor/translate": ["supervisor/model", "ladder/graphic", "runtime/ground/settings"],
    "supervisor/run": ["supervisor/geometry", "supervisor/translate", "ladder/graphic", "runtime/bytecode/reader", "runtime/dds"],
    "supervisor/executive": [
        "supervisor/run", "supervisor/translate", "supervisor/pddl/planner", "ladder/driver", "ladder/exchange", "runtime/bytecode/reader", "runtime/ground/files",
    ],
    "plant_models/core": ["runtime/ground/result", "runtime/base"],
    "plant_models/ode": ["plant_models/core"],
    "plant_models/body2d": ["plant_models/core"],
    "plant_models/components": ["plant_models/ode", "runtime/ground/markup", "runtime/ground/settings"],
    "plant_models/components/library": ["plant_models/components", "plant_models/fmu"],
    "plant_models/assemblies": ["plant_models/ode", "plant_models/body2d"],
    "plant_models/bridge": ["plant_models/core", "runtime/image"],
    "plant_models/stepped": ["plant_models/core", "runtime/ground/process"],
    "plant_models/fmu": ["plant_models/stepped"],
    "plant_models/program": ["plant_models/stepped", "runtime/bytecode/reader", "runtime/host"],
    "hmi_web/storage": ["runtime/ground/files"],
    "hmi_web/historian": ["hmi_web/storage", "runtime/base"],
    "hmi_web/alarms": ["hmi_web/storage", "runtime/base", "runtime/ground/settings"],
    "hmi_web/protocol": ["runtime/ground/result"],
    "hmi_web/tags": ["hmi_web/protocol", "runtime/bytecode/reader"],
    "hmi_web/client": ["hmi_web/protocol"],
    "hmi_web/recorder": ["hmi_web/alarms", "hmi_web/api", "hmi_web/historian", "hmi_web/server", "runtime/ground/csv"],
    "hmi_web/access": ["hmi_web/storage"],
    "hmi_web/recipes": ["hmi_web/storage", "runtime/bytecode/reader", "runtime/ground/settings"],
    "hmi_web/drawing": ["runtime/ground/markup", "runtime/ground/result"],
    "hmi_web/screens": ["hmi_web/storage", "hmi_web/drawing", "runtime/bytecode/reader"],
    "hmi_web/change": ["hmi_web/access", "hmi_web/recipes", "hmi_web/screens", "runtime/ground/log", "runtime/host"],
    "hmi_web/trends": ["hmi_web/storage"],
    "hmi_web/api": ["hmi_web/access", "hmi_web/alarms", "hmi_web/change", "hmi_web/recipes", "hmi_web/screens", "hmi_web/tags", "hmi_web/trends", "runtime/ground/csv", "runtime/service"],
    "hmi_web/notify": ["hmi_web/alarms", "hmi_web/api"],
    "hmi_web/monitor": ["hmi_web/server", "ladder/graphic", "ladder/semantics/constants"],
    "hmi_web/server": ["hmi_web/api", "hmi_web/protocol", "hmi_web/tags", "runtime/dds", "runtime/bytecode/reader", "supervisor/model"],
    "cell/config": [
        "cell/missions/table", "runtime/dds", "runtime/ground/csv", "runtime/ground/log", "runtime/ground/process", "runtime/io_memory", "runtime/modbus/client",
        "runtime/modbus/server",
    ],
    "cell/device_status": ["runtime/ground/result"],
    "cell/hall": ["cell/config", "plant_models/assemblies", "supervisor/ltl/scene", "supervisor/map"],
    "cell/robot": ["cell/config", "plant_models/assemblies", "runtime/ground/files", "supervisor/motion/kinematics"],
    "cell/runtime": [
        "cell/config", "cell/device_status", "cell/hall", "cell/robot", "plant_models/assemblies", "plant_models/bridge", "plant_models/components/library", "plant_models/fmu", "plant_models/stepped", "runtime/io_memory", "runtime/service", "supervisor/map",
    ],
    "cell/binding": [
        "cell/missions/planning", "cell/runtime", "plant_models/bridge", "plant_models/components/library", "supervisor/pddl/action", "supervisor/translate",
    ],
    "cell/trial": ["cell/binding", "cell/simulation", "ladder/driver", "supervisor/executive", "supervisor/pddl/planner", "supervisor/run"],
    "cell/monitor_check": ["cell/config", "runtime/bytecode/reader"],
    "cell/monitors": ["cell/monitor_check", "ladder/driver", "ladder/graphic", "runtime/bytecode/reader", "supervisor/ltl/monitor"],
    "cell/program": ["cell/config", "cell/monitors", "ladder/driver", "ladder/source_files"],
    "cell/simulation": ["supervisor/run", "plant_models/bridge", "runtime/host", "runtime/scan"],
    "cell/campaign": [
        "cell/config", "cell/missions", "cell/missions/planning/table", "cell/monitor_check", "cell/program", "cell/runtime", "cell/simulation", "hmi_web/alarms",
        "plant_models/bridge",
        "supervisor/run", "supervisor/translate",
    ],
    "cell/check": [
        "cell/binding", "cell/gateway", "cell/hmi", "cell/missions", "cell/program", "plant_models/program",
    ],
    "cell/testing": ["ladder/source_files", "runtime/ground/process", "runtime/host"],
    "cell/import": ["cell/config", "ladder/driver", "ladder/exchange", "runtime/ground/markup"],
    "cell/fleet": ["cell/config", "supervisor/fleet/mission", "supervisor/fleet/program"],
    "cell/gateway": ["cell/runtime", "runtime/metrics", "runtime/remote"],
    "cell/tags": ["cell/config", "hmi_web/tags"],
    "cell/hmi": ["cell/config", "cell/hall", "hmi_web/alarms", "hmi_web/notify", "hmi_web/recorder", "hmi_web/server", "plant_models/assemblies", "plant_models/bridge", "plant_models/components/library", "runtime/dds", "runtime/ground/markup", "supervisor/map"],
    "cell/link": ["runtime/dds"],
    "cell/metrics_server": ["cell/config", "hmi_web/server", "runtime/metrics"],
    "cell/modbus_client": ["cell/device_status", "runtime/io_memory", "runtime/metrics", "runtime/modbus/client"],
    "cell/modbus_server": ["cell/config", "runtime/metrics", "runtime/modbus/server"],
    "cell/processes": ["cell/config", "runtime/ground/process"],
    "cell/reference": ["cell/config", "hmi_web/alarms", "hmi_web/recipes", "plant_models/components/library", "runtime/ground/settings", "supervisor/translate"],
    "cell/missions/table": ["ladder/source", "runtime/ground/settings"],
    "cell/missions": ["cell/config", "cell/monitors", "supervisor/run"],
}
# The planners of cell/missions/missions.def that are not named above, with all folders inside of theirs: none
# includes another one.
MISSIONS = "cell/missions/missions.def"
OF_A_MISSION = ["supervisor/run", "supervisor/geometry", "supervisor/translate", "ladder/driver", "ladder/exchange", "runtime/bytecode/reader"]
# Composition roots and tests may include everything; nothing else includes them.
FREE = ("programs/", "tests/")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
SOURCES = {".h", ".cpp"}


def add_missions(root: pathlib.Path) -> None:
    """An arrow for each planner that has only its line in the list of planners; what a cell's file knows of each."""
    for name in re.findall(r"^STEPWRIGHT_MISSION\((\w+)\)", (root / MISSIONS).read_text(encoding="utf-8"), re.MULTILINE):
        named = any(folder == f"supervisor/{name}" or folder.startswith(f"supervisor/{name}/") for folder in ARROWS)
        if not named:
            ARROWS[f"supervisor/{name}"] = OF_A_MISSION
        table, mission = f"cell/missions/{name}/table", f"cell/missions/{name}"
        ARROWS[table] = ["cell/missions/table"]
        planners = [folder for folder in ARROWS if folder.startswith("supervisor/")]
        ARROWS[mission] = ["cell/missions", "cell/fleet", "cell/monitors", table, *planners]


def folder_of(path: str) -> str:
    """The deepest folder of the table that holds the path: host-side parts of a portable folder are their own."""
    parts = path.split("/")[:-1]
    for depth in range(len(parts), 2, -1):
        if (inner := "/".join(parts[:depth])) in ARROWS:
            return inner
    return "/".join(parts[:2])


def reachable() -> dict[str, set[str]]:
    closure: dict[str, set[str]] = {}

    def visit(folder: str) -> set[str]:
        if folder not in closure:
            closure[folder] = {folder}
            for target in ARROWS[folder]:
                closure[folder] |= visit(target)
        return closure[folder]

    for folder in ARROWS:
        visit(folder)
    return closure


def cycles() -> list[str]:
    """The arrows of the table that lead back to where they begin: they would allow everything among the folders on the way."""
    allowed = reachable()
    return [
        f"the table of arrows has a circle: {folder} -> {target} -> ... -> {folder}"
        for folder, targets in ARROWS.items() for target in targets if folder in allowed[target]
    ]


def broken(root: pathlib.Path) -> list[str]:
    allowed = reachable()
    problems = []
    for top in sorted({folder.split("/")[0] for folder in ARROWS}):
        for file in sorted((root / top).rglob("*")):
            path = file.relative_to(root).as_posix()
            if file.suffix not in SOURCES or "node_modules" in path:
                continue
            folder = folder_of(path)
            if folder not in ARROWS:
                problems.append(f"{path}: the folder {folder} has no entry in the table of arrows")
                continue
            for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                target = match.group(1)
                if "/" not in target or target == MISSIONS or not (root / target).exists():
                    continue  # generated, third party, the list of planners; the compiler judges those
                if target.startswith(FREE) or folder_of(target) not in allowed[folder]:
                    problems.append(f"{path}:{number}: {folder} may not include {target}")
    return problems


def libraries_in_programs(root: pathlib.Path) -> list[str]:
    """Processes read options, put parts together and run; what knows something is a library of another folder (ADR 13)."""
    return [
        f"{file.relative_to(root)}: a library in programs/"
        for file in sorted((root / "programs").rglob("CMakeLists.txt")) if "stepwright_library(" in file.read_text(encoding="utf-8")
    ]


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    add_missions(root)
    problems = cycles() + broken(root) + libraries_in_programs(root)
    print("\n".join(problems) or "all includes follow the arrows")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
