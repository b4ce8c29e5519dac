"""Draws a list with a Slurm array and with GNU parallel, as in docs/batch.md: all of it, each model
once.

cluster_test.py GLINT PROJECT_FOLDER; needs Debian's slurm-wlm, munge and parallel.

Runs a controller and two nodes on this machine, in a folder of their own and without root. Draws a
list of 500 in 8 tasks, one of which is killed and requeued; one node is drained. Then the same with
parallel, one of whose jobs is killed.
"""

import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

glint, root = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
COUNT, TASKS = 500, 8


def check(holds, what):
    if not holds:
        sys.exit("not so: " + what)


def until(holds, what, seconds=120):
    end = time.monotonic() + seconds
    while not holds():
        check(time.monotonic() < end, what + " within %d s" % seconds)
        time.sleep(0.1)


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


def documented(language, word):
    """The code block in docs/batch.md with this language that contains the word."""
    text = (root / "docs/batch.md").read_text()
    blocks = re.findall(r"^```%s\n(.*?)^```" % language, text, re.S | re.M)
    found = [block for block in blocks if word in block]
    check(len(found) == 1, "one block with %r in docs/batch.md, not %d" % (word, len(found)))
    return found[0]


class Cluster:
    """munged, slurmctld and two slurmd of four processors each."""

    def __init__(self, folder):
        self.folder, self.daemons = folder, []
        host = socket.gethostname().split(".")[0]
        key = folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        ports = free_ports(3)
        user = subprocess.run(["id", "-un"], text=True, stdout=subprocess.PIPE, check=True).stdout.strip()
        conf = folder / "slurm.conf"
        conf.write_text(f"""ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=20
CredType=cred/munge
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool.%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.%n.log
SwitchType=switch/none
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
MinJobAge=300
NodeName=one NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=2
NodeName=two NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=2
PartitionName=all Nodes=one,two Default=YES MaxTime=10 State=UP
""")
        # slurmd requires a cgroup plugin even if nothing is controlled and no cgroup is mounted.
        version = subprocess.run(["/usr/sbin/slurmd", "-V"], text=True, stdout=subprocess.PIPE, check=True)
        newer = int(re.search(r"(\d+)\.", version.stdout).group(1)) >= 24
        (folder / "cgroup.conf").write_text("CgroupPlugin=%s\n" % ("disabled" if newer else "cgroup/v1"))
        self.environment = dict(os.environ, SLURM_CONF=str(conf),
                                PATH=os.pathsep.join([os.path.dirname(glint), os.environ["PATH"],
                                                      "/usr/sbin"]))
        self.start("munged", "--foreground", "--force", "--key-file=%s" % key,
                   "--socket=%s/munge.socket" % folder, "--pid-file=%s/munged.pid" % folder,
                   "--seed-file=%s/munged.seed" % folder, "--log-file=%s/munged.log" % folder)
        until((folder / "munge.socket").exists, "munged is up")
        self.start("slurmctld", "-D", "-i", "-f", conf)
        for node in "one", "two":
            (folder / ("spool." + node)).mkdir()
            self.start("slurmd", "-D", "-N", node, "-f", conf)
        until(lambda: self.run("sinfo", "-h", "-N", "-o", "%T").split() == ["idle", "idle"],
              "two nodes are idle")

    def start(self, *command):
        log = open(self.folder / (command[0] + ".out"), "ab")
        self.daemons.append(subprocess.Popen([str(part) for part in command], env=self.environment,
                                             stdout=log, stderr=log))

    def run(self, *command, **options):
        return subprocess.run([str(part) for part in command], env=self.environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, **options).stdout

    def stop(self):
        for daemon in reversed(self.daemons):
            daemon.send_signal(signal.SIGTERM)
        for daemon in self.daemons:
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()


def make_list(folder):
    (folder / "models").mkdir(parents=True)
    for i in range(COUNT):
        # Two sizes, so that shards are not simply every eighth.
        name = "torus.glb" if i % 7 == 0 else "sphere.glb"
        shutil.copy(root / "models" / name, folder / ("models/m%03d.glb" % i))
    (folder / "models.txt").write_text("".join("models/m%03d.glb\n" % i for i in range(COUNT)))


def pictures(folder):
    return {path.name: (path.stat().st_ino, path.stat().st_mtime_ns)
            for path in (folder / "thumbs").glob("*.png")}


def merge(folder):
    subprocess.run(["sh", "-e", "-c", documented("sh", "report.*.jsonl")], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL)


def check_whole(folder, kept):
    there = pictures(folder)
    check(len(there) == COUNT, "there are %d pictures, not %d" % (COUNT, len(there)))
    rest = [path.name for path in (folder / "thumbs").iterdir() if path.suffix != ".png"]
    check(not rest, "nothing else is there: %s" % rest[:5])
    again = [name for name, stat in kept.items() if there[name] != stat]
    check(not again, "nothing was drawn twice: %s" % again[:5])
    lines = [json.loads(line) for line in (folder / "report.jsonl").read_text().splitlines()]
    models = sorted(line["model"] for line in lines)
    check(models == sorted((folder / "models.txt").read_text().split()),
          "the merged report has each model once: %d lines" % len(lines))
    check({pathlib.Path(line["output"]).name for line in lines} == set(there),
          "the merged report has each picture")
    check(all("error" not in line for line in lines), "no line has an error")
    for line in lines[0], lines[1], lines[-1]:
        alone = folder / "alone.png"
        subprocess.run([glint, "render", line["model"], "-o", alone], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
        check(alone.read_bytes() == (folder / line["output"]).read_bytes(),
              line["model"] + " is drawn as by one process")
        alone.unlink()


def slurm(folder):
    make_list(folder)
    (folder / "job.sh").write_text(documented("bash", "#SBATCH"))
    (folder / "cluster").mkdir()
    cluster = Cluster(folder / "cluster")
    try:
        job = cluster.run("sbatch", "--parsable", "--array=1-%d" % TASKS, "job.sh", cwd=folder).strip()
        check(job.isdigit(), "sbatch took the job: " + job)

        def state():
            rows = cluster.run("squeue", "-h", "-r", "-j", job, "-o", "%K %T %N").splitlines()
            return [row.split() for row in rows]

        def running(node):
            return [row[0] for row in state() if row[1] == "RUNNING" and row[2] == node]

        until(lambda: running("one") and running("two") and len(pictures(folder)) >= 20,
              "both nodes draw")
        cluster.run("scontrol", "update", "NodeName=two", "State=DRAIN", "Reason=test")
        killed = running("one")[0]
        cluster.run("scontrol", "requeue", "%s_%s" % (job, killed))
        kept = pictures(folder)
        until(lambda: "two" not in [row[2] for row in state() if len(row) > 2], "the drained node is empty")
        until(lambda: any(row[0] == killed and row[1] == "RUNNING" for row in state()) or not state(),
              "the killed task runs again", 200)
        until(lambda: not state(), "all tasks end", 300)
        check("drained" in cluster.run("sinfo", "-h", "-N", "-o", "%N %T"), "a node is drained")
        print("array: task %s requeued with %d of %d pictures drawn" % (killed, len(kept), COUNT))
        merge(folder)
        skipped = sum(json.loads(line).get("skipped", False)
                      for line in (folder / "report.jsonl").read_text().splitlines())
        check(0 < skipped < COUNT // 2, "the task went on where it was: %d skipped" % skipped)
        check_whole(folder, kept)
    except BaseException:
        for log in sorted((folder / "cluster").glob("*.log")) + sorted(folder.glob("slurm-*.out")):
            print("--", log.name, log.read_text()[-2000:], sep="\n")
        raise
    finally:
        cluster.stop()


def parallel(folder):
    make_list(folder)
    environment = dict(os.environ, PATH=os.path.dirname(glint) + os.pathsep + os.environ["PATH"],
                       HOME=str(folder))
    run = subprocess.Popen(["bash", "-e", "-c", documented("sh", "parallel")], cwd=folder, env=environment,
                           stderr=subprocess.PIPE, text=True)
    until(lambda: len(pictures(folder)) >= 20 or run.poll() is not None, "parallel draws")
    children = subprocess.run(["ps", "-eo", "pid,args"], text=True, stdout=subprocess.PIPE).stdout
    ours = [line.split()[0] for line in children.splitlines()
            if re.search(r" render .*--shard [0-9]+/8", line) and "glint render" in line
            and os.path.exists("/proc/%s/cwd" % line.split()[0])
            and os.readlink("/proc/%s/cwd" % line.split()[0]) == str(folder)
            and os.path.basename(os.readlink("/proc/%s/exe" % line.split()[0])) == "glint"]
    check(ours, "a job of parallel runs")
    kept = pictures(folder)
    os.kill(int(ours[0]), signal.SIGKILL)
    _, said = run.communicate(timeout=300)
    check(run.returncode == 0, "parallel ends with 0, not %d\n%s" % (run.returncode, said))
    print("parallel: one job killed with %d of %d pictures drawn" % (len(kept), COUNT))
    merge(folder)
    check_whole(folder, kept)


def main():
    for program in "munged", "slurmctld", "slurmd", "sbatch", "parallel":
        check(shutil.which(program, path=os.environ["PATH"] + ":/usr/sbin"),
              program + " is there: apt-get install slurm-wlm munge parallel")
    with tempfile.TemporaryDirectory() as folder:
        slurm(pathlib.Path(folder) / "slurm")
        parallel(pathlib.Path(folder) / "parallel")


if __name__ == "__main__":
    main()
