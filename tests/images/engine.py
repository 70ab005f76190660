"""Provides a container engine as the command `docker`: docker if it is available, else podman and buildah
with separate storage in build/images. If no registry can be reached, the base image is made with
mmdebstrap and uses the package sources of this machine.
"""

import contextlib
import os
import pathlib
import resource
import shutil
import subprocess
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "build" / "images"
BASE = "debian:bookworm-slim"
PULL_DEADLINE_S = 120
SOCKET_DEADLINE_S = 20
HEALTH_INTERVAL_S = 0.2
UNHEALTHY = 1  # exit code of a failed check; other codes mean that there is nothing to check
MOST_HEALTH_CHECKS = 3  # more failures make a container unhealthy
NETWORK_SETTINGS = ("http_proxy", "https_proxy", "no_proxy", "NODE_EXTRA_CA_CERTS",
                    "npm_config_registry")


def quiet(*command, **options):
    """Runs a command and discards its output; returns whether it succeeded."""
    try:
        return subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, check=False, **options).returncode == 0
    except (OSError, subprocess.TimeoutExpired):
        return False


def docker_answers():
    """Whether a docker engine is available, and not podman under the name docker."""
    if quiet("sh", "-c", "docker --version | grep -qi podman"):
        return False
    return quiet("docker", "version", "--format", "{{.Server.Version}}", timeout=20)


@contextlib.contextmanager
def engine():
    """Makes the command `docker` work in this process's environment; yields the engine's name."""
    if docker_answers():
        if not quiet("docker", "compose", "version"):
            raise SystemExit("`docker compose` does not work: docker's compose plugin is missing")
        yield "docker"
        return
    configure_podman()
    socket = FOLDER / "podman.sock"
    socket.unlink(missing_ok=True)
    command = ["docker", "system", "service", "--time=0", f"unix://{socket}"]
    with open(FOLDER / "service.log", "wb") as log:
        service = subprocess.Popen(command, env={**os.environ, "BUILDAH_ISOLATION": "chroot"},
                                   stdin=subprocess.DEVNULL, stdout=log, stderr=log)
    try:
        wait_for_file(socket, service)
        with health_checks():
            yield "podman"
    finally:
        service.terminate()
        service.wait()
        unmount()


def unmount():
    """Unmounts podman's storage, which podman leaves mounted: `rm -rf build` would fail."""
    mounts = pathlib.Path("/proc/self/mounts").read_text(encoding="utf-8").splitlines()
    places = [mount.split()[1] for mount in mounts if mount.split()[1].startswith(f"{FOLDER}/")]
    for place in sorted(places, reverse=True):
        quiet("umount", place)


def wait_for_file(path, process):
    deadline = time.monotonic() + SOCKET_DEADLINE_S
    while not path.exists():
        if process.poll() is not None or time.monotonic() > deadline:
            raise SystemExit(f"the service of podman did not start; see {FOLDER / 'service.log'}")
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(0.01)


@contextlib.contextmanager
def health_checks():
    """Runs the health checks of every container that starts. Podman leaves them to systemd, so this is
    needed only where systemd does not run."""
    if pathlib.Path("/run/systemd/system").exists():
        yield
        return
    command = ["docker", "events", "--filter", "event=start", "--format", "{{.Name}}"]
    over = threading.Event()
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as events:
        watcher = threading.Thread(target=check_all, args=(events.stdout, over))
        watcher.start()
        try:
            yield
        finally:
            over.set()
            events.terminate()
            watcher.join()


def check_all(names, over):
    for name in names:
        for _ in range(MOST_HEALTH_CHECKS):
            checked = subprocess.run(["docker", "healthcheck", "run", name.strip()], check=False,
                                     capture_output=True)
            if checked.returncode != UNHEALTHY or over.wait(HEALTH_INTERVAL_S):
                break


def configure_podman():
    """Configures podman with separate storage, networks and limits, and puts tests/images/bin/docker first
    in PATH."""
    for name in ("storage", "run", "networks", "tmp", "volumes", "ccache"):
        (FOLDER / name).mkdir(parents=True, exist_ok=True)
    os.environ["PATH"] = f"{pathlib.Path(__file__).parent / 'bin'}:{os.environ['PATH']}"
    os.environ["XR3_ENGINE"] = str(FOLDER)
    limits = ", ".join(f'"{name}={most}:{most}"' for name, most in hard_limits())
    (FOLDER / "containers.conf").write_text(f"""\
[containers]
default_ulimits = [{limits}]
[network]
network_config_dir = "{FOLDER / "networks"}"
[engine]
runtime = "{'runc' if shutil.which('runc') else 'crun'}"
cgroup_manager = "cgroupfs"
events_logger = "file"
tmp_dir = "{FOLDER / "tmp"}"
volume_path = "{FOLDER / "volumes"}"
""", encoding="utf-8")
    for driver in ("overlay", "vfs"):  # overlay does not work on every file system
        write_storage(driver)
        if quiet("docker", "info"):
            return
    raise SystemExit("neither docker nor podman works; `podman info` may show the reason")


def write_storage(driver):
    (FOLDER / "storage.conf").write_text(f"""\
[storage]
driver = "{driver}"
runroot = "{FOLDER / "run"}"
graphroot = "{FOLDER / "storage" / driver}"
""", encoding="utf-8")


def hard_limits():
    """(name, limit) of the resource limits of containers: the defaults of the engine, reduced to the hard
    limits of this machine, because the engine fails on a higher limit."""
    pid_max = int(pathlib.Path("/proc/sys/kernel/pid_max").read_text(encoding="ascii"))
    for name, which, most in (("nofile", resource.RLIMIT_NOFILE, 1 << 20),
                              ("nproc", resource.RLIMIT_NPROC, pid_max)):
        hard = resource.getrlimit(which)[1]
        yield name, most if hard == resource.RLIM_INFINITY else min(hard, most)


# --- The base image.

def ensure_base():
    """Pulls the base image, or makes it if no registry can be reached. Returns what was done."""
    if quiet("docker", "image", "inspect", BASE):
        return f"{BASE} is already available"
    if quiet("docker", "pull", BASE, timeout=PULL_DEADLINE_S):
        return f"{BASE} was pulled"
    make_base()
    return f"{BASE} was made by mmdebstrap: no registry could be reached"


def make_base():
    """Makes the base image (debootstrap's variant minbase) from the package sources of this machine."""
    archive, extra = FOLDER / "base.tar", FOLDER / "base"
    write_host_settings(extra)
    subprocess.run(["mmdebstrap", "--quiet", "--variant=minbase", "--mode=auto",
                    f"--customize-hook=tar -C '{extra}' -c . | tar -C \"$1\" -x --no-same-owner",
                    "bookworm", str(archive), *host_sources()],
                   check=True, stdin=subprocess.DEVNULL)
    changes = [f"--change=ENV {name}={os.environ[name]}" for name in NETWORK_SETTINGS
               if os.environ.get(name)]
    subprocess.run(["docker", "import", *changes, str(archive), BASE], check=True,
                   stdout=subprocess.DEVNULL)
    archive.unlink()


def host_sources():
    """The files with apt's package sources, if this machine has the same release; else none."""
    release = pathlib.Path("/etc/os-release").read_text(encoding="utf-8")
    if "VERSION_CODENAME=bookworm" not in release:
        return []
    apt = pathlib.Path("/etc/apt")
    return [str(path) for path in (apt / "sources.list", *sorted(apt.glob("sources.list.d/*")))
            if path.suffix in (".list", ".sources") and path.is_file() and path.stat().st_size]


def write_host_settings(folder):
    """Writes the settings that this machine needs to reach its mirror: those of apt, and certificates."""
    shutil.rmtree(folder, ignore_errors=True)
    certificates = folder / "usr/local/share/ca-certificates"
    certificates.mkdir(parents=True)
    for path in pathlib.Path("/usr/local/share/ca-certificates").glob("*.crt"):
        shutil.copyfile(path, certificates / path.name)
    settings = subprocess.run(["apt-config", "dump", "Acquire"], capture_output=True, text=True,
                              check=True).stdout.splitlines()
    chosen = [line for line in settings if line.startswith(
        ("Acquire::http", "Acquire::https", "Acquire::Check-", "Acquire::Retries"))]
    conf = folder / "etc/apt/apt.conf.d"
    conf.mkdir(parents=True)
    (conf / "90host").write_text("\n".join(chosen) + "\n", encoding="utf-8")
