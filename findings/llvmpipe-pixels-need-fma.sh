#!/usr/bin/env bash
# Finding: the pixels of one and the same Mesa depend on whether the processor fuses multiply and add.
#
# Guess: llvmpipe computes in IEEE single precision, so one version of Mesa draws the same bits on every x86-64.
# Seen (Mesa 22.3.6 of Debian 12, LLVM 15): threads and the width of vectors change nothing, but with FMA hidden from Mesa
# (GALLIUM_OVERRIDE_CPU_CAPS=sse4.1 or sse2, which agree) colours and depths of a perspective mesh are others. A cluster of
# unlike processors cannot expect equal pixels of llvmpipe, though all run the same packages.
#
# Needs a Debian 12 with apt, a C compiler, and a processor with AVX2 and FMA. Fails when the pixels become equal.
set -euo pipefail
version=22.3.6-1+deb12u2
grep -qw fma /proc/cpuinfo || { echo "skipped: this processor has no FMA"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/debs/partial" "$work/root"
: >"$work/status"
apt-get -qq -y --no-install-recommends --download-only -o Dir::State::status="$work/status" \
    -o Dir::Cache::archives="$work/debs" -o Debug::NoLocking=1 -o APT::Sandbox::User=root \
    install "libosmesa6=$version" "libosmesa6-dev=$version" >/dev/null
for deb in "$work"/debs/*.deb; do
    case ${deb##*/} in libc6_* | libc6-dev_* | libgcc-s1_* | libstdc++6_*) ;; *) dpkg-deb -x "$deb" "$work/root" ;; esac
done
cat >"$work/mesh.c" <<'C'
#include <GL/osmesa.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
/* A bumpy sphere of small triangles in perspective; prints a hash of the colours and one of the depths. */
static uint64_t hash(const void* data, size_t bytes) {
    const unsigned char* p = data;
    uint64_t h = 1469598103934665603u;
    for (size_t i = 0; i < bytes; ++i) h = (h ^ p[i]) * 1099511628211u;
    return h;
}
static void point(int i, int j) {
    const double u = i * 2 * M_PI / 400, v = j * M_PI / 200, r = 1 + 0.1 * sin(9 * u) * sin(7 * v);
    glColor3f((float)(0.5 + 0.5 * cos(u)), (float)(0.5 + 0.5 * sin(v)), (float)(0.5 + 0.5 * cos(3 * u)));
    glVertex3f((float)(r * sin(v) * cos(u)), (float)(r * cos(v)), (float)(r * sin(v) * sin(u)));
}
int main(void) {
    enum { W = 640, H = 480 };
    OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 32, 0, 0, NULL);
    unsigned char* colour = calloc(W * H, 4);
    if (!context || !OSMesaMakeCurrent(context, colour, GL_UNSIGNED_BYTE, W, H)) return 1;
    glEnable(GL_DEPTH_TEST);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glMatrixMode(GL_PROJECTION);
    glFrustum(-0.066, 0.066, -0.05, 0.05, 0.1, 10);
    glMatrixMode(GL_MODELVIEW);
    glTranslatef(0.05f, -0.03f, -2.7f);
    glRotatef(33, 0.3f, 1, 0.2f);
    glBegin(GL_TRIANGLES);
    for (int j = 0; j < 200; ++j)
        for (int i = 0; i < 400; ++i) {
            point(i, j), point(i + 1, j), point(i + 1, j + 1);
            point(i, j), point(i + 1, j + 1), point(i, j + 1);
        }
    glEnd();
    glFinish();
    GLint w, h, bytes;
    void* depth;
    if (!OSMesaGetDepthBuffer(context, &w, &h, &bytes, &depth)) return 1;
    printf("%016llx %016llx\n", (unsigned long long)hash(colour, W * H * 4u), (unsigned long long)hash(depth, (size_t)w * h * bytes));
    fprintf(stderr, "%s, %s\n", (const char*)glGetString(GL_VERSION), (const char*)glGetString(GL_RENDERER));
    return 0;
}
C
lib=$work/root/usr/lib/x86_64-linux-gnu
cc -O1 -I "$work/root/usr/include" "$work/mesh.c" -o "$work/mesh" -L "$lib" -lOSMesa -lm -Wl,--allow-shlib-undefined
draw() { env LD_LIBRARY_PATH="$lib" MESA_SHADER_CACHE_DISABLE=true "$@" "$work/mesh"; }
all=$(draw)
again=$(draw LP_NUM_THREADS=0 2>/dev/null)
narrow=$(draw LP_NATIVE_VECTOR_WIDTH=128 2>/dev/null)
plain=$(draw GALLIUM_OVERRIDE_CPU_CAPS=sse4.1 2>/dev/null)
older=$(draw GALLIUM_OVERRIDE_CPU_CAPS=sse2 2>/dev/null)
printf '%-28s %s\n' "as it is" "$all" "one thread" "$again" "128-bit vectors" "$narrow" "sse4.1, no FMA" "$plain" "sse2, no FMA" "$older"
[[ $all == "$again" && $all == "$narrow" ]] || { echo "changed: threads or vector width now matter"; exit 1; }
[[ $plain == "$older" ]] || { echo "changed: sse2 and sse4.1 differ"; exit 1; }
[[ $all != "$plain" ]] || { echo "changed: pixels are equal without FMA"; exit 1; }
echo "as found: the same Mesa draws other pixels where the processor has no fused multiply-add"
