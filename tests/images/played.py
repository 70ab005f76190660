"""Plays manifests with `podman kube play`, which knows Pods, Deployments and ConfigMaps. What podman 4.3 does
not know is replaced by the nearest thing that it knows: a StatefulSet by the pods that it would create, a Secret
by a ConfigMap, $(POD_NAME) by its value; Services, budgets and policies are left out. The tests run the probes, as
the kubelet would, because podman runs them with a shell, which the image does not have."""

import base64
import copy
import pathlib
import tempfile
import time
import urllib.request

import yaml

from containers import docker, inspect
from manifests import of_kind, pod_of
from test_compose import free_ports
from test_image import instant
from xr3 import Monitor

PROBE_S = 0.1


def playable(objects, image):
    """The objects for podman: ConfigMaps first, then pods; and the ports of this machine for each pod, by its name and
    the name of the port."""
    maps = [without_secret(thing) for thing in of_kind(copy.deepcopy(objects), "ConfigMap", "Secret")]
    runnable, ports = [], {}
    for workload in of_kind(copy.deepcopy(objects), "Deployment", "StatefulSet"):
        pods = [workload] if workload["kind"] == "Deployment" else list(stateful_pods(workload))
        for pod in pods:
            name = f"{pod['metadata']['name']}-pod-0" if pod is workload else pod["metadata"]["name"]
            ports[name] = adapt(pod["spec"] if pod["kind"] == "Pod" else pod_of(pod), image)
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


def stateful_pods(workload):
    """The pods that Kubernetes creates for a StatefulSet."""
    for i in range(workload["spec"]["replicas"]):
        name = f"{workload['metadata']['name']}-{i}"
        pod = copy.deepcopy(pod_of(workload))
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
        self.volumes = [thing["metadata"]["name"] for thing in of_kind(self.objects, "ConfigMap")]
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
