#!/bin/bash
# Builds the image, starts docker/compose.yaml, and lets check.py talk to the service.
#
#   tests/compose/run.sh COPPICE     (the path of a built coppice, which makes the scene to upload)
#
# Where no engine runs, Debian's is installed and started for as long as this takes; where no registry answers, the base
# image is made with debootstrap. Where neither can be, the test is skipped and says why.
set -euo pipefail
cd "$(dirname "$0")/../.."
coppice=$(realpath "$1")

skip() {
    echo "skipped: $1"
    exit 77
}

# Only root starts an engine. A user whose engine runs already needs no more.
if ! docker info >/dev/null 2>&1 && [ "$(id -u)" != 0 ]; then
    sudo -n true 2>/dev/null || skip "no container engine runs, and this user may not start one"
    exec sudo -n "$PWD/tests/compose/run.sh" "$coppice"
fi

work=$(mktemp -d)
dockerd=
project=coppice-test-$$
export COPPICE_IMAGE=coppice-test COPPICE_PORT
# One builder for every engine that Debian has.
export DOCKER_BUILDKIT=0 COMPOSE_DOCKER_CLI_BUILD=0

compose() { docker-compose -f docker/compose.yaml -p "$project" "$@"; }

clean_up() {
    local code=$?
    trap - EXIT
    if [ -S "$work/docker.sock" ] || [ -z "$dockerd" ]; then
        [ $code = 0 ] || compose logs --no-color --tail=50 2>/dev/null || true
        compose down --volumes >/dev/null 2>&1 || true
    fi
    if [ -n "$dockerd" ]; then
        kill "$dockerd" && wait "$dockerd" || true
    fi
    rm -rf "$work"
    exit $code
}
trap clean_up EXIT

start_engine() {
    script/bootstrap engine || skip "no container engine runs, and Debian's could not be installed"
    if docker info >/dev/null 2>&1; then return; fi # its package may have started it
    # Kept between runs for its images, and shared by all checkouts: one at a time.
    local data=/var/cache/coppice-compose-test
    mkdir -p $data
    exec 9>$data/lock
    flock --wait 1200 9 || skip "another run of this test holds the engine"
    dockerd --data-root $data/docker --exec-root "$work/exec" --pidfile "$work/pid" --host "unix://$work/docker.sock" \
        >"$work/dockerd.log" 2>&1 9>&- &
    dockerd=$!
    export DOCKER_HOST=unix://$work/docker.sock
    for _ in $(seq 100); do
        if docker info >/dev/null 2>&1; then return; fi
        kill -0 $dockerd 2>/dev/null || break
        sleep 0.2
    done
    tail -n 5 "$work/dockerd.log"
    skip "the container engine does not run on this machine"
}

have_base() {
    local base suite
    base=$(sed -n 's/^ARG BASE=//p' docker/Dockerfile)
    suite=${base#*:}
    suite=${suite%-slim}
    if docker image inspect "$base" >/dev/null 2>&1; then return; fi
    if timeout 120 docker pull --quiet "$base" 2>"$work/pull.log"; then return; fi
    [ "$(id -u)" = 0 ] || skip "no registry answers, and only root can make a base image"
    echo "no registry answers: making $base with debootstrap"
    debootstrap --variant=minbase "$suite" "$work/root" >"$work/debootstrap.log" 2>&1 ||
        skip "no registry answers, and debootstrap fails: $(tail -n 1 "$work/debootstrap.log")"
    rm -rf "$work"/root/var/cache/apt/archives/*.deb
    tar -C "$work/root" -c . | docker import - "$base" >/dev/null
}

docker info >/dev/null 2>&1 || start_engine
command -v docker-compose >/dev/null || script/bootstrap engine || skip "docker-compose could not be installed"
have_base
echo "engine and base image ready after $SECONDS s"

# Named, so that its layers outlive the pruning below and the next run starts from them.
docker build --quiet --target build -f docker/Dockerfile -t $COPPICE_IMAGE-build . >"$work/build.log" 2>&1 ||
    { tail -n 40 "$work/build.log"; exit 1; }
compose build >"$work/build.log" 2>&1 || { tail -n 40 "$work/build.log"; exit 1; }
docker image prune --force >/dev/null
echo "image built after $SECONDS s: $(($(docker image inspect --format '{{.Size}}' $COPPICE_IMAGE) / 1000000)) MB"

COPPICE_PORT=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
compose up --detach --no-build 2>&1
container=$(compose ps -q coppice)
for _ in $(seq 60); do
    health=$(docker inspect --format '{{.State.Health.Status}}' "$container")
    [ "$health" = starting ] || break
    sleep 1
done
[ "$health" = healthy ] || { echo "the container is $health"; exit 1; }
echo "healthy after $SECONDS s"

"$coppice" sample bunny13 -o "$work/scene.glb"
python3 tests/compose/check.py "http://127.0.0.1:$COPPICE_PORT" "$work/scene.glb"

[ "$(docker exec "$container" id -u)" != 0 ] || { echo "the service runs as root"; exit 1; }
! docker exec "$container" touch /written 2>/dev/null || { echo "the root file system can be written"; exit 1; }

# PID 1 gets no signal handler for free: without one of its own, stopping takes the whole grace period.
before=$SECONDS
compose stop >/dev/null 2>&1
[ $((SECONDS - before)) -lt 10 ] || { echo "an idle service took $((SECONDS - before)) s to stop"; exit 1; }
code=$(docker inspect --format '{{.State.ExitCode}}' "$container")
[ "$code" = 0 ] || { echo "the service ended with $code when asked to stop"; exit 1; }
echo "stopped after $SECONDS s"
