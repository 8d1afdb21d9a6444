/* A printer: a list is run while it is filled, entry by entry; on a full list it tries again.

   stream [pause] [threads] [TIMES]: with a pause in the first second; with a thread for a window and one for the pauses,
   beside the one that fills; so many times. */
#include <pthread.h>

#include "client.h"

enum { LIST_FULL = 0x8000, LAYERS = 6 };
static long refusals;
static int pauses, over;

/* One entry of a layer of 13: a square with two round corners, the tool on and off, and up. */
static int entry(int number, double z)
{
    switch (number) {
    case 0:
        return GT_Delay(5);
    case 1:
        return GT_BufIOBit(3, 0);
    case 2:
        return GT_SetSynVel(8);
    case 3:
        return GT_LnXYZ(9000, 0, z);
    case 4:
        return GT_ArcXY(9000, 1000, 90);
    case 5:
        return GT_SetSynVel(12);
    case 6:
        return GT_LnXY(10000, 9000);
    case 7:
        return GT_ArcXYP(9000, 10000, 1000, 1);
    case 8:
        return GT_LnXY(1000, 10000);
    case 9:
        return GT_LnXY(0, 9000);
    case 10:
        return GT_LnXY(0, 0);
    case 11:
        return GT_BufIOBit(3, 1);
    default:
        return GT_LnXYZG0(0, 0, z + 10000);
    }
}

static int put(int number, double z)
{
    unsigned short status;
    int code;
    for (;;) {
        GT_AddList();
        code = entry(number, z);
        GT_GetCmdSts(&status);
        GT_EndList();
        if (code != 1 || status != LIST_FULL)
            return code;
        refusals++;
    }
}

static void pause_once(void)
{
    double place[4];
    int set, gone_on;
    unsigned long began = drycut_milliseconds();
    GT_StpMtn();
    GT_SetHSIOOpt(0);
    usleep(200000);
    GT_GetPrfPnt(place);
    usleep(800000);
    set = GT_SetAtlPos(3, place[2]);
    GT_SetHSIOOpt(1);
    gone_on = GT_RestoreMtn();
    printf("pause: set %d restore %d, at rest %d\n", set, gone_on, drycut_milliseconds() - began >= 1000);
}

static void *fill(void *nothing)
{
    int code = 0;
    GT_StrtList();
    GT_MvXYZ(0, 0, 0, 10, 0.1);
    GT_EndList();
    GT_StrtMtn();
    for (int layer = 0; layer < LAYERS; layer++)
        for (int number = 0; number < 13; number++)
            if (!code)
                code = put(number, layer * 10000.0);
    if (code)
        printf("refused with %d\n", code);
    return nothing;
}

static void *look(void *nothing)
{
    double place[4];
    do {
        GT_GetPrfPnt(place);
        crd();
        usleep(50000);
    } while (!over);
    return nothing;
}

static void *hold(void *nothing)
{
    usleep(500000);
    if (pauses)
        pause_once();
    while (!(crd() & IDLE) || !(crd() & 0x2000))
        usleep(100000);
    over = 1;
    return nothing;
}

static void in_threads(void)
{
    void *(*work[])(void *) = {fill, look, hold};
    pthread_t threads[3];
    for (int i = 0; i < 3; i++)
        pthread_create(&threads[i], NULL, work[i], NULL);
    for (int i = 0; i < 3; i++)
        pthread_join(threads[i], NULL);
}

int main(int count, char **asked)
{
    int threads = 0, times = 1;
    for (int i = 1; i < count; i++) {
        pauses |= !strcmp(asked[i], "pause"), threads |= !strcmp(asked[i], "threads");
        times = atoi(asked[i]) ? atoi(asked[i]) : times;
    }
    while (times--) {
        if (GT_Open(65535) || GT_Reset())
            return puts("no card"), 1;
        GT_LmtSns(0xFF);
        GT_SetSynVel(10), GT_SetSynAcc(0.1), GT_SetStpAcc(0.5);
        over = 0;
        if (threads)
            in_threads();
        else
            fill(NULL), hold(NULL);
        tell("end");
    }
    printf("refused %ld\n%lu ms\n", refusals, drycut_milliseconds());
    return GT_Close();
}
