"""Plays manifests with `podman kube play`, which knows Pods, Deployments and ConfigMaps. What podman 4.3 does
not know is replaced by the nearest thing that it knows: a StatefulSet by the pods and claims that it would create, a
Secret by a ConfigMap, one file of a Secret by a ConfigMap of this file, $(POD_NAME) by its value, the group of a volume
by its owner; Services, budgets and policies are left out. The tests run the probes, as
the kubelet would, because podman runs them with a shell, which the image does not have."""

import base64
import copy
import pathlib
import tempfile
import time
import urllib.request

import yaml

from containers import USER, docker, inspect
from manifests import claims, of_kind, pod_of, with_claims
from test_compose import free_ports
from test_image import instant
from xr3 import Monitor

PROBE_S = 0.1
OWNER = {f"volume.podman.io/{who}": USER for who in ("uid", "gid")}


def playable(objects, image):
    """The objects for podman: ConfigMaps and claims first, then pods; and the ports of this machine for each pod, by its
    name and the name of the port."""
    maps = [without_secret(thing) for thing in of_kind(copy.deepcopy(objects), "ConfigMap", "Secret")]
    maps += [{"apiVersion": "v1", "kind": "PersistentVolumeClaim", "metadata": {"name": name, "annotations": OWNER},
              "spec": {"accessModes": ["ReadWriteOnce"], "resources": {"requests": {"storage": "1Gi"}}}}
             for name in sorted(claims(objects))]
    runnable, ports = [], {}
    for workload in of_kind(copy.deepcopy(objects), "Deployment", "StatefulSet"):
        pods = [workload] if workload["kind"] == "Deployment" else list(stateful_pods(workload))
        for pod in pods:
            name = f"{pod['metadata']['name']}-pod-0" if pod is workload else pod["metadata"]["name"]
            spec = pod["spec"] if pod["kind"] == "Pod" else pod_of(pod)
            ports[name] = adapt(spec, image)
            maps += maps_of_files(spec, name, maps)
        runnable += pods
    return maps + runnable, ports


def without_secret(thing):
    if thing["kind"] == "Secret":
        thing["data"] = {name: base64.b64decode(value).decode() for name, value in thing["data"].items()}
        del thing["type"]
    return {**thing, "kind": "ConfigMap"}


def adapt(pod, image):
    """Changes a pod for podman; returns the ports of this machine, by the name of the port."""
    for volume in pod["volumes"]:
        secret = volume.pop("secret", None)
        if secret:
            volume["configMap"] = {"name": secret["secretName"]}
    for container in pod["containers"]:
        container["image"] = image
        for probe in "startupProbe", "readinessProbe", "livenessProbe":
            del container[probe]
        chosen = free_ports(len(container["ports"]))
        for port, host in zip(container["ports"], chosen):
            port.update(hostPort=host, hostIP="127.0.0.1")
    return {port["name"]: port["hostPort"] for port in pod["containers"][0]["ports"]}


def maps_of_files(pod, name, maps):
    """A ConfigMap for each mount of one file of a ConfigMap, which replaces that mount."""
    found = []
    for mount in (mount for container in pod["containers"] for mount in container["volumeMounts"]):
        wanted = mount.pop("subPathExpr", None)
        if wanted is None:
            continue
        volume, = (volume for volume in pod["volumes"] if volume["name"] == mount["name"])
        whole, = (thing for thing in maps if thing["metadata"]["name"] == volume["configMap"]["name"])
        folder, _, file = mount["mountPath"].rpartition("/")
        mount["mountPath"] = folder
        volume["configMap"] = {"name": f"{mount['name']}-{name}"}
        found.append({**whole, "metadata": {"name": f"{mount['name']}-{name}"},
                      "data": {file: whole["data"][wanted.replace("$(POD_NAME)", name)]}})
    return found


def stateful_pods(workload):
    """The pods that Kubernetes creates for a StatefulSet."""
    for i in range(workload["spec"]["replicas"]):
        name = f"{workload['metadata']['name']}-{i}"
        pod = copy.deepcopy(with_claims(workload, name))
        for container in pod["containers"]:
            container["args"] = [argument.replace("$(POD_NAME)", name) for argument in container["args"]]
        metadata = {"name": name, "labels": dict(workload["spec"]["template"]["metadata"]["labels"])}
        yield {"apiVersion": "v1", "kind": "Pod", "metadata": metadata, "spec": pod}


class Played:
    """Objects that podman plays. The context begins when the startup probe of each pod succeeds."""

    def __init__(self, objects, image):
        self.objects, self.ports = playable(objects, image)
        self.probes = {kind: probe for workload in of_kind(objects, "Deployment", "StatefulSet")
                       for kind, probe in pod_of(workload)["containers"][0].items() if kind.endswith("Probe")}
        self.grace_s = pod_of(of_kind(objects, "Deployment", "StatefulSet")[0])["terminationGracePeriodSeconds"]
        self.volumes = [thing["metadata"]["name"] for thing in of_kind(self.objects, "ConfigMap",
                                                                       "PersistentVolumeClaim")]
        self.folder = tempfile.TemporaryDirectory()
        self.file = pathlib.Path(self.folder.name, "pods.yaml")

    def __enter__(self):
        self.file.write_text(yaml.safe_dump_all(self.objects), encoding="utf-8")
        docker("kube", "play", self.file)
        try:
            for pod in self.ports:
                self.wait_started(pod)
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        docker("kube", "down", self.file)
        for volume in self.volumes:
            docker("volume", "rm", "--force", volume)
        self.folder.cleanup()

    def wait_started(self, pod):
        """Runs the startup probe, as often as the kubelet would."""
        for _ in range(self.probes["startupProbe"]["failureThreshold"]):
            if self.probe(pod, "startupProbe"):
                return
            time.sleep(PROBE_S)
        raise AssertionError(f"{pod} does not start\n{self.log(pod)[-1000:]}")

    def probe(self, pod, kind):
        """Whether a probe of the manifest succeeds, in the container or from outside."""
        probe = self.probes[kind]
        if "exec" in probe:
            command = ["exec", self.container(pod), *probe["exec"]["command"]]
            try:
                docker(*command, deadline_s=probe["timeoutSeconds"] + 5)
                return True
            except AssertionError:
                return False
        port = self.ports[pod][probe["httpGet"]["port"]]
        with urllib.request.urlopen(f"http://127.0.0.1:{port}{probe['httpGet']['path']}") as answer:
            return answer.status == 200

    @staticmethod
    def container(pod):
        return f"{pod}-xr3"

    def log(self, pod):
        done = docker("logs", self.container(pod))
        return done.stdout + done.stderr

    def monitor(self, pod, token=None, **options):
        return Monitor("127.0.0.1", self.ports[pod]["monitor"], token=token, **options)

    def process(self, pod):
        return inspect(self.container(pod), ".State.Pid")

    def stop(self, pod):
        """Stops the container as the kubelet does: SIGTERM, and SIGKILL after the time of the manifest; the network of
        the pod stays. (`podman kube down` of podman 4.3 sends only SIGKILL.) Returns the exit code, and the seconds
        from the signal to the end, by the log and the engine."""
        docker("stop", "--time", self.grace_s, self.container(pod))
        done = docker("logs", "--timestamps", self.container(pod))
        signalled, = (line for line in (done.stdout + done.stderr).splitlines() if "signal 15: stopping" in line)
        state = inspect(self.container(pod), ".State")
        return state["ExitCode"], instant(state["FinishedAt"]) - instant(signalled)
