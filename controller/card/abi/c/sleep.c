/* libdrycut_sleep: the sleeps of a program let the card's time pass, and take none of their own.

   Linked before the C library, or preloaded, it is asked in its place. Where there is no libges, or that cannot start,
   and in what libges does itself, a sleep is a sleep. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <poll.h>
#include <sys/select.h>
#include <threads.h>
#include <time.h>
#include <unistd.h>

#define DRYCUT __attribute__((visibility("default")))
#define REAL(name) ((__typeof__(&(name)))dlsym(RTLD_NEXT, #name))

static int (*pass)(double seconds);

/* libges tells how time passes on its card: 0 where it did. */
DRYCUT void drycut_sleep_by(int (*let_pass)(double seconds))
{
    pass = let_pass;
}

static int passed(double seconds)
{
    return pass && pass(seconds) == 0;
}

static double seconds_of(const struct timespec *span)
{
    return (double)span->tv_sec + (double)span->tv_nsec / 1e9;
}

static int is_span(const struct timespec *span)
{
    return span && span->tv_sec >= 0 && span->tv_nsec >= 0 && span->tv_nsec < 1000000000;
}

static int pass_span(const struct timespec *span, struct timespec *left)
{
    if (!is_span(span) || !passed(seconds_of(span)))
        return 0;
    if (left)
        left->tv_sec = 0, left->tv_nsec = 0;
    return 1;
}

DRYCUT unsigned int sleep(unsigned int seconds)
{
    return passed(seconds) ? 0 : REAL(sleep)(seconds);
}

DRYCUT int usleep(useconds_t microseconds)
{
    return passed(microseconds / 1e6) ? 0 : REAL(usleep)(microseconds);
}

DRYCUT int nanosleep(const struct timespec *span, struct timespec *left)
{
    return pass_span(span, left) ? 0 : REAL(nanosleep)(span, left);
}

DRYCUT int thrd_sleep(const struct timespec *span, struct timespec *left)
{
    return pass_span(span, left) ? 0 : REAL(thrd_sleep)(span, left);
}

/* How long until a moment. The clocks of the system stand still while a simulated sleep lasts, so a thread that sleeps
   from moment to moment, each so long after the one before, gets what lies between the two. */
static double until(clockid_t clock, const struct timespec *moment)
{
    static _Thread_local double before;
    struct timespec now;
    double at = seconds_of(moment), left;
    clock_gettime(clock, &now);
    left = at - seconds_of(&now);
    if (before > 0.0 && at > before && at - before < left)
        left = at - before;
    before = at;
    return left > 0.0 ? left : 0.0;
}

DRYCUT int clock_nanosleep(clockid_t clock, int flags, const struct timespec *span, struct timespec *left)
{
    if (flags == 0 && pass_span(span, left))
        return 0;
    if (flags == TIMER_ABSTIME && pass && is_span(span) && passed(until(clock, span)))
        return 0;
    return REAL(clock_nanosleep)(clock, flags, span, left);
}

/* A wait for no file is a sleep. */
DRYCUT int select(int files, fd_set *in, fd_set *out, fd_set *other, struct timeval *span)
{
    int sleeps = span && !in && !out && !other && span->tv_sec >= 0 && span->tv_usec >= 0;
    if (!sleeps || !passed((double)span->tv_sec + (double)span->tv_usec / 1e6))
        return REAL(select)(files, in, out, other, span);
    span->tv_sec = 0, span->tv_usec = 0;
    return 0;
}

DRYCUT int poll(struct pollfd *files, nfds_t count, int ms)
{
    return count == 0 && ms > 0 && passed(ms / 1e3) ? 0 : REAL(poll)(files, count, ms);
}
