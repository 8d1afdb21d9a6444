/* Home and index of the axes 3, 2, 1, with sleeps of Linux. */
#include "client.h"

static int line(unsigned short axis, double to)
{
    double place[4];
    GT_GetPrfPnt(place);
    place[axis - 1] = to;
    return GT_LnXYZ(place[0], place[1], place[2]);
}

/* Seeks a mark that was armed; where it was captured, or LONG_MIN. */
static long seek(unsigned short axis, double to)
{
    long captured = 12345;
    if (line(axis, to))
        return -1;
    while (!(sts(axis) & CAPTURED))
        if (crd() & IDLE)
            return -2;
    GT_StpMtn();
    wait_idle();
    usleep(200000);
    return GT_GetCapt(axis, &captured) ? -3 : captured;
}

static void home(unsigned short axis)
{
    unsigned short levels = 0;
    long at, index;
    GT_ClrSts(axis);
    GT_SetSynVel(20);
    GT_CaptHome(axis);
    at = seek(axis, -500000);
    GT_ClrSts(axis);
    line(axis, at);
    wait_idle();
    GT_SetSynVel(2);
    GT_CaptIndex(axis);
    index = seek(axis, at + 10000);
    line(axis, index);
    wait_idle();
    GT_ClrSts(axis);
    printf("axis %d: home %ld index %ld zero %d sts %04x", axis, at, index, GT_ZeroPos(axis), sts(axis));
    GT_GetLmtSwt(&levels);
    printf(" levels %02x\n", levels & 0x3F);
}

int main(void)
{
    unsigned short levels = 0;
    if (GT_Open(65535) || GT_Reset())
        return puts("no card"), 1;
    GT_LmtSns(0xFF);
    GT_GetLmtSwt(&levels);
    printf("levels %02x\n", levels & 0x3F);
    for (unsigned short axis = 1; axis <= 3; axis++)
        GT_AxisOn(axis), GT_LmtsOn(axis);
    GT_SetSynAcc(0.2);
    GT_SetStpAcc(0.5);
    for (unsigned short axis = 3; axis >= 1; axis--)
        home(axis);
    tell("home");
    printf("%.1f s each\n", drycut_milliseconds() / 3e3);
    return GT_Close();
}
