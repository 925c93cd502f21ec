"""doc/getting-started.md: its commands, all of them and in order, in a clean folder; then the page is there."""

import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from namespaces import need_network_of_its_own
from processes import BIN, PATIENCE_S, SOURCES, eventually, get

GUIDE = SOURCES / "doc/getting-started.md"
MOST_LINES = 100  # two pages


def blocks(text):
    return re.findall(r"^```sh\n(.*?)^```$", text, re.M | re.S)


class GettingStarted(unittest.TestCase):
    def setUp(self):
        need_network_of_its_own()  # the page of the guide has the port that everybody's has
        temporary = tempfile.TemporaryDirectory(prefix="stepwright-test-")
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name)

    def bash(self, script, folder):
        done = subprocess.run(["bash", "-e", "-c", script], cwd=folder, capture_output=True, text=True, timeout=PATIENCE_S,
                              check=False, env={**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}"})
        self.assertEqual(done.returncode, 0, f"{script}\n{done.stdout}{done.stderr}")
        return done.stdout

    def test_every_command_works_in_its_order(self):
        text = GUIDE.read_text(encoding="utf-8")
        self.assertLessEqual(len(text.splitlines()), MOST_LINES)
        *before, last = blocks(text)
        self.assertGreater(len(before), 3)
        self.addCleanup(subprocess.run, [BIN / "stepwright", "down", self.root / "line/cell.toml"], capture_output=True, check=False)
        self.bash("".join(before), self.root)
        folder = self.root / "line"
        status = json.loads(self.bash("stepwright status --json", folder))
        self.assertEqual(status["address"], "http://127.0.0.1:8080/")
        self.assertEqual(get(8080, "/")[0].status, 200)
        listed = lambda: json.loads(get(8080, "/api/alarms?all=1")[1])
        self.assertTrue(eventually(lambda: listed()["figures"]["no_value"] == 0))
        self.assertIn("many starts", {each["name"] for each in listed()["alarms"]})
        answer, tags = get(8080, "/api/recipe-tags")
        self.assertEqual(answer.status, 200)
        self.assertTrue(all("value" in each for each in json.loads(tags)["tags"]), tags)
        self.bash(last, folder)

    def test_the_message_that_it_quotes_is_the_one_that_check_has(self):
        quoted = re.search(r"`alarms\.toml:(\d+:\d+: C0532: .*?)\?`\)", GUIDE.read_text(encoding="utf-8"), re.S).group(1)
        self.bash("stepwright new line", self.root)
        folder = self.root / "line"
        wrong = re.search(r"cat >> alarms\.toml <<'END'\n.*?^END$", GUIDE.read_text(encoding="utf-8"), re.M | re.S).group(0)
        self.bash(wrong.replace("Main.starts", "Main.start"), folder)
        said = self.bash("stepwright check 2>&1 || true", folder)
        flat = lambda text: " ".join(text.replace("\n  hint:", ";").split())
        self.assertIn(flat(quoted), flat(said))


if __name__ == "__main__":
    unittest.main()
