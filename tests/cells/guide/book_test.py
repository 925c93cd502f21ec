"""Pages of the user's book with commands: each in a clean folder, all commands in their order, then what they promise."""

import json
import re
import unittest

from guide_pages import BOOK, MOST_LINES, Guide, blocks, page
from processes import eventually, get

TREND = "/api/history/trend?tags=Main.level&span_ms=60000"


class Book(Guide):
    def run_all(self, name):
        self.bash("".join(blocks(page(name))), self.root)

    def test_every_page_with_commands_is_executed(self):
        """A page that the index marks has blocks of commands, and one with such blocks is marked."""
        marked = set(re.findall(r"\]\(([\w-]+\.md)\) ▶", page("README.md")))
        self.assertEqual(marked, {"getting-started.md", "first-program.md", "languages.md", "modbus-plant.md", "from-openplc.md", "planning.md", "plan-your-plant.md"})
        self.assertEqual(marked, {path.name for path in BOOK.glob("*.md") if blocks(path.read_text(encoding="utf-8"))})

    def test_the_first_program(self):
        self.run_all("first-program.md")
        self.assertTrue((self.root / "delay.csv").read_text(encoding="utf-8").startswith("scan"))

    def test_languages(self):
        self.run_all("languages.md")
        self.assertIn("<svg", (self.root / "mixer.svg").read_text(encoding="utf-8"))

    def test_planning(self):
        self.run_all("planning.md")
        reports = [json.loads((self.root / name).read_text(encoding="utf-8")) for name in ("report.json", "changed.json")]
        self.assertTrue(all(each["goal_reached"] for each in reports))
        self.assertEqual(reports[0]["replans"], 0)
        self.assertGreater(reports[1]["replans"], 0, "the demand has changed")

    def test_a_plant_of_two_modbus_devices(self):
        text = page("modbus-plant.md")
        self.assertLessEqual(len(text.splitlines()), MOST_LINES)
        *before, last = blocks(text)
        self.ends_with_the_test("plant/cell.toml")
        folder = self.root / "plant"
        self.bash("".join(before), self.root)
        try:
            self.assertEqual(get(8080, "/")[0].status, 200)
            listed = lambda: json.loads(get(8080, "/api/alarms?all=1")[1])
            self.assertTrue(eventually(lambda: listed()["figures"]["no_value"] == 0))
            self.assertIn("level low", {each["name"] for each in listed()["alarms"]})
            values = lambda: [each for each in json.loads(get(8080, TREND)[1])["series"][0]["last"] if each is not None]
            self.assertTrue(eventually(lambda: len(set(values())) > 3), "the level has a trend")
            self.assertTrue(all(0 <= each <= 100 for each in values()), "in percent")
        finally:
            self.bash(last, folder)

    def test_its_excerpts_are_those_of_the_example(self):
        files = {name: (BOOK / "examples/modbus" / name).read_text(encoding="utf-8") for name in ("cell.toml", "main.st", "alarms.toml")}
        excerpts = re.findall(r"^```(?:toml|st)\n(.*?)^```$", page("modbus-plant.md"), re.M | re.S)
        self.assertEqual(len(excerpts), 3)
        for excerpt in excerpts:
            self.assertTrue(any(excerpt in text for text in files.values()), excerpt)

    def test_from_openplc(self):
        text = page("from-openplc.md")
        self.assertLessEqual(len(text.splitlines()), MOST_LINES)
        *before, last = blocks(text)
        self.ends_with_the_test("fan/cell.toml")
        self.bash("".join(before), self.root)
        self.assertEqual(get(8080, "/")[0].status, 200)
        runs = lambda: self.bash("stepwright snapshot --config cell.toml instance0.motor instance0.lamp", self.root / "fan")
        self.assertTrue(eventually(lambda: "instance0.lamp = TRUE" in runs()), "the fan has held itself and run up")
        self.bash(last, self.root / "fan")


if __name__ == "__main__":
    unittest.main()
