"""The outer ring: its parts, the samples of it that `.ci/run` takes after a change, and the record of each part's last run."""

import subprocess

from steps import ROOT

# Parts by name, each below eighty minutes of two cores: lines of bash.
PARTS = {
    # Every test of the inner ring at its full size.
    "tests": "RING=outer dev/test",
    # All algorithms at run time against emitted code, for every mechanism and scene.
    "gallery": "cargo test --workspace --all-features --test interpreted_gallery",
    # No emitted function can come to a panic, at each level and for a Cortex-M4; the instructions of each.
    "firmware": """
        RING=outer cargo test --workspace --all-features --test firmware
        if rustup target add thumbv7em-none-eabihf; then
            FIRMWARE_TARGET=thumbv7em-none-eabihf cargo test --workspace --all-features --test firmware
        else
            echo "left out: firmware of a Cortex-M4, since Rust for it is not to be had here"
        fi
        if command -v valgrind >/dev/null || { apt-get update -qq && apt-get install -y -qq valgrind; }; then
            cargo test --workspace --all-features --test instructions
        else
            echo "left out: instructions, since valgrind is not to be had here"
        fi
    """,
    # Other targets and the oldest Rust.
    "targets": "dev/wasm/run && dev/oldest-rust",
    # Each package built alone.
    "packages": "dev/packages --each",
    # Every prefix of every example, typed in a browser.
    "page": "LINKAGE_EVERY_PREFIX=1 web/check",
    # Sweeps in SQL, in one process and on a cluster.
    "engine": "dev/engine",
    # What development builds are too slow for: 48 million calls at run time against emitted code, every float's sine.
    "release": """
        CALLS=10000 cargo test --release --workspace --all-features --test interpreted same_bits
        cargo test --release --workspace --all-features --test runtime sine
    """,
}

COMPILER = ["linkage-compiler", "linkage-macros", "dev/gallery"]
NUMERICS = ["linkage-runtime", "linkage-dynamics", "linkage-double"]

# What `dev/ci` takes of the outer ring: its name, the part that has all of it, the folders whose changes since that part's
# last run ask for it, and the command.
SAMPLES = [
    ("firmware at one level", "firmware", [*COMPILER, *NUMERICS], "cargo test --workspace --all-features --test firmware"),
    ("the gallery in WebAssembly", "targets", [*COMPILER, *NUMERICS, "linkage-interpreter", "dev/wasm"], "dev/wasm/run"),
    ("the oldest Rust", "targets", [*COMPILER, *NUMERICS, "src", "linkage-report", "linkage-sweep"], "dev/oldest-rust"),
    ("the page", "page", [f"web/{name}" for name in ("page", "src", "test", "build.mjs", "check", "package-lock.json")], "web/check"),
    ("the engine", "engine", ["engine", "linkage-sweep", "linkage-sweep-arrow"], "dev/engine"),
]

# Commits after which a part of the outer ring is old.
OLD = 40
RECORD = ROOT / "dev/full.tsv"


def git(*arguments):
    """What git prints, or nothing where it fails: outside of a repository, or for a commit that it does not have."""
    run = subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True)
    return run.stdout.strip() if run.returncode == 0 else None


def recorded():
    """The commit and the date of the last run of each part, and its processor seconds."""
    rows = (line.split("\t") for line in RECORD.read_text().splitlines() if not line.startswith("#"))
    return {part: others for part, *others in rows}


def record(part, seconds):
    """Notes a run of a part at the commit that is checked out."""
    rows = recorded() | {part: [git("rev-parse", "HEAD"), git("log", "-1", "--format=%cs"), f"{seconds:.0f}"]}
    head = [line for line in RECORD.read_text().splitlines() if line.startswith("#")]
    lines = ["\t".join([name, *rows[name]]) for name in PARTS if name in rows]
    RECORD.write_text("\n".join([*head, *lines]) + "\n")


def has_changed(part, folders):
    """True if a file in the folders differs from the commit of the part's last run, or where that is not known."""
    commit, *_ = recorded().get(part, ["no commit"])
    differing = git("diff", "--name-only", commit, "--", *folders)
    return differing is None or differing != ""


def old_parts():
    """Sentences about the parts that ran more than forty commits ago."""
    for part in PARTS:
        commit, *date = recorded().get(part, [None, None])
        count = git("rev-list", "--count", f"{commit}..HEAD")
        if count is None:
            yield f"`dev/full {part}`: no run is known"
        elif int(count) > OLD:
            yield f"`dev/full {part}` ran {count} commits ago, {date[0]}"
