"""Tests of the manifests in deploy/kubernetes: `kubectl kustomize` accepts them, they agree with the schemas of
Kubernetes (tests/images/kubernetes, if npm can fetch them), and with the rules of manifests.py."""

import base64
import copy
import json
import pathlib
import re
import subprocess
import unittest

import yaml

from engine import quiet
from manifests import FOLDER, ROOT, TOKEN, claims, faults, kustomize, objects_of, of_kind, pod_of, sources

CHECK = ROOT / "tests" / "images" / "kubernetes"
NAMES = ("class", "departments")
DEADLINE_S = 300


def schema_faults(objects):
    return subprocess.run(["node", "check.mjs"], cwd=CHECK, input=json.dumps(objects), text=True, timeout=DEADLINE_S,
                          capture_output=True, check=True).stdout.splitlines()


class Sources(unittest.TestCase):
    def test_there_is_no_other_folder(self):
        found = {path.parent.name for path in FOLDER.glob("*/kustomization.yaml")}
        self.assertEqual(set(NAMES), found)

    def test_every_file_is_used(self):
        for name in NAMES:
            listed = (FOLDER / name / "kustomization.yaml").read_text(encoding="utf-8")
            for path in (FOLDER / name).glob("*.*"):
                with self.subTest(path):
                    self.assertTrue(path.name == "kustomization.yaml" or path.name in listed)

    def test_without_a_token_nothing_is_applied(self):
        with sources(tokens=False) as folder:
            for name in NAMES:
                with self.subTest(name):
                    done = kustomize(folder / name)
                    self.assertNotEqual(0, done.returncode)
                    self.assertIn("token", done.stderr)

    def test_git_and_docker_ignore_tokens(self):
        for path in "class/token", "departments/tokens/mechanics":
            self.assertTrue(quiet("git", "check-ignore", str(FOLDER / path), cwd=ROOT) or not (ROOT / ".git").exists())
        ignored = pathlib.Path(ROOT, ".dockerignore").read_text(encoding="utf-8").splitlines()
        self.assertIn("deploy/kubernetes/*/token*", ignored)

    def test_kustomize_warns_of_nothing(self):
        with sources() as folder:
            for name in NAMES:
                self.assertEqual("", kustomize(folder / name).stderr)


class Rules(unittest.TestCase):
    def test_hold(self):
        for name in NAMES:
            with self.subTest(name):
                self.assertEqual([], faults(objects_of(name)))

    def test_find_what_is_missing(self):
        """Every member of pods, containers, Services and policies that a rule is about, one after the other."""
        for name in NAMES:
            objects = objects_of(name)
            for place, path in breakable(objects):
                with self.subTest(f"{name}: {place}"):
                    broken = copy.deepcopy(objects)
                    spoil(broken, path)
                    self.assertTrue(faults(broken), "no rule notices this")


POD = ("spec", "template", "spec")
CONTAINER = (*POD, "containers", 0)
MEMBERS = {
    ("Deployment", "StatefulSet"): (
        *((*POD, "securityContext", member) for member in ("runAsNonRoot", "runAsUser", "seccompProfile", "fsGroup",
                                                           "fsGroupChangePolicy")),
        *((*POD, member) for member in ("automountServiceAccountToken", "enableServiceLinks",
                                        "terminationGracePeriodSeconds")),
        *((*CONTAINER, member) for member in ("startupProbe", "readinessProbe", "livenessProbe", "resources")),
        *((*CONTAINER, "resources", member) for member in ("limits", "requests")),
        *((*CONTAINER, "securityContext", member)
          for member in ("allowPrivilegeEscalation", "readOnlyRootFilesystem", "capabilities")),
        (*CONTAINER, "ports", 0), *((*CONTAINER, "volumeMounts", i) for i in range(3)), (*CONTAINER, "args", 3), (*CONTAINER, "image"), (*POD, "volumes", 0),
        ("spec", "template", "metadata", "labels", "app.kubernetes.io/component")),
    ("Deployment",): (("spec", "strategy"),),
    ("StatefulSet",): (("spec", "updateStrategy"), ("spec", "serviceName"), ("spec", "volumeClaimTemplates", 0),
                       (*CONTAINER, "volumeMounts", 1, "subPathExpr")),
    ("PersistentVolumeClaim",): (("metadata", "name"),),
    ("Service",): (("spec", "selector", "app.kubernetes.io/name"),),
    ("PodDisruptionBudget",): (("spec", "maxUnavailable"),
                               ("spec", "selector", "matchLabels", "app.kubernetes.io/component")),
    ("NetworkPolicy",): (("spec", "podSelector", "matchLabels", "app.kubernetes.io/component"),
                         ("spec", "policyTypes", 1), ("spec", "ingress", 0, "ports", 0)),
    ("ConfigMap", "Secret"): (("data",),),
}


def breakable(objects):
    for i, thing in enumerate(objects):
        for kinds, paths in MEMBERS.items():
            if thing["kind"] in kinds:
                yield from ((f"{thing['kind']} {thing['metadata']['name']} {path}", (i, *path)) for path in paths)


def spoil(objects, path):
    """Removes the member at this path, or gives another value to a label and to a text."""
    parent = objects
    for step in path[:-1]:
        parent = parent[step]
    if isinstance(parent[path[-1]], str):
        parent[path[-1]] = "other"
    elif path[-1] == "data":
        parent["data"] = {}
    else:
        del parent[path[-1]]


class PodOfRecordings(unittest.TestCase):
    """recordings-pod.yaml mounts the volume of the class with the rights of the class."""

    def test_has_the_volume_and_the_rights_of_the_class(self):
        pod = yaml.safe_load((FOLDER / "recordings-pod.yaml").read_text(encoding="utf-8"))["spec"]
        objects = objects_of("class")
        server = pod_of(of_kind(objects, "Deployment")[0])
        self.assertEqual(server["securityContext"], pod["securityContext"])
        self.assertEqual(container(objects)["securityContext"], pod["containers"][0]["securityContext"])
        self.assertEqual([False, False], [pod["automountServiceAccountToken"], pod["enableServiceLinks"]])
        mount, = pod["containers"][0]["volumeMounts"]
        self.assertIn(mount, container(objects)["volumeMounts"])
        volume, = pod["volumes"]
        self.assertIn(volume, server["volumes"])
        self.assertIn(volume["persistentVolumeClaim"]["claimName"], claims(objects))


class Schemas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        installed, locked = CHECK / "node_modules" / ".package-lock.json", CHECK / "package-lock.json"
        if installed.exists() and installed.stat().st_mtime >= locked.stat().st_mtime:
            return
        if not quiet("npm", "ci", "--ignore-scripts", "--no-fund", "--no-audit", cwd=CHECK, timeout=DEADLINE_S):
            raise unittest.SkipTest("npm cannot fetch the schemas of Kubernetes")
        installed.touch()

    def test_every_object_is_valid(self):
        for name in NAMES:
            with self.subTest(name):
                self.assertEqual([], schema_faults(objects_of(name)))
        self.assertEqual([], schema_faults([yaml.safe_load((FOLDER / "recordings-pod.yaml").read_text("utf-8"))]))

    def test_faults_are_found(self):
        """An unknown member, a value that is not allowed, a wrong type, and a kind that does not exist."""
        objects = objects_of("class")
        for fault, change in {
                "readynessProbe": lambda it: container(it).update(readynessProbe=container(it).pop("readinessProbe")),
                "strategy/type": lambda it: of_kind(it, "Deployment")[0]["spec"].update(strategy={"type": "recreate"}),
                "containerPort": lambda it: container(it)["ports"][0].update(containerPort="9600"),
                "no such kind": lambda it: of_kind(it, "NetworkPolicy")[0].update(apiVersion="networking.k8s.io/v2"),
                "quantity": lambda it: container(it)["resources"]["limits"].update(memory="1Gy"),
        }.items():
            with self.subTest(fault):
                broken = copy.deepcopy(objects)
                change(broken)
                self.assertIn(fault, "\n".join(schema_faults(broken)))


class Readme(unittest.TestCase):
    text = (FOLDER / "README.md").read_text(encoding="utf-8")

    def test_example_of_a_second_class(self):
        """The class of the example keeps to the rules, has its own token, and admits one more network."""
        example, = re.findall(r"^```yaml\n(.*?)^```", self.text, re.DOTALL | re.MULTILINE)
        with sources() as folder:
            (folder / "class-b").mkdir()
            (folder / "class-b" / "kustomization.yaml").write_text(example, encoding="utf-8")
            (folder / "class-b" / "token").write_text(f"{TOKEN}: b", encoding="utf-8")
            done = kustomize(folder / "class-b")
        if "cannot unmarshal object into Go struct field" in done.stderr:
            self.skipTest("kubectl is older than 1.21")
        self.assertEqual((0, ""), (done.returncode, done.stderr))
        objects = list(yaml.safe_load_all(done.stdout))
        self.assertEqual([], faults(objects))
        self.assertEqual({"class-b"}, {thing["metadata"]["namespace"] for thing in objects})
        secret, = of_kind(objects, "Secret")
        self.assertEqual(f"{TOKEN}: b", base64.b64decode(secret["data"]["token"]).decode())
        policy, = of_kind(objects, "NetworkPolicy")
        self.assertEqual([{"podSelector": {}}, {"ipBlock": {"cidr": "192.0.2.0/24"}}],
                         policy["spec"]["ingress"][0]["from"])
        for service in of_kind(objects, "Service"):
            self.assertEqual(("LoadBalancer", "Local"),
                             (service["spec"]["type"], service["spec"]["externalTrafficPolicy"]))

    def test_commands(self):
        """Every line of the fences: kubectl knows the command and its options, and the objects exist."""
        fences = re.findall(r"^```sh\n(.*?)^```", self.text, re.DOTALL | re.MULTILINE)
        commands = [re.sub(r"^(\w+=\S+ )+", "", line).split() for fence in fences for line in fence.splitlines()]
        self.assertGreater(len(commands), 7)
        objects = {f"{thing['kind'].lower()}/{thing['metadata']['name']}" for thing in objects_of("class")}
        for words in commands:
            with self.subTest(" ".join(words)):
                self.assertIn(words[0], ("kubectl", "docker", "head", "cmake", "./run", "build/release/bench_cells"))
                for path in (word for word in words if word.startswith(("deploy/", "docker/", "tests/", "./"))):
                    self.assertTrue((ROOT / path).exists() or path == "deploy/kubernetes/class/token", path)
                for name in (word for word in words if word.startswith(("deployment/", "service/"))):
                    self.assertIn(name, objects)
                if words[0] == "kubectl":
                    self.check_options(words)

    def check_options(self, words):
        verbs = [word for word in words[1:3] if word.isalpha() or word == "port-forward"]
        shown = subprocess.run(["kubectl", *verbs, "--help"], capture_output=True, text=True, check=True,
                               timeout=DEADLINE_S).stdout + "--namespace -n"
        words = words[:words.index("--")] if "--" in words else words  # the rest is for the container
        for option in (word for word in words if word.startswith("-")):
            self.assertRegex(shown, rf"(?m)(^| ){option}\b")


def container(objects):
    return pod_of(of_kind(objects, "Deployment")[0])["containers"][0]


if __name__ == "__main__":
    unittest.main()
