"""doc/getting-started.md: its commands, all of them and in order, in a clean folder; then the page is there."""

import json
import re
import unittest

from guide_pages import MOST_LINES, Guide, blocks, page
from processes import eventually, get


class GettingStarted(Guide):
    def test_every_command_works_in_its_order(self):
        text = page("getting-started.md")
        self.assertLessEqual(len(text.splitlines()), MOST_LINES)
        *before, last = blocks(text)
        self.assertGreater(len(before), 3)
        self.ends_with_the_test("line/cell.toml")
        self.bash("".join(before), self.root)
        folder = self.root / "line"
        status = json.loads(self.bash("stepwright status --json", folder))
        self.assertEqual(status["address"], "http://127.0.0.1:8080/")
        self.assertEqual(get(8080, "/")[0].status, 200)
        listed = lambda: json.loads(get(8080, "/api/alarms?all=1")[1])
        self.assertTrue(eventually(lambda: sum(listed()["figures"][key] for key in ("no_value", "no_variable")) == 0))
        self.assertIn("many starts", {each["name"] for each in listed()["alarms"]})
        answer, tags = get(8080, "/api/recipe-tags")
        self.assertEqual(answer.status, 200)
        self.assertTrue(all("value" in each for each in json.loads(tags)["tags"]), tags)
        self.bash(last, folder)

    def test_the_message_that_it_quotes_is_the_one_that_check_has(self):
        text = page("getting-started.md")
        quoted = re.search(r"`alarms\.toml:(\d+:\d+: C0532: .*?)\?`\)", text, re.S).group(1)
        self.bash("stepwright new line", self.root)
        folder = self.root / "line"
        wrong = re.search(r"cat >> alarms\.toml <<'END'\n.*?^END$", text, re.M | re.S).group(0)
        self.bash(wrong.replace("Main.starts", "Main.start"), folder)
        said = self.bash("stepwright check 2>&1 || true", folder)
        flat = lambda text: " ".join(text.replace("\n  hint:", ";").split())
        self.assertIn(flat(quoted), flat(said))


if __name__ == "__main__":
    unittest.main()
