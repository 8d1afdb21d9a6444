/* Jog to a limit, then the origin on the home switch, asking without a sleep. */
#include "client.h"

static int jog(double to)
{
    double place[4];
    GT_GetPrfPnt(place);
    return GT_LnXY(to, place[1]);
}

int main(void)
{
    long home = 12345;
    printf("card %d", GT_SwitchtoCardNo(0));
    printf(" open %d", GT_Open(65535));
    printf(" card %d is %d\n", GT_SwitchtoCardNo(0), GT_GetCurrentCardNo());
    GT_Reset();
    GT_LmtSns(0xFF);
    for (unsigned short axis = 1; axis <= 2; axis++)
        GT_AxisOn(axis), GT_LmtsOn(axis), GT_ClrSts(axis);
    GT_SetSynVel(20), GT_SetSynAcc(0.5), GT_SetStpAcc(0.5);
    jog(100000000);
    while (!(sts(1) & ON_POSITIVE))
        ;
    while (sts(1) & MOVING)
        ;
    tell("limit");
    GT_ClrSts(1);
    GT_CaptHome(1);
    jog(-100000000);
    while (!(sts(1) & CAPTURED))
        ;
    GT_StpMtn();
    wait_idle();
    printf("capture %d", GT_GetCapt(1, &home));
    printf(" at %ld\n", home);
    GT_LnXY(home, 0);
    wait_idle();
    GT_ZeroPos(1), GT_ZeroPos(2);
    GT_ClrSts(1);
    tell("origin");
    return GT_Close();
}
