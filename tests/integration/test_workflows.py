"""The workflow files for GitHub and GitLab: they parse, name commands and options that exist, and pin what they use. A
release is tested before, and GitLab's has links to its files. (They have not run on these services.)"""

import json
import os
import pathlib
import re
import subprocess
import tempfile
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


# Writes its arguments and what it reads as a line of JSON.
CURL = """#!/usr/bin/python3
import json, os, sys
data = sys.stdin.read() if "@-" in sys.argv else ""
with open(os.environ["CALLS"], "a", encoding="utf-8") as file:
    print(json.dumps([sys.argv[1:], data]), file=file)
"""

# An engine that writes its arguments; an image that it has pulled has a digest.
DOCKER = """#!/bin/sh
echo "$*" >>"$CALLS"
case $1 in image) grep -q ^pull "$CALLS" && echo debian@sha256:12 ;; esac
"""


class Workflows(unittest.TestCase):
    def check_commands(self, lines):
        """Programs of the checkout exist, and ./test has the options."""
        for line in lines:
            for program, rest in re.findall(r"(?<!\S)((?:\./|scripts/|\.ci/)\S+)([^;|&]*)", line):
                self.assertTrue(os.access(os.path.join(ROOT, program), os.X_OK), line)
                if program == "./test" and rest.strip():
                    self.assertIn(rest.split()[0], HELP, line)

    def test_github(self):
        for name in GITHUB:
            workflow = read(name)
            self.assertEqual({"contents": "read"}, workflow["permissions"], name)
            for job in workflow["jobs"].values():
                for step in job.get("steps", []):
                    self.check_commands(lines_of(step.get("run", "")))
                    self.assertRegex(step.get("uses", "a/b@v1"), r"^[a-z-]+/[a-z-]+@v\d+$")
                    self.assertNotIn("secrets.", str(step), "nothing needs a secret")

    def test_jobs_of_github_end(self):
        for name in ("ci.yml", "release.yml"):
            for key, job in read(f".github/workflows/{name}")["jobs"].items():
                if "uses" not in job:
                    self.assertIn(job["timeout-minutes"], range(10, 91), key)

    def test_gitlab(self):
        for name in GITLAB:
            for job in jobs_of_gitlab(read(name)).values():
                self.check_commands(lines_of(job["script"]))

    def test_both_run_the_same_suites(self):
        self.assertLessEqual(set(read(GITHUB[0])["jobs"]), set(jobs_of_gitlab(read(GITLAB[0]))))
        for debian in ("bookworm", "trixie"):
            self.assertIn(debian, read(GITHUB[0])["jobs"]["test"]["strategy"]["matrix"]["debian"])
            self.assertIn(debian, read(GITLAB[0])["test"]["parallel"]["matrix"][0]["DEBIAN"])

    def test_the_tag_is_the_version(self):
        started_by = read(GITHUB[1])[True]  # YAML 1.1 reads `on` as true
        self.assertEqual(["v[0-9]+.[0-9]+.[0-9]+"], started_by["push"]["tags"])
        self.assertIn('scripts/release "${GITHUB_REF_NAME#v}" --no-image',
                      [step.get("run") for step in read(GITHUB[1])["jobs"]["files"]["steps"]])

    def scripts(self):
        """(place, script) of every job of both services."""
        for name in GITHUB:
            for key, job in read(name)["jobs"].items():
                for step in job.get("steps", []):
                    yield f"{name}: {key}", re.sub(r"\$\{\{.*?\}\}", "value", step.get("run", ""))
        for name in GITLAB:
            for key, job in jobs_of_gitlab(read(name)).items():
                yield f"{name}: {key}", "\n".join(job["script"])

    def test_scripts_have_no_syntax_error(self):
        for place, script in self.scripts():
            done = subprocess.run(["bash", "-n"], input=script, capture_output=True, text=True, check=False, timeout=60)
            self.assertEqual((0, ""), (done.returncode, done.stderr), f"{place}: {script}")

    def test_a_release_is_tested_before(self):
        jobs = read(GITHUB[1])["jobs"]
        self.assertEqual({"uses": "./" + GITHUB[0]}, jobs["test"])
        self.assertIn("workflow_call", read(GITHUB[0])[True])
        self.assertEqual(("test", "files"), (jobs["files"]["needs"], jobs["publish"]["needs"]))
        gitlab = read(GITLAB[0])
        self.assertLess(gitlab["stages"].index("test"), gitlab["stages"].index(gitlab["release"]["stage"]))
        for job in "packages", "images":
            self.assertIn({"if": "$CI_COMMIT_TAG"}, gitlab[job]["rules"])

    def test_jobs_that_make_root_file_systems_may(self):
        for name in GITHUB:
            for key, job in read(name)["jobs"].items():
                commands = "".join(step.get("run", "") for step in job.get("steps", []))
                if "scripts/release" in commands or "--packages" in commands:
                    self.assertIn("--privileged", job["container"]["options"], key)
        for key, job in jobs_of_gitlab(read(GITLAB[0])).items():
            commands = "".join(job["script"])
            if "scripts/release" in commands or "--packages" in commands:
                self.assertEqual(["privileged"], job["tags"], key)

    def test_the_image_of_a_release_pins_the_newest_base(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "docker").write_text(DOCKER, encoding="utf-8")
        (folder / "docker").chmod(0o755)
        subprocess.run([os.path.join(ROOT, "scripts/image"), "1.2.3", folder], check=True, capture_output=True,
                       timeout=60, env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "CALLS": str(folder / "calls")})
        calls = (folder / "calls").read_text(encoding="utf-8").splitlines()
        self.assertEqual(["version", "pull", "image", "build", "save"], [call.split()[0] for call in calls])
        self.assertIn("--build-arg BASE=debian@sha256:12", calls[3])
        self.assertTrue((folder / "xr3-1.2.3-image.tar.gz").exists())

    def test_a_release_on_gitlab_links_its_files(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        calls = folder / "calls"
        log = '## [Unreleased]\n\n## [1.2.3] - 2026-01-02\n\n- A "new" thing\n\n## [1.2.2] - 2025-01-02\n'
        for name in ".ci", "scripts":
            (folder / name).symlink_to(os.path.join(ROOT, name))
        for name, text in {"CHANGELOG.md": log, "bin/curl": CURL, "build/release-1.2.3/SHA256SUMS": "",
                           "build/release-1.2.3/xr3_1.2.3_amd64.deb": ""}.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text, encoding="utf-8")
        (folder / "bin/curl").chmod(0o755)
        script = [line for line in read(GITLAB[0])["release"]["script"] if not line.startswith("scripts/release")]
        environment = {**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}", "CALLS": str(calls),
                       "CI_PROJECT_ID": "7", "CI_COMMIT_TAG": "v1.2.3", "CI_JOB_TOKEN": "secret",
                       "CI_API_V4_URL": "https://host/api"}
        subprocess.run(["bash", "-euo", "pipefail", "-c", "\n".join(script)], cwd=folder, env=environment, check=True,
                       timeout=60)
        *uploads, (release, data) = map(json.loads, calls.read_text(encoding="utf-8").splitlines())
        packages = "https://host/api/projects/7/packages/generic/xr3/1.2.3/"
        urls = [packages + name for name in ("SHA256SUMS", "xr3_1.2.3_amd64.deb")]
        self.assertEqual(urls, [arguments[-1] for arguments, _ in uploads])
        for arguments, _ in uploads:
            self.assertTrue(arguments[arguments.index("--upload-file") + 1].endswith(arguments[-1].rpartition("/")[2]))
        self.assertEqual("https://host/api/projects/7/releases", release[-1])
        data = json.loads(data)
        self.assertEqual(("v1.2.3", '- A "new" thing'), (data["tag_name"], data["description"].strip()))
        self.assertEqual(urls, [link["url"] for link in data["assets"]["links"]])


if __name__ == "__main__":
    unittest.main()
