"""The workflow files for GitHub and GitLab: they parse, name commands and options that exist, and pin what they use.
(They have not run on these services.)"""

import os
import re
import subprocess
import unittest

import yaml

from support import ROOT

GITHUB = [f".github/workflows/{name}" for name in ("ci.yml", "release.yml", "site.yml")]
GITLAB = [".gitlab-ci.yml", "deploy/gitlab/pages.yml"]
HELP = subprocess.run([os.path.join(ROOT, "test"), "--help"], capture_output=True, text=True, check=True,
                      timeout=60).stdout


def read(name):
    with open(os.path.join(ROOT, name), encoding="utf-8") as file:
        return yaml.safe_load(file)


def lines_of(commands):
    """The lines of a step or a script, which is a text or a list of texts."""
    return "\n".join([commands] if isinstance(commands, str) else commands or []).splitlines()


def jobs_of_gitlab(workflow):
    special = ("include", "stages")
    return {name: job for name, job in workflow.items() if name not in special and not name.startswith(".")}


class Workflows(unittest.TestCase):
    def check_commands(self, lines):
        """Programs of the checkout exist, and ./test has the options."""
        for line in lines:
            for program, rest in re.findall(r"(?<!\S)((?:\./|scripts/|\.ci/)\S+)([^;|&]*)", line):
                self.assertTrue(os.access(os.path.join(ROOT, program), os.X_OK), line)
                if program == "./test":
                    self.assertIn(rest.split()[0], HELP, line)

    def test_github(self):
        for name in GITHUB:
            workflow = read(name)
            self.assertEqual({"contents": "read"}, workflow["permissions"], name)
            for job in workflow["jobs"].values():
                for step in job["steps"]:
                    self.check_commands(lines_of(step.get("run", "")))
                    self.assertRegex(step.get("uses", "a/b@v1"), r"^[a-z-]+/[a-z-]+@v\d+$")
                    self.assertNotIn("secrets.", str(step), "nothing needs a secret")

    def test_jobs_of_github_end(self):
        for name in ("ci.yml", "release.yml"):
            for key, job in read(f".github/workflows/{name}")["jobs"].items():
                self.assertIn(job["timeout-minutes"], range(10, 91), key)

    def test_gitlab(self):
        for name in GITLAB:
            for job in jobs_of_gitlab(read(name)).values():
                self.check_commands(lines_of(job["script"]))

    def test_both_run_the_same_suites(self):
        github = {job for job in read(GITHUB[0])["jobs"] if job != "images"}  # GitLab's runners have no docker
        self.assertLessEqual(github, set(jobs_of_gitlab(read(GITLAB[0]))))
        for debian in ("bookworm", "trixie"):
            self.assertIn(debian, read(GITHUB[0])["jobs"]["test"]["strategy"]["matrix"]["debian"])
            self.assertIn(debian, read(GITLAB[0])["test"]["parallel"]["matrix"][0]["DEBIAN"])

    def test_the_tag_is_the_version(self):
        started_by = read(GITHUB[1])[True]  # YAML 1.1 reads `on` as true
        self.assertEqual(["v[0-9]+.[0-9]+.[0-9]+"], started_by["push"]["tags"])
        self.assertIn('scripts/release "${GITHUB_REF_NAME#v}" --no-image',
                      [step.get("run") for step in read(GITHUB[1])["jobs"]["files"]["steps"]])


if __name__ == "__main__":
    unittest.main()
