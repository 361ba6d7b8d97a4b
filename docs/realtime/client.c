/* Scan and settle: a PI controller for stage.json, over UDP or shared memory. Linux alone, no library.
 *
 *   cc -O2 -o client docs/realtime/client.c -lm
 *   stickslip realtime docs/realtime/stage.json --period "100 us" --for "2 s" --channels stage.x_m --notes target.x_m,error_m \
 *       --inputs udp:127.0.0.1:5005 --outputs udp:127.0.0.1:5006      and   ./client udp 127.0.0.1 5005 5006
 *   stickslip realtime … --inputs shm:stage --outputs shm:stage       and   ./client shm stage
 */
#include <arpa/inet.h>
#include <fcntl.h>
#include <math.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* A packet: bytes as on the wire, on a little-endian machine. */
typedef struct {
    char magic[4];
    uint16_t version, count;
    uint64_t scenario, sequence;
    double time, values[150];
} packet;
#define HEAD 32

static int port = -1;                       /* UDP … */
static struct sockaddr_in to;
static _Atomic uint64_t *memory, *in, *out; /* … or shared memory */
static uint64_t seen;

static void nap(long nanoseconds) { nanosleep(&(struct timespec){0, nanoseconds}, NULL); }

static int open_udp(const char *host, int theirs, int own)
{
    struct sockaddr_in here = {.sin_family = AF_INET, .sin_port = htons(own)};
    to = (struct sockaddr_in){.sin_family = AF_INET, .sin_port = htons(theirs)};
    if (inet_pton(AF_INET, host, &to.sin_addr) != 1) return -1;
    here.sin_addr = to.sin_addr;
    port = socket(AF_INET, SOCK_DGRAM, 0);
    struct timeval patience = {20, 0}; /* the loop measures itself before it speaks */
    setsockopt(port, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    return bind(port, (struct sockaddr *)&here, sizeof here);
}

static int open_memory(const char *name)
{
    char path[256];
    snprintf(path, sizeof path, "/dev/shm/%s", name);
    for (int tries = 0; tries < 2000; tries++, nap(10000000)) {
        struct stat found;
        int file = open(path, O_RDWR);
        if (file < 0) continue;
        if (fstat(file, &found) == 0 && found.st_size >= 64) {
            memory = mmap(NULL, found.st_size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
            if (memory == MAP_FAILED) return -1;
            if (atomic_load(memory) == 0x316d6873706c7373u) { /* "sslpshm1" */
                in = memory + memory[4] / 8;
                out = memory + memory[5] / 8;
                return 0;
            }
            munmap((void *)memory, found.st_size);
        }
        close(file);
    }
    return -1;
}

/* The newest packet; 0 when the loop is over. */
static int receive(packet *p)
{
    if (port >= 0) {
        ssize_t length = recv(port, p, sizeof *p, 0);
        struct timeval patience = {1, 0};
        setsockopt(port, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        while (length > 0 && recv(port, p, sizeof *p, MSG_DONTWAIT) > 0) {}
        return length >= HEAD;
    }
    for (;; nap(20000)) {
        uint64_t counter = atomic_load_explicit(out, memory_order_acquire);
        if (counter != seen && counter % 2 == 0) {
            uint64_t *word = (uint64_t *)p;
            for (unsigned i = 0; i < HEAD / 8 + memory[3]; i++)
                word[i] = atomic_load_explicit(out + 2 + i, memory_order_relaxed);
            atomic_thread_fence(memory_order_acquire);
            if (atomic_load_explicit(out, memory_order_relaxed) == counter) { seen = counter; return 1; }
        }
        if (memory[7] == 2) return 0;
    }
}

static void send_packet(const packet *p)
{
    size_t length = HEAD + 8 * p->count;
    if (port >= 0) { sendto(port, p, length, 0, (struct sockaddr *)&to, sizeof to); return; }
    uint64_t busy = atomic_load_explicit(in, memory_order_relaxed);
    const uint64_t *word = (const uint64_t *)p;
    /* Claim the record. Where another client is writing, this answer is left out: the next one is not far. */
    if (busy++ % 2 || !atomic_compare_exchange_strong_explicit(in, &(uint64_t){busy - 1}, busy, memory_order_acquire,
                                                               memory_order_relaxed)) return;
    atomic_thread_fence(memory_order_release);
    atomic_store_explicit(in + 1, (uint64_t)getpid(), memory_order_relaxed);
    for (size_t i = 0; i < length / 8; i++) atomic_store_explicit(in + 2 + i, word[i], memory_order_relaxed);
    /* It is another one where the loop took this client for dead. */
    atomic_compare_exchange_strong_explicit(in, &busy, busy + 1, memory_order_release, memory_order_relaxed);
}

/* Half of the time a triangle of ±5 um at 10 Hz, half of the time steps to 2 um and 5 um, m. */
static double target(double t)
{
    t = fmod(t, 0.4);
    if (t >= 0.2) return t < 0.3 ? 2e-6 : 5e-6;
    double phase = fmod(10 * t, 1);
    return 5e-6 * (phase < 0.25 ? 4 * phase : phase < 0.75 ? 2 - 4 * phase : 4 * phase - 4);
}

/* Stroke, m, frequency, Hz, and heading of cycles that carry the stage at a speed, m/s: by their frequency while strokes
 * are full, below that by shorter strokes. A flyback takes 37 nm back. */
static void cycles(double speed, double *out)
{
    const double largest = 400e-9, slowest = 500, fastest = 1000, lost = 37e-9;
    out[1] = fmin(fmax(fabs(speed) / (largest - lost), slowest), fastest);
    out[0] = speed == 0 ? 0 : fmin(lost + fabs(speed) / out[1], largest);
    out[2] = speed < 0 ? -1 : 1;
}

int main(int count, char **word)
{
    int failed = count == 5 && !strcmp(word[1], "udp") ? open_udp(word[2], atoi(word[3]), atoi(word[4]))
               : count == 3 && !strcmp(word[1], "shm") ? open_memory(word[2]) : -1;
    if (failed) { fprintf(stderr, "client udp HOST THEIR_PORT OWN_PORT | client shm NAME\n"); return 2; }
    prctl(PR_SET_TIMERSLACK, 1); /* naps end when they should, to 1 ns instead of 50 us */
    const double proportional = 300, integral = 50000, near = 2e-9; /* 1/s; 1/s²; m */
    double total = 0, last = 0, squares = 0;
    uint64_t answers = 0;
    packet p;
    while (receive(&p)) {
        double t = p.time, goal = target(t), error = goal - p.values[0];
        int stands = target(t - 1e-3) == goal, is_close = stands && fabs(error) < 400e-9;
        int rests = stands && fabs(error) < near, waits = is_close && fmod(t, 4e-3) < 3e-3;
        total = rests ? 0 : fmax(-4e-10, fmin(4e-10, total + !waits * error * fmin(t - last, 1e-3)));
        double ahead = fmod(t, 0.4) < 0.2 ? (goal - target(t - 1e-3)) / 1e-3 : 0; /* the scan's own speed */
        last = t;
        squares += error * error;
        p.count = 6;
        p.sequence = ++answers;
        cycles(rests ? 0 : ahead + proportional * error + integral * total, p.values);
        /* Close to its goal one cycle at a time, each from rest: a number of steps counts when it changes. */
        p.values[3] = !is_close ? -1 : waits ? 0 : 1;
        p.values[4] = goal;
        p.values[5] = error;
        send_packet(&p);
    }
    printf("%llu answers up to %.4f s, error %.1f nm rms\n", (unsigned long long)answers, last,
           1e9 * sqrt(squares / (answers ? answers : 1)));
    return 0;
}
