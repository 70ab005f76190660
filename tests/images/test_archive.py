"""The image of a release: scripts/image saves it, and the commands of README.md load and run it."""

import pathlib
import subprocess
import tempfile
import unittest
import uuid

from containers import ROOT, docker, output_of
from engine import quiet

BUILD_DEADLINE_S = 3600


class Archive(unittest.TestCase):
    def test_loads_and_runs(self):
        version = f"test-{uuid.uuid4().hex[:8]}"
        self.addCleanup(quiet, "docker", "rmi", f"xr3:{version}")
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([ROOT / "scripts" / "image", version, folder], check=True, capture_output=True,
                           timeout=BUILD_DEADLINE_S)
            docker("rmi", f"xr3:{version}")
            archive = pathlib.Path(folder, f"xr3-{version}-image.tar")
            subprocess.run(["gunzip", f"{archive}.gz"], check=True)
            docker("load", "-i", archive)
        self.assertRegex(output_of("run", "--rm", f"xr3:{version}", "--version"), r"^xr3 \S+ \(commit [0-9a-f]{12}")


if __name__ == "__main__":
    unittest.main()
