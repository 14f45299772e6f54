#!/usr/bin/env bash
# Finding: a warm shader cache takes a fifth off the start of a process that draws with llvmpipe.
#
# Guess: a software rasteriser starts slowly because LLVM compiles its shaders, so a warm disk cache starts it quickly.
# Seen (Mesa 22.3.6 of Debian 12, LLVM 15, through OSMesa): of the CPU time up to a first picture two fifths are dlopen,
# the cache saves one, and two are left with it: 6,000 page faults of relocations and fresh memory, which every process
# has anew. Whoever starts many render servers on a machine saves more by keeping them.
#
# Needs a Debian 12 with apt and a C compiler. Fails when the cache saves a third or more.
set -euo pipefail
version=22.3.6-1+deb12u2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/debs/partial" "$work/root"
: >"$work/status"
apt-get -qq -y --no-install-recommends --download-only -o Dir::State::status="$work/status" \
    -o Dir::Cache::archives="$work/debs" -o Debug::NoLocking=1 -o APT::Sandbox::User=root \
    install "libosmesa6=$version" >/dev/null
for deb in "$work"/debs/*.deb; do
    case ${deb##*/} in libc6_* | libgcc-s1_* | libstdc++6_*) ;; *) dpkg-deb -x "$deb" "$work/root" ;; esac
done
cat >"$work/first.c" <<'C'
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
/* Prints the CPU milliseconds and page faults of loading OSMesa, and those of a first picture with a shader of its own. */
static struct rusage now(void) {
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage;
}
static double ms(struct rusage a, struct rusage b) {
    return 1e3 * (double)(b.ru_utime.tv_sec - a.ru_utime.tv_sec + b.ru_stime.tv_sec - a.ru_stime.tv_sec) +
           1e-3 * (double)(b.ru_utime.tv_usec - a.ru_utime.tv_usec + b.ru_stime.tv_usec - a.ru_stime.tv_usec);
}
typedef void (*any)(void);
static any (*find)(const char*);
#define GL(result, name, ...) ((result(*)(__VA_ARGS__))find(#name))
static unsigned shader(unsigned kind, const char* text) {
    const unsigned made = GL(unsigned, glCreateShader, unsigned)(kind);
    GL(void, glShaderSource, unsigned, int, const char**, const int*)(made, 1, &text, NULL);
    GL(void, glCompileShader, unsigned)(made);
    return made;
}
int main(void) {
    enum { W = 320, H = 240 };
    const struct rusage begin = now();
    void* library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    if (!library) return fprintf(stderr, "%s\n", dlerror()), 1;
    const struct rusage loaded = now();
    void* (*create)(unsigned, int, int, int, void*) =
        (void* (*)(unsigned, int, int, int, void*))dlsym(library, "OSMesaCreateContextExt");
    unsigned char (*current)(void*, void*, unsigned, int, int) =
        (unsigned char (*)(void*, void*, unsigned, int, int))dlsym(library, "OSMesaMakeCurrent");
    find = (any(*)(const char*))dlsym(library, "OSMesaGetProcAddress");
    unsigned char* colour = calloc(W * H, 4);
    void* context = create(0x1908, 24, 0, 0, NULL);
    if (!context || !current(context, colour, 0x1401, W, H)) return 1;
    const unsigned program = GL(unsigned, glCreateProgram, void)();
    GL(void, glAttachShader, unsigned, unsigned)(program, shader(0x8b31,
        "#version 130\nout vec3 n;\nvoid main() { n = gl_Normal; gl_Position = gl_Vertex; }"));
    GL(void, glAttachShader, unsigned, unsigned)(program, shader(0x8b30,
        "#version 130\nin vec3 n;\nvoid main() { gl_FragColor = vec4(vec3(max(dot(normalize(n), vec3(0, 0, 1)), 0.1)), 1); }"));
    GL(void, glLinkProgram, unsigned)(program);
    GL(void, glUseProgram, unsigned)(program);
    GL(void, glEnable, unsigned)(0x0b71);
    GL(void, glClear, unsigned)(0x4100);
    GL(void, glBegin, unsigned)(4);
    GL(void, glNormal3f, float, float, float)(0, 0, 1);
    GL(void, glVertex3f, float, float, float)(-0.8f, -0.8f, 0);
    GL(void, glVertex3f, float, float, float)(0.8f, -0.8f, 0);
    GL(void, glVertex3f, float, float, float)(0, 0.8f, 0);
    GL(void, glEnd, void)();
    GL(void, glFinish, void)();
    const struct rusage drawn = now();
    if (colour[4 * (W * H / 2 + W / 2)] < 250) return fprintf(stderr, "no triangle\n"), 1;
    printf("%.1f %ld %.1f %ld\n", ms(begin, loaded), loaded.ru_minflt - begin.ru_minflt, ms(loaded, drawn), drawn.ru_minflt - loaded.ru_minflt);
    return 0;
}
C
cc -O1 "$work/first.c" -o "$work/first"
lib=$work/root/usr/lib/x86_64-linux-gnu
start() { LD_LIBRARY_PATH="$lib" LP_NUM_THREADS=0 MESA_SHADER_CACHE_DIR="$work/cache" "$work/first"; }
start >/dev/null # the files are in memory from here on
for _ in 1 2 3 4 5 6 7 8 9; do
    start >>"$work/warm"
    mv "$work/cache" "$work/kept"
    start >>"$work/cold"
    rm -rf "$work/cache"
    mv "$work/kept" "$work/cache"
done
median() { cut -d ' ' -f "$2" "$work/$1" | sort -n | sed -n 5p; }
printf '%-32s %12s %12s\n' "libosmesa6 $version" "" "" "medians of nine" "CPU ms" "page faults"
printf '%-32s %12s %12s\n' "dlopen" "$(median cold 1)" "$(median cold 2)" \
    "first picture, cold cache" "$(median cold 3)" "$(median cold 4)" \
    "first picture, warm cache" "$(median warm 3)" "$(median warm 4)"
awk -v load="$(median cold 1)" -v cold="$(median cold 3)" -v warm="$(median warm 3)" 'BEGIN {
    printf "loading is %.0f %% of a cold start; a warm cache saves %.0f %%\n", 100 * load / (load + cold), 100 * (cold - warm) / (load + cold)
    exit !(3 * (cold - warm) < load + cold)
}' || { echo "changed: the cache saves a third or more"; exit 1; }
echo "as found: most of the start is left with a warm cache"
