"""The public Reference FMUs (github.com/modelica/Reference-FMUs), unchanged, against the results that they bring or an analytic answer.

STEPWRIGHT_REFERENCE_FMUS names a folder with them: fmu2/NAME.fmu, fmu3/NAME.fmu and, of what has results, NAME/NAME_out.csv.
Without it nothing is tested, and that is said."""

import csv
import os
import pathlib
import unittest

from processes import stepwright
from stepped_cell import SteppedCell

FOLDER = os.environ.get("STEPWRIGHT_REFERENCE_FMUS", "")

PLANT = """[plant]
communication_step = "{step_s} s"

[components.m]
type = "fmu"
file = "{file}"
units = {{ {units} }}
{inputs}

[components.card]
type = "analog_input"
of = "m.{first}"
low = "-100 {unit}"
high = "100 {unit}"

[terminals]
SHOWN = {{ address = "%IW0", from = "card" }}
"""

CELL = """[cell]
name = "reference"
state_dir = "state"

[clock]
mode = "simulated"
speed = 0
interval_us = {interval_us}

[plant]
kind = "fmu"
file = "{file}"
timeout_ms = 60_000
start_timeout_ms = 120_000

[plant.sensors]
{name} = {{ address = "%IW0", unit = "{unit}", range = [-100.0, 100.0] }}
"""

PROGRAM = """PROGRAM Main
VAR
  shown AT %IW0 : INT;
  last : INT;
END_VAR
  last := shown;
END_PROGRAM
CONFIGURATION cell
  RESOURCE plc ON PLC
    TASK main (INTERVAL := T#{interval_ms}ms, PRIORITY := 1);
    PROGRAM Main WITH main : Main;
  END_RESOURCE
END_CONFIGURATION
"""

# Model: seconds, step, outputs with their units.
RESULTS = {
    "BouncingBall": (2.9, 0.01, {"h": "m", "v": "m/s"}),
    "Dahlquist": (10.0, 0.1, {"x": "1"}),
    "VanDerPol": (20.0, 0.01, {"x0": "1", "x1": "1"}),
    "Stair": (8.8, 0.2, {"counter": "1"}),
    "Resource": (1.0, 1.0, {"y": "1"}),
}
# Input, output, what goes in: of each type that both versions have.
THROUGH = (("Float64_continuous_input", "2.5"), ("Float64_discrete_input", "-1.25"), ("Int32_input", "-7"),
           ("Boolean_input", "true"), ("Enumeration_input", "2"))
COUNTS = 27648 / 200


def rows(path):
    with open(path, encoding="ascii") as file:
        return [{key: float(text) for key, text in row.items()} for row in csv.DictReader(file)]


def results_of(name):
    """By time in microseconds."""
    return {round(row["time"] * 1e6): row for row in rows(pathlib.Path(FOLDER) / name / f"{name}_out.csv")}


def fmus():
    """Every model in both versions."""
    for name in RESULTS:
        for version in (2, 3):
            yield name, fmu_of(name, version)


def fmu_of(name, version):
    return pathlib.Path(FOLDER).resolve() / f"fmu{version}" / f"{name}.fmu"


@unittest.skipUnless(FOLDER, "STEPWRIGHT_REFERENCE_FMUS is not set: no folder of Reference FMUs")
class ReferenceFmus(unittest.TestCase):
    def answer(self, cell, fmu, seconds, step_s, outputs, inputs=""):
        """Of the FMU as a component, without a controller: rows by time in microseconds."""
        plant, table = cell.folder / "plant.toml", cell.folder / "answer.csv"
        first, unit = next(iter(outputs.items()))
        units = ", ".join(f'"{name}" = "{unit}"' for name, unit in outputs.items())
        plant.write_text(PLANT.format(step_s=step_s, file=fmu, units=units, inputs=inputs, first=first, unit=unit), encoding="utf-8")
        done = stepwright("plant", plant, "--seconds", str(seconds), "--interval", str(step_s), "--csv", table,
                          *(part for name in outputs for part in ("--value", f"m.{name}")))
        self.assertEqual(done.returncode, 0, done.stderr)
        return {round(row["time_s"] * 1e6): {key.split(" ")[0].removeprefix("m."): value for key, value in row.items()}
                for row in rows(table)}

    def test_as_a_component_they_have_the_results_that_they_bring(self):
        for name, fmu in fmus():
            seconds, step_s, outputs = RESULTS[name]
            expected = results_of(name)
            with self.subTest(fmu=fmu), SteppedCell("fmu.toml") as cell:
                shown = self.answer(cell, fmu, seconds, step_s, outputs)
                both = sorted(set(shown) & set(expected))
                self.assertGreater(len(both), 0.9 * seconds / step_s)
                for time_us in both:
                    for output in outputs:  # the table has nine digits
                        self.assertAlmostEqual(shown[time_us][output], expected[time_us][output], delta=1e-7, msg=f"{output} at {time_us} us")

    def test_what_goes_in_comes_out(self):
        outputs = {name.replace("input", "output"): "1" for name, _ in THROUGH}
        for version in (2, 3):
            with self.subTest(version=version), SteppedCell("fmu.toml") as cell:
                shown = self.answer(cell, fmu_of("Feedthrough", version), 1.0, 0.1, outputs, "\n".join(f'{name} = "{text}"' for name, text in THROUGH))
                for name, text in THROUGH:
                    self.assertEqual(shown[1_000_000][name.replace("input", "output")], float({"true": 1}.get(text, text)), name)

    def test_arrays_are_their_elements(self):
        """StateSpace has three inputs and states of the same kind, side by side; FMI 3 alone has arrays."""
        outputs = {f"y[{i}]": "1" for i in (1, 2, 3)}
        with open(pathlib.Path(FOLDER) / "StateSpace" / "StateSpace_out.csv", encoding="ascii") as file:
            expected = {int(row["time"]): float(row["y"].split()[0]) for row in csv.DictReader(file)}
        with SteppedCell("fmu.toml") as cell:
            shown = self.answer(cell, fmu_of("StateSpace", 3), 5.0, 1.0, outputs, '"u[2]" = "7"')
            for seconds in range(1, 6):
                row = shown[seconds * 1_000_000]
                for name, factor in zip(outputs, (1, 7, 3)):  # the nine digits of the table
                    self.assertAlmostEqual(row[name] / (factor * expected[seconds]), 1.0, delta=1e-8, msg=f"{name} at {seconds} s")

    def test_as_a_whole_plant_they_run_with_the_scan(self):
        for name, fmu in fmus():
            seconds, step_s, outputs = RESULTS[name]
            expected = results_of(name)
            output, unit = next(iter(outputs.items()))
            with self.subTest(fmu=fmu), SteppedCell("fmu.toml") as cell:
                cell.config.write_text(CELL.format(interval_us=round(step_s * 1e6), file=fmu, name=output, unit=unit), encoding="utf-8")
                (cell.folder / "tank.st").write_text(PROGRAM.format(interval_ms=round(step_s * 1e3)), encoding="utf-8")
                self.assertEqual(cell.check(), (0, []))
                cell.run()
                cell.step(max(1, round(0.5 * seconds / step_s)))
                counts = int(cell.values("Main.last")[0])
                # Scan k reads the plant as it is at (k - 1) steps.
                time_us = round((cell.scan - 1) * step_s * 1e6)
                value = expected[min(time_us, max(expected))][output]
                self.assertAlmostEqual(counts, (value + 100) * COUNTS, delta=1.0)


if __name__ == "__main__":
    unittest.main()
