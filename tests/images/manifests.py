"""The manifests of deploy/kubernetes as `kubectl kustomize` prints them, with tokens of the tests, and the rules
that the schemas of Kubernetes do not contain: each function yields a sentence for each fault."""

import base64
import contextlib
import pathlib
import re
import shutil
import subprocess
import tempfile

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "deploy" / "kubernetes"
DEPARTMENTS = ("mechanics", "electronics", "informatics")
TOKEN = "a token of the tests"
DEADLINE_S = 60
WORKLOADS = ("Deployment", "StatefulSet")
VOLUMES = {"configMap", "secret", "persistentVolumeClaim", "emptyDir", "projected", "downwardAPI"}
NAME = re.compile(r"[a-z]([-a-z0-9]{0,61}[a-z0-9])?")


@contextlib.contextmanager
def sources(tokens=True):
    """A copy of deploy/kubernetes, with tokens if wanted: "a token of the tests", and one for each department."""
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder, "kubernetes")
        shutil.copytree(FOLDER, copy, ignore=shutil.ignore_patterns("token", "tokens"))
        if tokens:
            (copy / "class" / "token").write_text(TOKEN + "\n", encoding="utf-8")
            (copy / "departments" / "tokens").mkdir()
            for name in DEPARTMENTS:
                (copy / "departments" / "tokens" / name).write_text(f"{TOKEN}: {name}\n", encoding="utf-8")
        yield copy


def kustomize(folder):
    """The result of `kubectl kustomize FOLDER`."""
    return subprocess.run(["kubectl", "kustomize", str(folder)], capture_output=True, text=True, check=False,
                          stdin=subprocess.DEVNULL, timeout=DEADLINE_S)


def objects_of(name):
    """The objects of deploy/kubernetes/NAME."""
    with sources() as copy:
        done = kustomize(copy / name)
    assert done.returncode == 0, done.stderr
    return list(yaml.safe_load_all(done.stdout))


def of_kind(objects, *kinds):
    return [thing for thing in objects if thing["kind"] in kinds]


def pod_of(workload):
    return workload["spec"]["template"]["spec"]


def claims_of(workload):
    """The names of the volumes that Kubernetes claims for each pod of a StatefulSet."""
    return [claim["metadata"]["name"] for claim in workload["spec"].get("volumeClaimTemplates", [])]


def with_claims(workload, name):
    """The pod of this name, with the volumes that Kubernetes adds for the claims."""
    pod = pod_of(workload)
    added = [{"name": claim, "persistentVolumeClaim": {"claimName": f"{claim}-{name}"}}
             for claim in claims_of(workload)]
    return {**pod, "volumes": pod.get("volumes", []) + added}


def pods(objects):
    """(name, labels, specification) of every pod that the workloads create, with the labels and the volumes that
    Kubernetes adds."""
    for workload in of_kind(objects, *WORKLOADS):
        labels = workload["spec"]["template"]["metadata"]["labels"]
        for i in range(workload["spec"]["replicas"]):
            name = f"{workload['metadata']['name']}-{i}"
            added = {"statefulset.kubernetes.io/pod-name": name} if workload["kind"] == "StatefulSet" else {}
            yield name, {**labels, **added}, with_claims(workload, name)


def selects(selector, labels):
    return selector.items() <= labels.items()


# --- The rules.

def pod_faults(objects):
    """The profile `restricted` of the Pod Security Standards, and no access to the cluster."""
    for name, _, pod in pods(objects):
        security = pod.get("securityContext", {})
        rules = {
            "does not require a user other than root": security.get("runAsNonRoot") is True,
            "has no user": security.get("runAsUser", 0) > 0,
            "has another seccomp profile": security.get("seccompProfile") == {"type": "RuntimeDefault"},
            "mounts a token of the cluster": pod.get("automountServiceAccountToken") is False,
            "gets variables XR3_… from Services": pod.get("enableServiceLinks") is False,
            "shares a namespace of the node":
                not any(pod.get(member) for member in ("hostNetwork", "hostPID", "hostIPC")),
            "has less than 3 s to stop": pod.get("terminationGracePeriodSeconds", 0) > 2,
            "has a volume that is not allowed":
                all(set(volume) - {"name"} <= VOLUMES for volume in pod.get("volumes", [])),
        }
        yield from (f"{name} {fault}" for fault, holds in rules.items() if not holds)


def container_faults(objects):
    for name, _, pod in pods(objects):
        for container in pod["containers"]:
            security, resources = container.get("securityContext", {}), container.get("resources", {})
            rules = {
                "may gain privileges": security.get("allowPrivilegeEscalation") is False,
                "is privileged": not security.get("privileged", False),
                "can write its root": security.get("readOnlyRootFilesystem") is True,
                "keeps capabilities": security.get("capabilities") == {"drop": ["ALL"]},
                "binds a port of the node": not any("hostPort" in port for port in container["ports"]),
                "has an image without a tag": re.fullmatch(r"\S+:(?!latest$)[\w.-]+", container["image"]),
                **{f"has no {what} of {which}": which in resources.get(what, {})
                   for what in ("limits", "requests") for which in ("cpu", "memory")},
                **{f"has no {probe}": probe in container
                   for probe in ("startupProbe", "readinessProbe", "livenessProbe")},
                "has a liveness probe that fails while all lines are in use":
                    container.get("livenessProbe", {}).get("httpGet", {}).get("path") == "/healthz",
            }
            yield from (f"{name}: the container {container['name']} {fault}"
                        for fault, holds in rules.items() if not holds)


def selector_faults(objects):
    """Every selector selects pods, and every pod is covered by a budget and a policy of both directions."""
    created = list(pods(objects))
    for workload in of_kind(objects, *WORKLOADS):
        if not selects(workload["spec"]["selector"]["matchLabels"], workload["spec"]["template"]["metadata"]["labels"]):
            yield f"{workload['metadata']['name']} does not select its pods"
    for service in of_kind(objects, "Service"):
        if not any(selects(service["spec"]["selector"], labels) for _, labels, _ in created):
            yield f"the Service {service['metadata']['name']} selects no pod"
    for kind, member in ("PodDisruptionBudget", "selector"), ("NetworkPolicy", "podSelector"):
        for name, labels, _ in created:
            if not any(selects(thing["spec"][member]["matchLabels"], labels) for thing in of_kind(objects, kind)):
                yield f"{name} has no {kind}"
    for name, labels, pod in created:
        if not all(selects(spread["labelSelector"]["matchLabels"], labels)
                   for spread in pod.get("topologySpreadConstraints", [])):
            yield f"{name} is spread by the labels of others"
    for policy in of_kind(objects, "NetworkPolicy"):
        if set(policy["spec"]["policyTypes"]) != {"Ingress", "Egress"} or "egress" in policy["spec"]:
            yield "a NetworkPolicy allows connections of the server to others"


def port_faults(objects):
    """A port that a Service, a probe or a NetworkPolicy names is one of the container, and vice versa."""
    for _, labels, pod in pods(objects):
        names = {port["name"] for container in pod["containers"] for port in container["ports"]}
        reached = set()
        for service in of_kind(objects, "Service"):
            if selects(service["spec"]["selector"], labels):
                reached |= {port["targetPort"] for port in service["spec"]["ports"]}
        allowed = {port["port"] for policy in of_kind(objects, "NetworkPolicy")
                   for rule in policy["spec"]["ingress"] for port in rule["ports"]}
        probed = {probe["httpGet"]["port"] for container in pod["containers"] for probe in container.values()
                  if isinstance(probe, dict) and "httpGet" in probe}
        for what, ports in ("Services", reached), ("NetworkPolicies", allowed):
            if ports != names:
                yield f"the ports of the {what} are {sorted(ports)}, those of the pod {sorted(names)}"
        if not probed <= names:
            yield f"a probe names one of the ports {sorted(probed)}, the pod has {sorted(names)}"


def claims(objects):
    """The names of all claims, with those that Kubernetes makes for a StatefulSet."""
    made = {f"{claim}-{workload['metadata']['name']}-{i}" for workload in of_kind(objects, "StatefulSet")
            for claim in claims_of(workload) for i in range(workload["spec"]["replicas"])}
    return made | {claim["metadata"]["name"] for claim in of_kind(objects, "PersistentVolumeClaim")}


def source_of(volume):
    """The name of the ConfigMap, Secret or claim of a volume."""
    return volume.get("configMap", {}).get("name") or volume.get("secret", {}).get("secretName") or \
        volume.get("persistentVolumeClaim", {}).get("claimName")


def mounted(mount, name, files):
    """The folder of a mount in the pod of this name, and the files there."""
    if "subPathExpr" not in mount:
        return mount["mountPath"], files
    path = pathlib.PurePosixPath(mount["mountPath"])
    return str(path.parent), {path.name} if mount["subPathExpr"].replace("$(POD_NAME)", name) in files else set()


def reference_faults(objects):
    """Volumes are mounted, and ConfigMaps, Secrets, claims and files that options name exist."""
    maps = {thing["metadata"]["name"]: set(thing["data"]) for thing in of_kind(objects, "ConfigMap", "Secret")}
    for name, _, pod in pods(objects):
        files, volumes = {}, {volume["name"]: volume for volume in pod["volumes"]}
        for container in pod["containers"]:
            mounts = {mount["name"]: mount for mount in container["volumeMounts"]}
            if set(volumes) != set(mounts):
                yield f"{name} mounts {sorted(mounts)} and has the volumes {sorted(volumes)}"
            for volume in volumes.keys() & mounts.keys():
                source = source_of(volumes[volume])
                if source not in maps.keys() | claims(objects):
                    yield f"{name} mounts {source}, which does not exist"
                if "persistentVolumeClaim" not in volumes[volume]:
                    folder, found = mounted(mounts[volume], name, maps.get(source, set()))
                    files[folder] = found
            for option in container["args"]:
                path = pathlib.PurePosixPath(option.partition("=")[2].replace("$(POD_NAME)", name))
                if str(path.parent) in files and path.name not in files[str(path.parent)]:
                    yield f"{name}: {option}: {path} does not exist"


def token_faults(objects):
    """A container can read its own token, and no other one."""
    for name, _, pod in pods(objects):
        secrets = {volume["name"]: volume["secret"] for volume in pod["volumes"] if "secret" in volume}
        for mount in (mount for container in pod["containers"] for mount in container["volumeMounts"]):
            if mount["name"] in secrets:
                secret, = (thing for thing in of_kind(objects, "Secret")
                           if thing["metadata"]["name"] == secrets[mount["name"]]["secretName"])
                if len(secret.get("data", {})) > 1 and mount.get("subPathExpr") != "$(POD_NAME)":
                    yield f"{name} can read the tokens of others"


def recording_faults(objects):
    """The recordings are in a folder of a volume that stays, which the user of the server may write."""
    for name, _, pod in pods(objects):
        kept = {volume["name"] for volume in pod["volumes"] if "persistentVolumeClaim" in volume}
        rewritten = pod.get("securityContext", {}).get("fsGroupChangePolicy") != "OnRootMismatch"
        for container in pod["containers"]:
            folders = {pathlib.PurePosixPath(mount["mountPath"]) for mount in container["volumeMounts"]
                       if mount["name"] in kept and not mount.get("readOnly")}
            recorded = [pathlib.PurePosixPath(option.partition("=")[2]) for option in container["args"]
                        if option.startswith("--record=")]
            if len(recorded) != 1 or recorded[0].parent not in folders:
                yield f"{name} records nothing that stays"
        if pod.get("securityContext", {}).get("fsGroup") != pod.get("securityContext", {}).get("runAsGroup"):
            yield f"{name} cannot write its volumes"
        if rewritten:
            yield f"{name}: each start makes all recordings readable for the group"


def name_faults(objects):
    """Names are labels of DNS; no Secret is in the sources."""
    for thing in objects:
        if not NAME.fullmatch(thing["metadata"]["name"]):
            yield f"{thing['metadata']['name']} is not a name of DNS"
    for secret in of_kind(objects, "Secret"):
        for value in secret["data"].values():
            if not base64.b64decode(value).decode().startswith(TOKEN):
                yield f"the Secret {secret['metadata']['name']} is in the sources"


def state_faults(objects):
    """The state is in memory: no two pods at the same time, no eviction and no update during a lesson."""
    for workload in of_kind(objects, "Deployment"):
        if (workload["spec"]["replicas"], workload["spec"].get("strategy")) != (1, {"type": "Recreate"}):
            yield "an update has two pods at the same time"
    for workload in of_kind(objects, "StatefulSet"):
        if workload["spec"].get("updateStrategy") != {"type": "OnDelete"}:
            yield "an update stops every department"
        headless = {service["metadata"]["name"] for service in of_kind(objects, "Service")
                    if service["spec"].get("clusterIP") == "None"}
        if workload["spec"]["serviceName"] not in headless:
            yield "the StatefulSet has no headless Service"
    for budget in of_kind(objects, "PodDisruptionBudget"):
        if budget["spec"].get("maxUnavailable") != 0:
            yield "a pod may be evicted"


RULES = (pod_faults, container_faults, selector_faults, port_faults, reference_faults, token_faults,
         recording_faults, name_faults, state_faults)


def faults(objects):
    return [fault for rule in RULES for fault in rule(objects)]
