/* A move of one second with sleeps; the card's ms and the real ms that it took. */
#include <time.h>

#include "client.h"

static double now(void)
{
    struct timespec real;
    clock_gettime(CLOCK_MONOTONIC, &real);
    return (double)real.tv_sec * 1e3 + (double)real.tv_nsec / 1e6;
}

int main(void)
{
    double place[4], began;
    unsigned long card;
    GT_Open(65535);
    GT_SetSynVel(1), GT_SetSynAcc(1);
    began = now(), card = drycut_milliseconds();
    GT_LnXY(1000, 0);
    while (!(crd() & IDLE))
        usleep(50000);
    card = drycut_milliseconds() - card;
    began = now() - began;
    GT_GetPrfPnt(place);
    printf("%g %lu %g\n", place[0], card, began);
    return GT_Close();
}
