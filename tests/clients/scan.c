/* A measuring machine: zero on the negative limits, lines scanned from a list that is filled as it runs, and back. It
   waits by asking the card without a sleep, and by sleeps that it takes to be long enough. */
#include <windows.h>

#include "client.h"

static int begin(void)
{
    if (GT_Open(65535) || GT_Reset() || GT_LmtSns(0xF))
        return 0;
    for (unsigned short axis = 1; axis <= 2; axis++)
        if (GT_ClrSts(axis) || GT_AxisOn(axis) || GT_LmtsOn(axis) || GT_MapCnt(axis, 1))
            return 0;
    Sleep(200);
    return !GT_SetSynAcc(0.5) && !GT_SetSynVel(10) && !GT_SetStpAcc(0.5);
}

/* Drives an axis to its negative limit and off it; false where it comes to its end. */
static int to_limit(unsigned short axis, double speed)
{
    double place[4];
    GT_ClrSts(axis);
    GT_SetSynVel(speed);
    GT_GetPrfPnt(place);
    if (axis == 1 ? GT_LnXY(-1000000, place[1]) : GT_LnXY(place[0], -1000000))
        return 0;
    while (!(sts(axis) & ON_NEGATIVE))
        if (crd() & IDLE)
            return 0;
    while (sts(axis) & MOVING)
        ;
    Sleep(1000);
    GT_GetPrfPnt(place);
    if (axis == 1 ? GT_LnXY(place[0] + 1000, place[1]) : GT_LnXY(place[0], place[1] + 1000))
        return 0;
    Sleep(1000);
    return 1;
}

static int zero(double x_speed, double y_speed)
{
    if (!to_limit(1, x_speed) || !to_limit(2, y_speed))
        return 0;
    GT_ZeroPos(1), GT_ZeroPos(2);
    GT_ClrSts(1), GT_ClrSts(2);
    GT_SetSynVel(50);
    GT_LnXY(30000, 0);
    Sleep(2000);
    GT_LnXY(30000, 20000);
    Sleep(2000);
    return 1;
}

static int scan(double width, double from, double step, int lines)
{
    GT_StrtList();
    GT_MvXY(0, from, 50, 0.5);
    GT_SetSynVel(20);
    GT_EndList();
    if (GT_StrtMtn())
        return 0;
    for (int line = 0; line < lines; line++) {
        double y = from + line * step;
        GT_AddList();
        if (GT_LnXY(width, y) || GT_LnXY(0, y) || GT_LnXY(0, y + step))
            return 0;
        GT_EndList();
    }
    wait_idle();
    Sleep(500);
    return 1;
}

int main(void)
{
    int zeroed;
    if (!begin())
        return puts("no card"), 1;
    zeroed = zero(10, 5);
    tell(zeroed ? "zero" : "no zero");
    if (!zeroed)
        return 1;
    printf("scan %d\n", scan(25000, 30000, 50, 3));
    tell("scanned");
    GT_SetSynVel(50);
    GT_LnXY(0, 0);
    wait_idle();
    Sleep(1000);
    tell("back");
    printf("%lu ms\n", drycut_milliseconds());
    GT_StpMtn();
    GT_AxisOff(1), GT_AxisOff(2);
    return GT_Close();
}
