"""`stepwright check`: what alarms, recipes and the drawing name is held against the program that the cell's sources make."""

import pathlib
import re
import tempfile
import unittest

from processes import stepwright

CELL = """\
[cell]
state_dir = "state"
[runtime]
sources = ["main.st"]
[history]
folder = "history"
alarms = "alarms.toml"
[hmi]
recipes = "recipes.toml"
drawing = "plant.svg"
"""
PROGRAM = """\
PROGRAM Main
  VAR temp : REAL; limit : REAL := 50.0; cleaning : BOOL; END_VAR
  temp := MIN(temp + 0.1, limit);
END_PROGRAM
"""
ALARM = '[[alarm]]\nname = "hot"\nsource = "{}"\nwhen = "high"\nlimit = 90\nsuppress_when = "{}"\n'
RECIPE = '[[tag]]\nname = "{}"\ntype = "REAL"\nmin = 0\nmax = 100\n'
DRAWING = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">\n<text data-text="{}"/>\n<rect data-on="!{}"/>\n</svg>\n'


class CheckNames(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.write(**{"cell.toml": CELL, "main.st": PROGRAM})
        self.names("Main.temp", "main.CLEANING", "Main.limit", "Main.temp", "Main.cleaning")

    def write(self, **files):
        for name, text in files.items():
            (self.folder / name).write_text(text, encoding="utf-8")

    def names(self, source, suppress, tag, text, on):
        self.write(**{"alarms.toml": ALARM.format(source, suppress), "recipes.toml": RECIPE.format(tag),
                      "plant.svg": DRAWING.format(text, on)})

    def check(self):
        return stepwright("check", cwd=self.folder)

    def test_names_that_are_there_in_any_case_are_sound(self):
        done = self.check()
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_each_name_that_is_not_there_is_told_at_its_place_with_the_nearest_one(self):
        self.names("Main.tempp", "Main.cleanin", "Main.limits", "Main.tmep", "Main.cleaned")
        done = self.check()
        self.assertEqual(done.returncode, 1)
        for place, said, meant in [
                ("alarms.toml:3:10", "the alarm 'hot' (source) names 'Main.tempp'", "Main.temp"),
                ("alarms.toml:6:17", "the alarm 'hot' (suppress_when) names 'Main.cleanin'", "Main.cleaning"),
                ("recipes.toml:2:8", "a recipe's tag (name) names 'Main.limits'", "Main.limit"),
                ("plant.svg:2:2", "the drawing names 'Main.tmep'", "Main.temp"),
                ("plant.svg:3:2", "the drawing names 'Main.cleaned'", "Main.cleaning")]:
            self.assertIn(f"{place}: C0532: {said}, which the program does not have\n  hint: did you mean '{meant}'?", done.stderr)
        self.assertEqual(done.stderr.count("C0532"), 5)

    def test_a_name_like_no_other_has_a_hint_too(self):
        self.names("Boiler.pressure", "Main.cleaning", "Main.limit", "Main.temp", "Main.cleaning")
        self.assertIn("hint: `stepwright snapshot` lists", self.check().stderr)

    def test_states_of_the_cell_and_addresses_are_no_variables(self):
        self.write(**{"main.st": PROGRAM.replace("cleaning : BOOL;", "cleaning : BOOL; wanted AT %MD4 : REAL;")})
        self.names("cell.runtime_alive", "Main.cleaning", "%MD4", "Main.temp", "Main.cleaning")
        self.assertEqual(self.check().stderr, "")

    def test_a_monitor_of_a_variable_that_is_not_there_is_told(self):
        self.write(**{"cell.toml": CELL + '[[monitors]]\nname = "cool"\nformula = "always cool"\nlet = { cool = "Main.tempp < 60.0" }\n'})
        done = self.check()
        self.assertEqual(done.returncode, 1)
        self.assertIn("tempp", done.stderr)

    def test_sources_that_do_not_compile_are_told(self):
        self.write(**{"main.st": PROGRAM.replace("0.1", "'x'")})
        done = self.check()
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"main\.st:3:\d+: E\d{4}")

    def test_a_screen_of_the_wall_that_is_not_drawn_or_not_for_viewers_is_a_warning(self):
        self.write(**{"cell.toml": CELL + '[hmi.wall]\naddresses = ["127.0.0.1"]\npanels = ["screen:Mixer", "screen:Secret"]\n'})
        done = self.check()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("and nobody has drawn it"), 2, done.stderr)
        screens = self.folder / "state/screens"
        screens.mkdir(parents=True)
        screen = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10" data-least="{}"/>\n'
        for name, least in (("Mixer", "viewer"), ("Secret", "operator")):
            (screens / f"{name}.svg").write_text(screen.format(least), encoding="utf-8")
        done = self.check()
        self.assertEqual((done.returncode, done.stderr.count("C0532")), (0, 1), done.stderr)
        self.assertIn("[hmi.wall] shows the screen 'Secret', which is for the role operator and above", done.stderr)

    def test_an_empty_field_of_a_copy_of_a_face_is_told_once_with_its_place(self):
        screens = self.folder / "state/screens"
        screens.mkdir(parents=True)
        copy = '<g data-symbol="face" data-params="{}"><text data-text="{{pump}}.speed"/><rect data-on="!{{pump}}.on"/></g>\n'
        said = "{&quot;face&quot;:&quot;PumpFace&quot;,&quot;key&quot;:&quot;p3&quot;}"
        (screens / "Forty.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">\n' + copy.format(said) + copy.format("[") + "</svg>\n", encoding="utf-8")
        done = self.check()
        self.assertEqual((done.returncode, done.stderr.count("C0532")), (0, 2), done.stderr)
        self.assertRegex(done.stderr, r"Forty\.svg:2:\d+: warning: C0532: the screen 'Forty': the field 'pump' of the copy p3 of the face 'PumpFace' is empty")
        self.assertRegex(done.stderr, r"Forty\.svg:3:\d+: warning: C0532: the screen 'Forty': the field 'pump' is empty")
        self.assertNotIn("names '{pump}", done.stderr)
    def test_what_names_the_right_thing_and_can_do_nothing_with_it_is_told(self):
        self.write(**{"main.st": PROGRAM.replace("cleaning : BOOL;", "cleaning : BOOL; batch : STRING; count : UDINT;"),
                      "cell.toml": CELL + "[tasks.nope]\nphase_us = 5\n",
                      "alarms.toml": ALARM.format("Main.batch", "cell.runtime_aliv"),
                      "recipes.toml": RECIPE.format("Main.count") + RECIPE.format("%MW40") + RECIPE.format("Main.limit")})
        done = self.check()
        self.assertEqual(done.returncode, 1)
        for place, said, hint in [
                ("alarms.toml:3:10: C0528", "the alarm 'hot' (source) is Main.batch, a STRING: it never has a number", "can be watched"),
                ("alarms.toml:6:17: C0532", "names 'cell.runtime_aliv', which is no figure of a cell", "'cell.runtime_alive'"),
                ("recipes.toml:1:1: C0528", "of the type REAL, and Main.count of the program is of the type UDINT", 'type = "UDINT"'),
                ("recipes.toml:7:8: C0529", "`%MW40` lies beyond the markers", "it has 0 bytes"),
                ("cell.toml:11:1: warning: C0532", "[tasks.nope] names a task that the program does not have", "its tasks: ")]:
            self.assertRegex(done.stderr, rf"{re.escape(place)}: .*{re.escape(said)}.*\n  hint: .*{re.escape(hint)}")
        self.assertEqual(done.stderr.count("error") + done.stderr.count("C05"), 5, done.stderr)

    def test_an_alarm_on_an_address_is_told_with_the_variable_there(self):
        self.write(**{"main.st": PROGRAM.replace("cleaning : BOOL;", "cleaning : BOOL; wanted AT %MD4 : REAL; idle AT %MX0.3 : BOOL;")})
        self.names("%MD4", "%MX0.3", "Main.limit", "Main.temp", "Main.cleaning")
        done = self.check()
        self.assertEqual(done.returncode, 1)
        for place, what, name in (("alarms.toml:3:10", "(source) is the address %MD4", "Main.wanted"), ("alarms.toml:6:17", "(suppress_when) is the address %MX0.3", "Main.idle")):
            self.assertIn(f"{place}: C0532: the alarm 'hot' {what}, and alarms watch variables by their names\n  hint: did you mean '{name}'?", done.stderr)

    def test_a_recipe_that_can_set_nothing_or_not_all_is_told(self):
        tag = '[[tag]]\nname = "{}"\ntype = "{}"\nmin = 0\nmax = {}\n'
        self.write(**{"main.st": PROGRAM.replace("cleaning : BOOL;", "cleaning : BOOL; note : STRING; count : INT; END_VAR VAR CONSTANT fixed : INT := 5;"),
                      "recipes.toml": tag.format("Main.fixed", "INT", 9) + tag.format("Main.note", "REAL", 9) + tag.format("Main.count", "DINT", 40000)})
        done = self.check()
        self.assertEqual(done.returncode, 1)
        self.assertIn("recipes.toml:2:8: C0528: a recipe's tag is Main.fixed, which is a constant of the program", done.stderr)
        self.assertIn("recipes.toml:6:1: C0528: a recipe's tag is of the type REAL, and Main.note of the program is of the type STRING", done.stderr)
        self.assertRegex(done.stderr, r"recipes\.toml:11:1: warning: C0528: a recipe's tag goes from 0 to 40000, and Main\.count .* from -32768 to 32767")
        self.write(**{"recipes.toml": tag.format("Main.count", "DINT", 32767) + tag.format("main.COUNT", "INT", 9)})
        done = self.check()
        self.assertNotIn("C0528", done.stderr)
        self.assertRegex(done.stderr, r"recipes\.toml:7:8: C0620: the tag 'main\.COUNT' is there twice")

    def test_what_nobody_would_ever_hear_of_is_told(self):
        told = '[[notify]]\nname = "shift"\nweb_hook = "https://chat.example/x"\n'
        monitor = '[[monitors]]\nname = "cool"\nformula = "always cool"\nlet = { cool = "Main.temp < 60.0" }\n'
        self.write(**{"cell.toml": CELL.replace('folder = "history"\n', "") + told + monitor})
        done = self.check()
        self.assertEqual(done.returncode, 1)
        self.assertIn("cell.toml:6:10: C0475: none of these alarms ever comes", done.stderr)
        self.assertIn("C0475: [[notify]] never tells of anything", done.stderr)
        self.assertRegex(done.stderr, r"cell\.toml:\d+:\d+: warning: C0475: the monitor 'cool' is to raise an alarm")
        self.write(**{"cell.toml": CELL + told + monitor})
        self.assertNotIn("C0475", self.check().stderr)

    def test_a_part_of_a_screen_that_can_never_write_is_a_warning_with_its_line(self):
        screens = self.folder / "state/screens"
        screens.mkdir(parents=True)
        part = '<g data-part="{}" data-key="{}" data-write="{}" {}><rect width="1" height="1"/></g>\n'
        parts = [("button", "text", "Main.temp", 'data-value="abc"'), ("setpoint", "flag", "Main.cleaning", 'data-from="0" data-to="5"'),
                 ("switch", "sound", "Main.cleaning", ""), ("slider", "limit", "Main.limit", 'data-from="0" data-to="90"')]
        (screens / "Mixer.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">\n' + "".join(part.format(*each) for each in parts) + "</svg>\n", encoding="utf-8")
        done = self.check()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"Mixer\.svg:2:2: warning: C0645: the button 'text' cannot write abc to Main\.temp: .*REAL\n  hint: ")
        self.assertRegex(done.stderr, r"Mixer\.svg:3:2: warning: C0645: the set point 'flag' writes numbers, and Main\.cleaning is of the type BOOL\n  hint: ")
        self.assertEqual(done.stderr.count("C0645"), 2, done.stderr)
        self.assertIn("cell.toml: 2 warnings", done.stdout)

    def test_a_part_of_a_screen_that_is_not_filled_in_is_a_warning_with_its_label(self):
        screens = self.folder / "state/screens"
        screens.mkdir(parents=True)
        idle = '<g data-symbol="{}" data-params=\'{{"label":"{}","key":"p1"}}\'><rect width="1" height="1"/></g>\n'
        (screens / "Mixer.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">\n' + idle.format("button", "Halt") + idle.format("navigate", "Next") + "</svg>\n", encoding="utf-8")
        done = self.check()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Mixer.svg:2:2: warning: C0647: the button 'Halt' writes nothing", done.stderr)
        self.assertIn("Mixer.svg:3:2: warning: C0647: the way to a screen 'Next' leads nowhere", done.stderr)

    def test_a_part_in_the_plants_picture_is_a_warning(self):
        self.write(**{"plant.svg": '<svg viewBox="0 0 9 9">\n<g data-part="switch" data-key="k" data-write="Main.cleaning"><rect/></g></svg>'})
        self.assertIn("plant.svg:2:2: warning: C0645: the operator part 'k' of [hmi] drawing does nothing", self.check().stderr)

    def test_a_source_that_is_no_utf8_is_a_warning_with_its_place(self):
        (self.folder / "main.st").write_bytes(PROGRAM.replace("temp : REAL;", "temp : REAL; // °C").replace("limit :", "\n limit :", 1).encode("latin-1"))
        done = self.check()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"main\.st:2:23: warning: C0533: this is no UTF-8")

    def test_points_of_the_plant_are_names_too(self):
        self.write(**{"cell.toml": CELL + '[plant]\nkind = "tank_bench"\n'})
        self.names("a1.level", "Main.cleaning", "Main.limit", "a1.level", "Main.cleaning")
        self.assertNotIn("C0532", self.check().stderr)


if __name__ == "__main__":
    unittest.main()
