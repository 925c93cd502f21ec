#include <array>

#include "cell/reference/described_file.h"

namespace stepwright::reference {
namespace {

using settings::KeyWords;

constexpr std::string_view kFigure = "a figure with its unit, in quotes";
constexpr std::string_view kMeaning = "What it is, for people.";
constexpr std::string_view kUnit = "Its unit, as UDUNITS-2 reads it.";
constexpr std::string_view kExpression = "an expression of parameters, inputs and states";
constexpr std::string_view kStart =
    "a figure with its unit, or an expression of parameters, inputs, states and faults";
constexpr std::string_view kSwitch = "It is true or false, and has no unit.";

constexpr std::array kPlantFileKeys = {
    KeyWords{"plant", "The plant as a whole."},
    KeyWords{"plant.name", "Its name, for people.", "", "the name of the file"},
    KeyWords{"plant.density", "Of the liquid.", "", "", kFigure},
    KeyWords{"plant.heat_capacity", "Of the liquid.", "", "", kFigure},
    KeyWords{"plant.gravity", "Where the plant stands.", "", "", kFigure},
    KeyWords{"plant.room_temperature", "Of the air around it.", "", "", kFigure},
    KeyWords{"plant.communication_step", "Between two exchanges with components that are FMUs.", "", "",
             kFigure},

    KeyWords{"solver", "How the equations are solved."},
    KeyWords{"solver.method",
             "Adams, which keeps what is conserved to rounding; or BDF and Newton, for stiff plants."},
    KeyWords{"solver.relative_tolerance", "Of states, for each step.", "1"},
    KeyWords{"solver.longest_step", "No step is longer.", "", "", kFigure},

    KeyWords{"components", "What the plant is made of, by name."},
    KeyWords{"components.NAME",
             "One component: its type, and what the type has beside, parameters and ports."},
    KeyWords{"components.NAME.type", "A type of the library, of `[types]` or of `[assemblies]`."},
    KeyWords{"components.NAME.PARAMETER", "A figure of its type.", "", "that of the type", kFigure},

    KeyWords{"terminals", "What program and plant share."},
    KeyWords{"terminals.TERMINAL", "The address of what the program drives, `%QX0.0`; or a table."},
    KeyWords{"terminals.TERMINAL.address", "Of what the program reads: `%IW1`."},
    KeyWords{"terminals.TERMINAL.from", "The output of a component that it reads: `s1.counts`."},

    KeyWords{"truths", "Other names of values, for reports and the page."},
    KeyWords{"truths.VALUE", "The value that is meant, `t1.level`; or a table."},
    KeyWords{"truths.VALUE.of", "The value that is meant."},
    KeyWords{"truths.VALUE.unit", "Another unit than its own.", "", "its own"},
    KeyWords{"truths.VALUE.factor", "Under this name it is so many times the value.", "1"},
    KeyWords{"faults", "Other names of faults."},
    KeyWords{"faults.FAULT", "The fault that is meant, `t1.leak`; or a table."},
    KeyWords{"faults.FAULT.of", "The fault that is meant."},
    KeyWords{"faults.FAULT.unit", "Another unit than its own.", "", "its own"},
    KeyWords{"faults.FAULT.factor", "Under this name it is so many times the fault.", "1"},

    KeyWords{"assemblies", "Types that are made of components."},
    KeyWords{"assemblies.ASSEMBLY", "One type."},
    KeyWords{"assemblies.ASSEMBLY.parameters",
             "What may be set where it is used; its parts name it `$PARAMETER`."},
    KeyWords{"assemblies.ASSEMBLY.parameters.PARAMETER", "Where nothing is set.", "", "", kFigure},
    KeyWords{"assemblies.ASSEMBLY.components", "Its parts, as in `[components]`."},
    KeyWords{"assemblies.ASSEMBLY.components.NAME", "One part."},
    KeyWords{"assemblies.ASSEMBLY.components.NAME.type", "As in `[components]`."},
    KeyWords{"assemblies.ASSEMBLY.ports",
             "Its ports, each with the port of a part that it is: `out = \"p1.out\"`."},

    KeyWords{"types", "Types by their equations."},
    KeyWords{"types.TYPE", "One type."},
    KeyWords{"types.TYPE.meaning", kMeaning},
    KeyWords{"types.TYPE.parameters", "Figures that a component of it has."},
    KeyWords{"types.TYPE.parameters.PARAMETER", "One figure."},
    KeyWords{"types.TYPE.parameters.PARAMETER.unit", kUnit},
    KeyWords{"types.TYPE.parameters.PARAMETER.default", "Where a component says none.", "",
             "a component needs it", kFigure},
    KeyWords{"types.TYPE.parameters.PARAMETER.meaning", kMeaning},
    KeyWords{"types.TYPE.faults", "What can be wrong with it."},
    KeyWords{"types.TYPE.faults.FAULT", "One fault, a figure of the equations."},
    KeyWords{"types.TYPE.faults.FAULT.unit", kUnit},
    KeyWords{"types.TYPE.faults.FAULT.low", "The least that a fault can be.", "that of `unit`"},
    KeyWords{"types.TYPE.faults.FAULT.high", "The greatest.", "that of `unit`"},
    KeyWords{"types.TYPE.faults.FAULT.rest", "Without the fault.", "", "", kFigure},
    KeyWords{"types.TYPE.faults.FAULT.meaning", kMeaning},
    KeyWords{"types.TYPE.inputs", "Signals that it takes."},
    KeyWords{"types.TYPE.inputs.INPUT", "One signal."},
    KeyWords{"types.TYPE.inputs.INPUT.unit", kUnit},
    KeyWords{"types.TYPE.inputs.INPUT.switch", kSwitch},
    KeyWords{"types.TYPE.inputs.INPUT.default", "Where it is joined to nothing.", "", "it must be joined",
             kFigure},
    KeyWords{"types.TYPE.inputs.INPUT.meaning", kMeaning},
    KeyWords{"types.TYPE.ports", "Ports of liquid."},
    KeyWords{"types.TYPE.ports.FLUID_PORT", "A branch, whose flow follows from the pressures."},
    KeyWords{"types.TYPE.ports.FLUID_PORT.role", "A branch gives a flow, a node a pressure."},
    KeyWords{"types.TYPE.ports.FLUID_PORT.flow", "Of a branch.", "m³/s", "", kExpression},
    KeyWords{"types.TYPE.ports.FLUID_PORT.meaning", kMeaning},
    KeyWords{"types.TYPE.ports.NODE_PORT", "A node, whose pressure follows from the states."},
    KeyWords{"types.TYPE.ports.NODE_PORT.role", "A branch gives a flow, a node a pressure."},
    KeyWords{"types.TYPE.ports.NODE_PORT.pressure", "Of a node.", "Pa", "", kExpression},
    KeyWords{"types.TYPE.ports.NODE_PORT.meaning", kMeaning},
    KeyWords{"types.TYPE.states", "What it remembers."},
    KeyWords{"types.TYPE.states.STATE", "One state."},
    KeyWords{"types.TYPE.states.STATE.unit", kUnit},
    KeyWords{"types.TYPE.states.STATE.derivative", "How it changes, by the second.", "", "", kExpression},
    KeyWords{"types.TYPE.states.STATE.start", "Where it begins.", "", "", kStart},
    KeyWords{"types.TYPE.states.STATE.liquid", "It counts as liquid of the plant, whose sum stays."},
    KeyWords{"types.TYPE.states.STATE.tolerance", "Below it the solver need not be exact.", "", "", kFigure},
    KeyWords{"types.TYPE.outputs", "Values that others may read."},
    KeyWords{"types.TYPE.outputs.OUTPUT", "One value."},
    KeyWords{"types.TYPE.outputs.OUTPUT.unit", kUnit},
    KeyWords{"types.TYPE.outputs.OUTPUT.switch", kSwitch},
    KeyWords{"types.TYPE.outputs.OUTPUT.value", "What it is.", "", "", kExpression},
    KeyWords{"types.TYPE.outputs.OUTPUT.meaning", kMeaning},
    KeyWords{"types.TYPE.events", "Instants at which states jump."},
    KeyWords{"types.TYPE.events.EVENT", "One instant."},
    KeyWords{"types.TYPE.events.EVENT.when",
             "The instant at which this reaches zero, or jumps to it or through it.", "", "", kExpression},
    KeyWords{"types.TYPE.events.EVENT.falling", "When it falls through zero."},
    KeyWords{"types.TYPE.events.EVENT.rising", "When it rises through zero.", "", "not with `falling`"},
    KeyWords{"types.TYPE.events.EVENT.set", "The states that jump."},
    KeyWords{"types.TYPE.events.EVENT.set.STATE", "Where to.", "", "", kExpression},
};

}  // namespace

std::span<const KeyWords> plant_file_keys() {
  return kPlantFileKeys;
}

}  // namespace stepwright::reference
