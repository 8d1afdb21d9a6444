/* Each kind of sleep for two seconds, and how long the card says that it was. */
#include <poll.h>
#include <sys/select.h>
#include <threads.h>
#include <time.h>
#include <windows.h>

#include "client.h"

static double now(void)
{
    struct timespec real;
    clock_gettime(CLOCK_MONOTONIC, &real);
    return (double)real.tv_sec + (double)real.tv_nsec / 1e9;
}

static unsigned long began;

static void slept(const char *how)
{
    printf("%s %.3f\n", how, (double)(drycut_milliseconds() - began) / 1000.0);
    began = drycut_milliseconds();
}

int main(void)
{
    struct timespec two = {2, 0}, moment;
    struct timeval span = {2, 0};
    double real = now();
    GT_Open(65535);
    real = now();
    began = drycut_milliseconds();
    Sleep(2000), slept("Sleep");
    usleep(2000000), slept("usleep");
    sleep(2), slept("sleep");
    nanosleep(&two, NULL), slept("nanosleep");
    clock_nanosleep(CLOCK_MONOTONIC, 0, &two, NULL), slept("clock_nanosleep");
    clock_gettime(CLOCK_MONOTONIC, &moment);
    for (int i = 0; i < 4; i++) {
        moment.tv_nsec += 500000000;
        moment.tv_sec += moment.tv_nsec / 1000000000, moment.tv_nsec %= 1000000000;
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &moment, NULL);
    }
    slept("until");
    thrd_sleep(&two, NULL), slept("thrd_sleep");
    select(0, NULL, NULL, NULL, &span), slept("select");
    poll(NULL, 0, 2000), slept("poll");
    printf("real %.3f\n", now() - real);
    return GT_Close();
}
